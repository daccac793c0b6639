#include "lab/test_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/derived.hpp"
#include "lab/fields.hpp"
#include "lab/stages.hpp"
#include "lab/test_state.hpp"

namespace proveta {

namespace {

// Keeps what the specimen looked like at the highest stress so far and 20 % past it.
class PeakWatch {
  public:
    void look(const Bench& bench, double stress, double strain) {
        if (stress > highest_) {
            highest_ = stress;
            keep(bench, "peak", fmt::format("At the peak, strain {:.3f} %", 100.0 * strain), at_peak_, peak_);
            past_ = false;
        } else if (!past_ && stress < 0.8 * highest_ && bench.model->broken() > 0) {
            past_ = true;
            keep(bench, "past_peak", fmt::format("20 % past the peak, strain {:.3f} %", 100.0 * strain), at_drop_, drop_);
        }
    }

    void add_to(TestData& data) const {
        if (past_) {
            data.pictures.insert(data.pictures.end(), {at_peak_, at_drop_});
            data.moments.insert(data.moments.end(), {peak_, drop_});
        }
    }

    void visit_state(StateVisitor& visit) {
        std::int64_t past = past_ ? 1 : 0;
        visit("watch_highest", highest_);
        visit("watch_past", past);
        past_ = past != 0;
        visit_picture("watch_at_peak_", at_peak_, visit);
        visit_picture("watch_at_drop_", at_drop_, visit);
        visit_snapshot("watch_peak_", peak_, visit);
        visit_snapshot("watch_drop_", drop_, visit);
    }

  private:
    static void keep(const Bench& bench, const char* name, const std::string& title, report::Picture& picture, Snapshot& moment) {
        picture = slice(bench, title);
        moment = snapshot(*bench.model, name, title);
    }

    double highest_ = 0.0;
    bool past_ = false;
    report::Picture at_peak_;
    report::Picture at_drop_;
    Snapshot peak_;
    Snapshot drop_;
};

void record_failures(const Model& model, double strain, Instruments& instruments, std::vector<FailureEvent>& events) {
    for (const auto& failure : model.failures()) {
        const auto i = static_cast<std::size_t>(model.bonds.i[failure.bond]);
        const auto j = static_cast<std::size_t>(model.bonds.j[failure.bond]);
        const Vec3 middle = 0.5 * (model.spheres.position.at(i) + model.spheres.position.at(j));
        events.push_back(
            {model.time(), strain, middle, failure.mode, model.bonds.damage_work[failure.bond], model.bonds.area[failure.bond]});
        instruments.count(failure.mode);
    }
}

double phase_of(Stage::Kind kind) {
    return kind == Stage::Kind::preparing ? phase_preparing : kind == Stage::Kind::loading ? phase_loading : phase_cycling;
}

// A run of the protocol: the stages one after the other, each led by its control, sampled in equal parts of the whole test.
class Run {
  public:
    Run(const Deck& deck, Bench& bench, const TestHooks& hooks, const TestVariant& variant)
        : deck_(deck), bench_(bench), hooks_(hooks), variant_(variant), model_(*bench.model),
          instruments_(bench), view_{model_, bench.specimen.shape, bench.press, instruments_, bench.wave_speed, track_, bench.grain} {
        data_.curve = instruments_.empty_curve();
        data_.energy = instruments_.empty_energy();
    }

    TestData go() {
        data_.pictures.push_back(slice(bench_, "Before the test"));
        data_.moments.push_back(snapshot(model_, "intact", "Before the test"));
        stages_ = deck_.protocol->stages(view_, variant_.pace); // as the specimen is before the test
        bool midst = false;
        if (hooks_.restore) {
            hooks_.restore([this](StateVisitor& visit) { visit_state(visit); });
            model_.restored();
            midst = true;
            for (std::size_t k = 0; k < stages_.size() && static_cast<std::int64_t>(k) <= stage_; ++k) {
                data_.stages.push_back(stages_[k].name);
                before_ += static_cast<std::int64_t>(k) < stage_ ? stages_[k].share : 0.0;
            }
        }
        try {
            while (stage_ < static_cast<std::int64_t>(stages_.size()) && !data_.interrupted && data_.stopped_by.empty()) {
                pass(stages_[static_cast<std::size_t>(stage_)], midst);
                midst = false;
            }
            if (data_.interrupted) {
                data_.stopped_by = "interrupted by the user";
            } else if (data_.stopped_by.empty()) {
                data_.stopped_by = "the loading is complete";
            }
            model_.follow_bodies(); // for the pictures of the end, which may be where the test was restored
            if (deck_.output.fields > 0 && over_ == 0 && stepped_) { // nothing is measured before a step
                hooks_.fields();
            }
        } catch (const NumericalFailure& e) {
            data_.failure = e.what();
            data_.stopped_by = "the calculation failed: " + data_.failure;
        }
        if (!data_.interrupted && data_.failure.empty()) {
            over_ = 1;
            keep(true);
        }
        watch_.add_to(data_);
        data_.pictures.push_back(slice(bench_, "At the end"));
        data_.moments.push_back(snapshot(model_, "end", "At the end"));
        if (!model_.walls.bodies.empty()) {
            data_.pictures.push_back(membrane_view(bench_, "The membrane at the end"));
        }
        return std::move(data_);
    }

