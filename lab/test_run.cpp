#include "lab/test_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/fields.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

// Keeps pictures of the specimen at the highest stress so far and 20 % past it.
class PeakWatch {
  public:
    void look(const Bench& bench, double stress, double strain) {
        if (stress > highest_) {
            highest_ = stress;
            at_peak_ = slice(bench, fmt::format("At the peak, strain {:.3f} %", 100.0 * strain));
            past_ = false;
        } else if (!past_ && stress < 0.8 * highest_ && bench.model->broken() > 0) {
            past_ = true;
            at_drop_ = slice(bench, fmt::format("20 % past the peak, strain {:.3f} %", 100.0 * strain));
        }
    }

    void add_to(std::vector<report::Picture>& pictures) const {
        if (past_) {
            pictures.push_back(at_peak_);
            pictures.push_back(at_drop_);
        }
    }

  private:
    double highest_ = 0.0;
    bool past_ = false;
    report::Picture at_peak_;
    report::Picture at_drop_;
};

void record_failures(const Model& model, double strain, Instruments& instruments, std::vector<FailureEvent>& events) {
    for (const auto& failure : model.failures()) {
        const auto i = static_cast<std::size_t>(model.bonds.i[failure.bond]);
        const auto j = static_cast<std::size_t>(model.bonds.j[failure.bond]);
        const Vec3 middle = 0.5 * (model.spheres.position.at(i) + model.spheres.position.at(j));
        events.push_back({model.time(), strain, middle, failure.mode, model.bonds.damage_work[failure.bond]});
        instruments.count(failure.mode);
    }
}

void lead(const Model& model, double strain, bool look, RateControl& rate) {
    if (look) {
        const Ledger& l = model.ledger();
        rate.observe({strain, l.platens + l.pressure, l.damage, l.kinetic, l.elastic, model.measures().unbalanced_ratio});
    }
    rate.advance(model.dt());
}

} // namespace

TestData run_protocol(const Deck& deck, Bench& bench, const TestHooks& hooks, const TestVariant& variant) {
    Model& model = *bench.model;
    Instruments instruments(bench);
    TestData data;
    data.curve = instruments.empty_curve();
    data.energy = instruments.empty_energy();
    data.pictures.push_back(slice(bench, "Before the test"));

    const double range = deck.protocol->strain_range();
    const double per_sample = range / static_cast<double>(deck.output.samples);
    const double per_field = deck.output.fields > 0 ? range / static_cast<double>(deck.output.fields) : 2.0 * range;
    std::int64_t sample = 0;
    std::int64_t field = 0;
    PeakWatch watch;
    const BenchView view{model, bench.specimen.shape, bench.wave_speed, data.curve};
    const auto stages = deck.protocol->stages(view, variant.pace);

    try {
        for (const auto& stage : stages) {
            const double begun = model.time();
            for (bool over = false; !over;) {
                const double strain = instruments.nominal_strain(model);
                const bool due = strain >= static_cast<double>(sample) * per_sample;
                const double in_stage = model.time() - begun;
                const bool look = stage.rate && stage.rate->looks_at(model.steps());
                model.step(stage.speeds(view, in_stage), due || look);
                if (stage.rate) {
                    lead(model, strain, look, *stage.rate);
                }
                record_failures(model, strain, instruments, data.events);
                if (!due) {
                    if (model.steps() % 256 == 0) {
                        hooks.progress(data, strain / range);
                        data.interrupted = hooks.interrupted();
                        over = data.interrupted;
                    }
                    continue;
                }
                instruments.sample(bench, data.curve, data.energy);
                sample = static_cast<std::int64_t>(std::floor(strain / per_sample)) + 1;
                watch.look(bench, data.curve.rows.back()[data.curve.column("axial_stress")], strain);
                if (strain >= static_cast<double>(field) * per_field) {
                    hooks.fields();
                    field = static_cast<std::int64_t>(std::floor(strain / per_field)) + 1;
                }
                hooks.progress(data, strain / range);
                data.interrupted = hooks.interrupted();
                if (const auto why = deck.protocol->stop(view)) {
                    data.stopped_by = *why;
                } else if (const auto fell = stopped_by({1.0, variant.until_drop}, data.curve)) {
                    data.stopped_by = *fell;
                }
                over = data.interrupted || !data.stopped_by.empty() || (stage.finished && stage.finished(view, in_stage));
            }
            if (data.interrupted || !data.stopped_by.empty()) {
                break;
            }
        }
        if (data.interrupted) {
            data.stopped_by = "interrupted by the user";
        }
        if (deck.output.fields > 0) {
            hooks.fields();
        }
    } catch (const NumericalFailure& e) {
        data.failure = e.what();
        data.stopped_by = "the calculation failed: " + data.failure;
    }
    watch.add_to(data.pictures);
    data.pictures.push_back(slice(bench, "At the end"));
    return data;
}

} // namespace proveta
