#include "lab/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "lab/checks.hpp"
#include "lab/citation.hpp"
#include "lab/crack_report.hpp"
#include "lab/derived.hpp"
#include "lab/doubts.hpp"
#include "lab/mohr_report.hpp"
#include "lab/quasi_static.hpp"
#include "lab/specimen_report.hpp"
#include "lab/test_plots.hpp"
#include "lab/test_tables.hpp"

namespace proveta {

namespace {

// What stands large at the head: of these, in this order, those that the test has.
const std::vector<std::string> key_results{"friction_angle", "strength",        "splitting_strength", "tensile_strength",
                                           "crush_pressure", "yield_stress",    "young_modulus",      "constrained_modulus",
                                           "bulk_modulus",   "initial_modulus", "poisson_ratio",      "lateral_give",
                                           "strain_at_peak", "fracture_energy", "dilation_angle",     "confining_pressure",
                                           "strain_ratio"};

// Parts of the page below headings of their own.
void add_sections(report::Record& r, const Deck& deck, const Bench& bench, const TestData& data) {
    if (bench.model->bonds.size() > 0) {
        r.sections.push_back(crack_section(bench, data.events));
    }
    r.sections.push_back(specimen_section(bench));
    r.sections.back().tables.push_back(specimen_table(deck, bench));
}

// What a reader of the results should know.
std::vector<std::string> warnings_of(const report::Record& r, const Deck& deck, const Bench& bench, const TestData& data,
                                     const Measured& measured) {
    std::vector<std::string> out;
    if (r.status == "interrupted") {
        out.emplace_back("This result is partial: the run was interrupted.");
    } else if (r.status == "failed") {
        out.push_back("This result is partial: " + data.stopped_by + ".");
    }
    for (const auto& badge : r.badges) {
        if (!badge.good) {
            out.push_back(badge.name + ": " + badge.verdict + ".");
        }
    }
    const bool bonded = bench.model->bonds.size() > 0;
    const auto known = warnings_in_press(bench, deck);
    out.insert(out.end(), known.begin(), known.end());
    for (auto&& doubts :
         {bonded && !data.curve.rows.empty() ? doubts_about(deck.material.values, bench, r.results, measured) : std::vector<std::string>{},
          deck.protocol->doubts(measured)}) {
        out.insert(out.end(), doubts.begin(), doubts.end());
    }
    if (const std::string made = coupling_warning(data.energy); !made.empty()) {
        out.push_back(made);
    }
    for (const auto& body : bench.model->walls.bodies) {
        if (body.crossings > 0) {
            out.push_back(fmt::format("The membrane leaked: {} contacts of particles whose centre lay beyond it.", body.crossings));
        }
    }
    if (const std::string soft = overlap_warning(bonded ? 0.0 : bench.model->largest_overlap()); !soft.empty()) {
        out.push_back(soft);
    }
    if (bonded && bench.model->dt() < bench.model->first_dt()) { // contacts of loose matter stiffen as they are pressed
        out.push_back(fmt::format("The time step was shortened from {:.4g} s to {:.4g} s when new contacts had made the specimen stiffer.",
                                  bench.model->first_dt(), bench.model->dt()));
    }
    const auto of_deck = warnings_of_deck(deck);
    out.insert(out.end(), of_deck.begin(), of_deck.end());
    return out;
}

} // namespace

AcousticRule acoustic_rule(const Bench& bench) { return {2.0 * bench.statistics.mean_radius, bench.wave_speed}; }

report::Record make_record(const Deck& deck, const Bench& bench, const TestData& data, const std::vector<AcousticEvent>& acoustic,
                           const std::string& status) {
    const auto info = deck.protocol->about();
    report::Record r;
    r.title = deck.title;
    r.subtitle = fmt::format("{}, {}", info.title, deck.material.values.name);
    r.status = status;
    r.stopped_by = data.stopped_by;
    const Measured measured{data.curve,
                            data.energy,
                            data.events,
                            bench.specimen.shape,
                            bench.press,
                            bench.grain,
                            bench.model->materials.front().density,
                            bench.model->largest_overlap()};
    if (!data.curve.rows.empty()) {
        r.results = deck.protocol->results(measured);
        std::vector<std::vector<report::Scalar>> all{rate_results(data.curve, bench.press.sense)};
        if (bench.model->bonds.size() > 0) {
            all.push_back(acoustic_results(acoustic));
        }
        for (auto&& more : all) {
            r.results.insert(r.results.end(), more.begin(), more.end());
        }
        r.plots = test_plots(*deck.protocol, bench.press.sense, bench.model->bonds.size() > 0, data);
        if (const auto circles = circles_of_test(data.curve, bench.model->bonds.size() == 0)) {
            r.plots.push_back(*circles);
        }
        r.key_figures = report::key_figures(r.results, key_results);
        if (!acoustic.empty()) {
            r.plots.push_back(acoustic_activity_plot(acoustic));
            r.plots.push_back(magnitude_plot(acoustic));
        }
    }
    r.badges = {quasi_static_verdict(data.curve, bench.press.sense, data.energy, data.rate_check), energy_verdict(data.energy)};
    r.warnings = warnings_of(r, deck, bench, data, measured);
    r.pictures = data.pictures;
    add_sections(r, deck, bench, data);
    r.tables = {ledger_table(data.energy), standards_table(info), provenance_table(deck, bench, data.seconds)};
    r.citation = citation(info.title, deck.title, resolved(deck));
    return r;
}

std::vector<report::Scalar> possible_results(const Deck& deck) {
    report::Table curve;
    curve.columns = Instruments::curve_columns(false);
    const report::Table energy = Instruments::empty_energy();
    auto out = deck.protocol->results({curve, energy, {}, shape_of(deck.specimen), Press{}, 0.0, 0.0, 0.0});
    std::vector<std::vector<report::Scalar>> all{rate_results(curve, 1.0)};
    if (!deck.protocol->granular()) {
        all.push_back(acoustic_results({}));
    }
    for (auto&& more : all) {
        out.insert(out.end(), more.begin(), more.end());
    }
    const input::Json loading = resolved(deck)["loading"];
    const std::size_t cycles = loading.contains("cycles") ? loading["cycles"].size() : 0;
    for (std::size_t k = 1; k <= cycles; ++k) {
        const auto loop = loop_results(k);
        out.insert(out.end(), loop.begin(), loop.end());
    }
    return out;
}

} // namespace proveta