  private:
    // midst: the stage was begun before the state was kept that the test goes on from.
    void pass(const Stage& stage, bool midst) {
        if (!midst) {
            stage.control->begin(view_, drive_);
            furthest_ = {0.0, view_.strain(), view_.strain(), model_.time()};
            if (stage.kind == Stage::Kind::loading && track_.looks == 0.0) {
                track_.begun = view_.strain();
            }
            data_.stages.push_back(stage.name);
            if (stage_ > 0) {
                keep(true);
            }
        }
        for (bool over = false; !over;) {
            if (looked_) { // between two steps, where the state is whole
                looked_ = false;
                data_.interrupted = hooks_.interrupted();
                keep(data_.interrupted);
                if (data_.interrupted) {
                    return;
                }
            }
            const double done = stage.done(view_);
            const double whole = before_ + stage.share * std::clamp(done, 0.0, 1.0);
            over = done >= 1.0;
            const bool sampled = over || whole * static_cast<double>(deck_.output.samples) >= static_cast<double>(samples_);
            const bool watched = stage.kind == Stage::Kind::loading && (over || (model_.steps() + 1) % steps_a_watch == 0);
            step(stage, sampled || watched);
            if (watched) {
                watch();
            }
            if (sampled || !data_.stopped_by.empty()) {
                sample(stage, whole);
                looked_ = true;
            } else if (model_.steps() % steps_a_look == 0) {
                hooks_.progress(data_, whole);
                looked_ = true;
            }
            if (!over) {
                insist(stage, done);
            }
            over = over || !data_.stopped_by.empty();
        }
        if (data_.stopped_by.empty()) {
            before_ += stage.share;
            ++stage_;
        }
    }

    // A stage that does not get on would go on for ever: who waits for it is told.
    void insist(const Stage& stage, double done) {
        constexpr double least = 1e-5;        // of the stage,
        constexpr double least_strain = 1e-6; // or of axial strain, beyond where it has been,
        constexpr double patience = 3000.0;   // in so many crossings of a wave: whole tests take some hundreds to thousands
        const double strain = view_.strain();
        if (done >= furthest_.done + least || strain > furthest_.high + least_strain || strain < furthest_.low - least_strain) {
            furthest_ = {std::max(done, furthest_.done), std::min(strain, furthest_.low), std::max(strain, furthest_.high), model_.time()};
        } else if (model_.time() - furthest_.time > patience * view_.crossing()) {
            throw NumericalFailure(fmt::format(
                "the stage \"{}\" does not get on: {:.4g} % of it were done at {:.4g} s and no more {:.0f} steps later; the platens "
                "move at {:.3g} m/s under a stress of {:.3g} Pa, {} of {} bonds have failed. Look at the rate, at what ends the "
                "test and at the strengths of the card (tensile_strength; of the law dempack sigma_f and tau_f)",
                stage.name, 100.0 * furthest_.done, furthest_.time, (model_.time() - furthest_.time) / model_.dt(), drive_.closing,
                view_.stress(), model_.broken(), model_.bonds.size()));
        }
    }

    void keep(bool must) {
        if (hooks_.keep) {
            hooks_.keep([this](StateVisitor& visit) { visit_state(visit); }, must);
        }
    }

    // All that the steps to come depend on besides deck and specimen.
    void visit_state(StateVisitor& visit) {
        visit("test_stage", stage_);
        visit("test_over", over_);
        visit("test_stopped_by", data_.stopped_by);
        visit("test_samples", samples_);
        visit("test_fields", fields_);
        visit("test_furthest", furthest_.done);
        visit("test_furthest_low", furthest_.low);
        visit("test_furthest_high", furthest_.high);
        visit("test_furthest_time", furthest_.time);
        visit("test_closing", drive_.closing);
        visit("test_pressure", drive_.pressure);
        visit_rows("curve_", data_.curve, visit);
        visit_rows("energy_", data_.energy, visit);
        visit_events("", data_.events, visit);
        instruments_.visit_state("instruments_", visit);
        for (const auto& [name, value] : {std::pair{"strain", &track_.strain},
                                          {"deviator", &track_.deviator},
                                          {"peak", &track_.peak},
                                          {"look_at_peak", &track_.look_at_peak},
                                          {"begun", &track_.begun},
                                          {"looks", &track_.looks}}) {
            visit(std::string("track_") + name, *value);
        }
        watch_.visit_state(visit);
        for (std::size_t k = 0; k < stages_.size(); ++k) {
            stages_[k].control->visit_state("control_" + std::to_string(k) + "_", visit);
            if (stages_[k].memory) {
                stages_[k].memory("stage_" + std::to_string(k) + "_", visit);
            }
        }
        model_.visit_state(visit);
    }

