#include "lab/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "lab/citation.hpp"
#include "lab/crack_report.hpp"
#include "lab/derived.hpp"
#include "lab/mohr_report.hpp"
#include "lab/quasi_static.hpp"
#include "lab/specimen_report.hpp"
#include "lab/test_plots.hpp"
#include "lab/test_tables.hpp"

namespace proveta {

namespace {

constexpr double few_across = 8.0; // mean sphere diameters (docs/results.md, sizes)

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
std::vector<std::string> warnings_of(const report::Record& r, const Deck& deck, const Bench& bench, const TestData& data) {
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
    if (bonded && std::fabs(bench.partition.section - 1.0) > 0.015) {
        out.push_back(fmt::format("The bond areas make up {:.3f} of the section: stiffness and strength are off by as much "
                                  "(card's area rule: {}).",
                                  bench.partition.section, deck.material.values.area_rule));
    }
    if (bench.laguerre) {
        const auto pairs = static_cast<double>(bench.dropped + bench.model->bonds.size());
        if (static_cast<double>(bench.dropped) > 0.02 * pairs || bench.laguerre->unbonded_share > 0.05) {
            out.push_back(fmt::format("Exact areas: {} pairs within reach share no facet and are not bonded, and {:.1f} % of the facet "
                                      "area belongs to pairs beyond reach; set bonding.coordination so that both are few.",
                                      bench.dropped, 100.0 * bench.laguerre->unbonded_share));
        }
    }
    if (const auto& l = bench.long_bonds; l.count > 0) {
        out.push_back(fmt::format("{} of {} bonds are longer than {}, so that they tear with less than the card's fracture energy: smaller "
                                  "spheres, or more tensile_characteristic_length.",
                                  l.count, bench.model->bonds.size(), input::format_quantity(l.longest_allowed, input::Unit::length)));
    }
    const Shape& shape = bench.specimen.shape;
    const double across = std::min(shape.lateral_size(), shape.height) / (2.0 * bench.statistics.mean_radius);
    if (bench.long_bonds.longest_allowed > 0.0 && across < few_across) {
        out.push_back(fmt::format("The specimen is only {:.1f} mean spheres wide at its narrowest; strengths scatter, and hold from about "
                                  "{:.0f} on.",
                                  across, few_across));
    }
    if (const std::string made = coupling_warning(data.energy); !made.empty()) {
        out.push_back(made);
    }
    for (const auto& body : bench.model->walls.bodies) {
        if (body.crossings > 0) {
            out.push_back(fmt::format("The membrane leaked: {} contacts of particles whose centre lay beyond it.", body.crossings));
        }
    }
    for (const auto& calibration : bench.calibrations) {
        if (!calibration.result.in_reach) {
            out.push_back(fmt::format("{}: Poisson's ratio {:.4g} is out of reach of the bond model, which comes to {:.3f} here; E is "
                                      "the card's. \"elasticity\": \"calibrated\" reaches higher ratios by the averaged stress.",
                                      calibration.name, calibration.result.wanted_poisson_ratio, calibration.result.poisson_ratio));
        }
    }
    if (bonded && bench.model->dt() < bench.model->first_dt()) { // contacts of loose matter stiffen as they are pressed
        out.push_back(fmt::format("The time step was shortened from {:.4g} s to {:.4g} s when new contacts had made the specimen stiffer.",
                                  bench.model->first_dt(), bench.model->dt()));
    }
    if (bonded && bench.statistics.outside > 0) {
        out.push_back(fmt::format("{} spheres reach beyond the specimen's nominal surface.", bench.statistics.outside));
    }
    if (deck.material.values.status == "provisional") {
        out.push_back("The material card is provisional: " + deck.material.values.about + ".");
    }
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
    if (!data.curve.rows.empty()) {
        r.results = deck.protocol->results(
            {data.curve, data.energy, data.events, bench.specimen.shape, bench.press, bench.grain, bench.model->materials.front().density});
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
    r.warnings = warnings_of(r, deck, bench, data);
    r.pictures = data.pictures;
    add_sections(r, deck, bench, data);
    r.tables = {ledger_table(data.energy), standards_table(info), provenance_table(deck, bench)};
    r.citation = citation(info.title, deck.title, resolved(deck));
    return r;
}

std::vector<report::Scalar> possible_results(const Deck& deck) {
    report::Table curve;
    curve.columns = Instruments::curve_columns(false);
    const report::Table energy = Instruments::empty_energy();
    auto out = deck.protocol->results({curve, energy, {}, shape_of(deck.specimen), Press{}, 0.0, 0.0});
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
        out.push_back({fmt::format("unloading_modulus_{}", k), "", std::nullopt, "Pa", ""});
    }
    return out;
}

} // namespace proveta