    void step(const Stage& stage, bool due) {
        const bool looks = stage.control->looks(view_); // a sample is looked at by people alone: it must not lead the press
        drive_ = stage.control->drive(view_);
        speeds_.assign(model_.walls.platens.size(), 0.0);
        speeds_[0] = 0.5 * bench_.press.sense * drive_.closing;
        speeds_[1] = -speeds_[0];
        for (auto& pressure : model_.pressures) {
            pressure.value = drive_.pressure;
        }
        for (auto& body : model_.walls.bodies) {
            for (auto& pressure : body.solid.pressures) {
                pressure.value = drive_.pressure;
            }
        }
        stepped_ = true;
        // What is about to be looked at, and perhaps kept, is checked first: a diverged state is not worth keeping.
        model_.step(speeds_, due || looks || (model_.steps() + 1) % steps_a_look == 0);
        stage.control->stepped(view_, looks);
        record_failures(model_, bench_.press.sense * view_.strain(), instruments_, data_.events);
    }

    void sample(const Stage& stage, double whole) {
        const Instruments::Mark mark{static_cast<double>(data_.stages.size() - 1), phase_of(stage.kind), drive_.pressure};
        instruments_.sample(bench_, mark, data_.curve, data_.energy);
        samples_ = static_cast<std::int64_t>(std::floor(whole * static_cast<double>(deck_.output.samples))) + 1;
        if (stage.kind == Stage::Kind::loading) { // an unloading is no fall past the peak
            watch_.look(bench_, view_.stress() - drive_.pressure, view_.strain());
        }
        if (deck_.output.fields > 0 && whole * static_cast<double>(deck_.output.fields) >= static_cast<double>(fields_)) {
            hooks_.fields();
            fields_ = static_cast<std::int64_t>(std::floor(whole * static_cast<double>(deck_.output.fields))) + 1;
        }
        hooks_.progress(data_, whole);
    }

    // Whether the test is over; asked at steps of their own, which no output moves.
    void watch() {
        const double strain = view_.strain();
        track_.looks += 1.0;
        track_.strain = strain - track_.begun;
        constexpr double share = 0.2; // a load cell's answer, some 150 steps slow: a ripple of the platens' forces ends no test
        const double deviator = view_.stress() - drive_.pressure;
        track_.deviator += (track_.looks > 1.0 ? share : 1.0) * (deviator - track_.deviator);
        if (track_.deviator > track_.peak) {
            track_.peak = track_.deviator;
            track_.look_at_peak = track_.looks;
        }
        if (const auto why = deck_.protocol->stop(view_)) {
            data_.stopped_by = *why;
        } else if (const auto fell = stopped_by_drop(variant_.until_drop, view_)) {
            data_.stopped_by = *fell;
        }
    }

    const Deck& deck_;
    Bench& bench_;
    const TestHooks& hooks_;
    const TestVariant& variant_;
    Model& model_;
    Instruments instruments_;
    TestData data_;
    LoadingTrack track_;
    BenchView view_;
    PeakWatch watch_;
    Drive drive_;
    std::vector<double> speeds_;
    static constexpr std::int64_t steps_a_look = 256; // between looks at the clock and at the user's wishes
    static constexpr std::int64_t steps_a_watch = 32; // between looks at whether the test is over
    std::vector<Stage> stages_;
    std::int64_t stage_ = 0; // that is passed through
    std::int64_t over_ = 0;  // 1: the test is over and everything written
    bool looked_ = true;
    bool stepped_ = false; // by this process: forces and stresses are those of a step, and are not kept
    double before_ = 0.0;  // share of the test in earlier stages
    // How far the stage has got: share, lowest and highest axial strain, and when that last changed, s.
    struct Furthest {
        double done = 0.0, low = 0.0, high = 0.0, time = 0.0;
    } furthest_;
    std::int64_t samples_ = 0;
    std::int64_t fields_ = 0;
};

} // namespace

double BenchView::strain() const {
    return press.sense * (1.0 - (model.walls.platens[1].position - model.walls.platens[0].position) / press.length);
}

double BenchView::stress() const {
    return press.sense * 0.5 * (model.walls.platens[0].load() + model.walls.platens[1].load()) / Instruments::area(model, press);
}

double BenchView::girth_strain() const { return instruments.girth_strain(model); }

TestData run_protocol(const Deck& deck, Bench& bench, const TestHooks& hooks, const TestVariant& variant) {
    return Run(deck, bench, hooks, variant).go();
}

} // namespace proveta
