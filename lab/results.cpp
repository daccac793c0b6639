#include "lab/results.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "core/parallel/instruction_set.hpp"
#include "lab/citation.hpp"
#include "lab/crack_report.hpp"
#include "lab/derived.hpp"
#include "lab/mohr_report.hpp"
#include "lab/provenance.hpp"
#include "lab/quasi_static.hpp"
#include "lab/specimen_report.hpp"

namespace proveta {

namespace {

// The curve, or the energies if the curve has no column of this name.
const report::Table& table_with(const TestData& data, const std::string& name) {
    const auto& columns = data.curve.columns;
    return std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; }) ? data.curve : data.energy;
}

std::vector<double> column_of(const TestData& data, const std::string& name, double scale) {
    auto values = table_with(data, name).values(name);
    for (double& v : values) {
        v *= scale;
    }
    return values;
}

report::Plot plot_of(const PlotSpec& spec, const TestData& data) {
    report::Plot p{spec.title, spec.x_title, spec.y_title, {}, {}};
    for (const auto& c : spec.curves) {
        report::Curve curve{c.name, column_of(data, c.x, spec.x_scale), column_of(data, c.y, spec.y_scale), c.colour};
        const std::size_t peak = peak_index(curve.y);
        if (c.to_peak) {
            curve.x.resize(std::min(curve.x.size(), peak + 1));
            curve.y.resize(curve.x.size());
        }
        if (spec.mark_peak && p.curves.empty() && !curve.y.empty()) {
            p.marks.emplace_back(curve.x[peak], curve.y[peak]);
        }
        p.curves.push_back(std::move(curve));
    }
    return p;
}

// The test's own plots, then what every test shows.
std::vector<report::Plot> plots(const Protocol& protocol, double sense, bool bonded, const TestData& data) {
    auto specs = protocol.plots();
    if (bonded) {
        specs.push_back(
            {"Failed bonds.",
             "axial strain [%]",
             "failed bonds",
             sense * 100.0,
             1.0,
             {{"axial_strain", "broken_in_tension", "in tension", "#c0392b"}, {"axial_strain", "broken_in_shear", "in shear", "#d68910"}}});
    }
    specs.push_back({"Where the work put in went.",
                     "axial strain [%]",
                     "energy [J]",
                     sense * 100.0,
                     1.0,
                     {{"axial_strain", "platens", "work of platens", "#111111"},
                      {"axial_strain", "elastic", "elastic", "#1f4e79"},
                      {"axial_strain", "damage", "damage", "#c0392b"},
                      {"axial_strain", "plastic", "plastic", "#7d3c98"},
                      {"axial_strain", "friction", "friction", "#b9770e"},
                      {"axial_strain", "background", "background damping", "#1e7b46"},
                      {"axial_strain", "kinetic", "kinetic", "#0e8a93"}}});
    if (!data.energy.rows.empty() && data.energy.rows.back()[data.energy.column("pressure")] != 0.0) {
        specs.back().curves.insert(specs.back().curves.begin() + 1, {"axial_strain", "pressure", "work of the pressure", "#7f8c8d"});
    }
    std::vector<report::Plot> out;
    for (const auto& spec : specs) {
        out.push_back(plot_of(spec, data));
    }
    return out;
}

report::TextTable ledger_table(const report::Table& energy) {
    report::TextTable t{"Energy ledger at the end", {{"Term", "J", "What it is"}}};
    for (std::size_t k = 2; k < energy.columns.size() && !energy.rows.empty(); ++k) {
        t.rows.push_back({energy.columns[k].name, fmt::format("{:.4g}", energy.rows.back()[k]), energy.columns[k].meaning});
    }
    return t;
}

// What a membrane is, in a sentence.
std::string membrane_text(const Deformable& m) {
    const SolidMaterial& rubber = m.solid.material;
    return fmt::format("{} triangles, {} nodes, {:.3g} mm of {} with E = {:.3g} MPa, nu = {:.3g}", m.solid.mesh().membranes.size(),
                       m.solid.nodes(), 1e3 * m.solid.thickness,
                       rubber.law == SolidLaw::kirchhoff ? "St. Venant-Kirchhoff rubber" : "Neo-Hookean rubber",
                       1e-6 * rubber.young_modulus, rubber.poisson_ratio);
}

report::TextTable loose_table(const Deck& deck, const Bench& bench) {
    const auto& s = bench.statistics;
    const bool stones = !bench.specimen.stones.empty();
    report::TextTable t{
        "Specimen and material",
        {{"Quantity", "Value"},
         {"Shape", bench.specimen.shape.text()},
         {stones ? "Stones" : "Spheres",
          fmt::format("{}, mean size {:.2f} mm, relative deviation {:.1f} %", stones ? bench.specimen.stones.size() : s.spheres,
                      1e3 * bench.grain, 100 * s.relative_deviation)},
         {"Porosity before the test", fmt::format("{:.2f} %", 100 * s.porosity)},
         {"Material", fmt::format("{}: {}", deck.material.values.name, deck.material.values.about)},
         {"Source of the material", fmt::format("{} (status: {})", deck.material.values.source, deck.material.values.status)}}};
    if (stones) {
        t.rows.insert(t.rows.begin() + 3,
                      {"Spheres", fmt::format("{} in the stones, of {} forms", bench.model->spheres.size(), bench.specimen.forms.size())});
    }
    for (const auto& body : bench.model->walls.bodies) {
        t.rows.push_back({"Membrane", membrane_text(body)});
    }
    return t;
}

report::TextTable specimen_table(const Deck& deck, const Bench& bench) {
    if (bench.model->bonds.size() == 0) {
        return loose_table(deck, bench);
    }
    const auto& s = bench.statistics;
    report::TextTable t{
        "Specimen and material",
        {{"Quantity", "Value"},
         {"Shape", bench.specimen.shape.text()},
         {"Spheres", fmt::format("{}, mean radius {:.3f} mm, relative deviation {:.1f} %", s.spheres, 1e3 * s.mean_radius,
                                 100 * s.relative_deviation)},
         {"Porosity", fmt::format("{:.2f} % (overlaps counted twice)", 100 * s.porosity)},
         {"Bonds", fmt::format("{}, mean coordination {:.2f}, interaction range beta = {:.4f}", bench.model->bonds.size(),
                               bench.coordination, bench.beta)},
         {"Bond areas over the section", fmt::format("{:.4f} (whole), {:.4f} (interior); sum(A d)/V = {:.3f}", bench.partition.section,
                                                     bench.partition.interior, bench.partition.filling)},
         {"Fabric deviator", fmt::format("{:.4f}", s.fabric_deviator)},
         {"Largest overlap", fmt::format("{:.3f} of the smaller radius", s.largest_overlap)},
         {"Material", fmt::format("{}: {}", deck.material.values.name, deck.material.values.about)},
         {"Source of the material", fmt::format("{} (status: {})", deck.material.values.source, deck.material.values.status)}}};
    if (bench.area_factor) {
        t.rows.push_back({"Factor on bond areas", fmt::format("{:.4f} = 40 P / N_c (5.6)", *bench.area_factor)});
    }
    if (bench.laguerre) {
        t.rows.push_back(
            {"Tessellation", fmt::format("{} bonds dropped without a facet; {:.2f} % of the facet area belongs to no bond; cells fill "
                                         "{:.4f} of the shape; {} spheres without a cell",
                                         bench.dropped, 100.0 * bench.laguerre->unbonded_share, bench.laguerre->volume_ratio,
                                         bench.laguerre->without_cell)});
    }
    for (const auto& calibration : bench.calibrations) {
        t.rows.push_back({"Elasticity of " + calibration.name, text_of(calibration.result)});
    }
    t.rows.push_back({"Mass scaling", text_of(bench.model->mass_scaling())});
    for (const auto& body : bench.model->walls.bodies) {
        t.rows.push_back({"Membrane", membrane_text(body)});
    }
    return t;
}

report::TextTable standards_table(const ProtocolInfo& info) {
    report::TextTable t{"What of the standards is mimicked", {{"Standard", "Mimicked", "Not mimicked"}}};
    for (const auto& s : info.standards) {
        t.rows.push_back({s.name, s.mimics, s.cannot});
    }
    return t;
}

report::TextTable provenance_table(const Deck& deck, const Bench& bench) {
    return {"Provenance",
            {{"What", "Value"},
             {"Program", fmt::format("Proveta {}, {}, {}", version(), PROVETA_COMPILER, instruction_set_name())},
             {"Deck", deck.source},
             {"Specimen", fmt::format("seed {}, hash {}", deck.specimen.seed, hex(bench.specimen_hash))},
             {"Steps", fmt::format("{} of {:.4g} s (stable step at least {:.4g} s)", bench.model->steps(), bench.model->dt(),
                                   bench.model->stable_step())},
             {"Final state", hex(bench.model->state_hash())},
             {"To repeat", "proveta run manifest.json --out NEW_FOLDER"},
             {"Written", now_utc()}}};
}

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

} // namespace

report::Table event_table(const std::vector<FailureEvent>& events) {
    report::Table t;
    t.notes = {"One row a failed bond, in the order of failure. mode: 1 tension, 2 shear."};
    t.columns = {{"time", "s", "time since the start of loading"},
                 {"axial_strain", "", "nominal strain at the failure"},
                 {"x", "m", "middle of the bond"},
                 {"y", "m", "the same"},
                 {"z", "m", "the same"},
                 {"mode", "", "1 tension, 2 shear"},
                 {"energy", "J", "dissipated by the bond's damage, from first softening to failure"},
                 {"area", "m2", "of the bond"}};
    for (const auto& e : events) {
        t.rows.push_back(
            {e.time, e.axial_strain, e.position.x(), e.position.y(), e.position.z(), static_cast<double>(e.mode), e.energy, e.area});
    }
    return t;
}

MainCurve main_curve(const Protocol& protocol, const TestData& data) {
    const PlotSpec spec = protocol.plots().front();
    const PlotCurve& curve = spec.curves.front();
    const auto column = [&](const std::string& name) {
        const report::Table& table = table_with(data, name);
        return table.columns[table.column(name)];
    };
    return {{column_of(data, curve.x, std::copysign(1.0, spec.x_scale)), column_of(data, curve.y, std::copysign(1.0, spec.y_scale))},
            column(curve.x),
            column(curve.y),
            {spec.title, spec.x_title, spec.y_title, std::fabs(spec.x_scale), std::fabs(spec.y_scale)}};
}

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
        r.plots = plots(*deck.protocol, bench.press.sense, bench.model->bonds.size() > 0, data);
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
    if (status == "interrupted") {
        r.warnings.emplace_back("This result is partial: the run was interrupted.");
    } else if (status == "failed") {
        r.warnings.push_back("This result is partial: " + data.stopped_by + ".");
    }
    for (const auto& badge : r.badges) {
        if (!badge.good) {
            r.warnings.push_back(badge.name + ": " + badge.verdict + ".");
        }
    }
    const bool bonded = bench.model->bonds.size() > 0;
    if (bonded && std::fabs(bench.partition.section - 1.0) > 0.015) {
        r.warnings.push_back(fmt::format("The bond areas make up {:.3f} of the section: stiffness and strength are off by as much "
                                         "(card's area rule: {}).",
                                         bench.partition.section, deck.material.values.area_rule));
    }
    if (bench.laguerre) {
        const auto pairs = static_cast<double>(bench.dropped + bench.model->bonds.size());
        if (static_cast<double>(bench.dropped) > 0.02 * pairs || bench.laguerre->unbonded_share > 0.05) {
            r.warnings.push_back(
                fmt::format("Exact areas: {} pairs within reach share no facet and are not bonded, and {:.1f} % of the facet "
                            "area belongs to pairs beyond reach; set bonding.coordination so that both are few.",
                            bench.dropped, 100.0 * bench.laguerre->unbonded_share));
        }
    }
    if (const std::string made = coupling_warning(data.energy); !made.empty()) {
        r.warnings.push_back(made);
    }
    for (const auto& body : bench.model->walls.bodies) {
        if (body.crossings > 0) {
            r.warnings.push_back(fmt::format("The membrane leaked: {} contacts of particles whose centre lay beyond it.", body.crossings));
        }
    }
    for (const auto& calibration : bench.calibrations) {
        if (!calibration.result.in_reach) {
            r.warnings.push_back(
                fmt::format("{}: Poisson's ratio {:.4g} is out of reach of the bond model, which comes to {:.3f} here; E is "
                            "the card's. \"elasticity\": \"calibrated\" reaches higher ratios by the averaged stress.",
                            calibration.name, calibration.result.wanted_poisson_ratio, calibration.result.poisson_ratio));
        }
    }
    if (bonded && bench.model->dt() < bench.model->first_dt()) { // contacts of loose matter stiffen as they are pressed
        r.warnings.push_back(
            fmt::format("The time step was shortened from {:.4g} s to {:.4g} s when new contacts had made the specimen stiffer.",
                        bench.model->first_dt(), bench.model->dt()));
    }
    if (bonded && bench.statistics.outside > 0) {
        r.warnings.push_back(fmt::format("{} spheres reach beyond the specimen's nominal surface.", bench.statistics.outside));
    }
    if (deck.material.values.status == "provisional") {
        r.warnings.push_back("The material card is provisional: " + deck.material.values.about + ".");
    }
    r.pictures = data.pictures;
    add_sections(r, deck, bench, data);
    r.tables = {ledger_table(data.energy), standards_table(info), provenance_table(deck, bench)};
    r.citation = citation(info.title, deck.title, resolved(deck));
    return r;
}

input::Json verdicts_of(const std::vector<report::Badge>& badges) {
    input::Json out = input::Json::object();
    for (const auto& b : badges) {
        input::Json figures;
        for (const auto& [what, figure] : b.figures) {
            figures[what] = figure;
        }
        out[b.name] = {{"good", b.good}, {"verdict", b.verdict}, {"figures", figures}};
    }
    return out;
}

input::Json summary(const report::Record& r, const Bench& bench, const TestData& data) {
    input::Json j;
    j["title"] = r.title;
    j["status"] = r.status;
    j["stopped_by"] = r.stopped_by;
    j["stages"] = data.stages;
    for (const auto& s : r.results) {
        j["results"][s.name] = {{"value", s.value ? input::Json(*s.value) : input::Json()}, {"unit", s.unit}, {"formula", s.formula}};
    }
    j["verdicts"] = verdicts_of(r.badges);
    j["warnings"] = r.warnings;
    const auto& s = bench.statistics;
    j["specimen"] = {{"spheres", bench.model->spheres.size()},
                     {"stones", bench.specimen.stones.size()},
                     {"grain_m", bench.grain},
                     {"mean_radius_m", s.mean_radius},
                     {"relative_deviation", s.relative_deviation},
                     {"porosity", s.porosity},
                     {"bonds", bench.model->bonds.size()},
                     {"coordination", bench.coordination},
                     {"interaction_range", bench.beta},
                     {"section_of_bond_areas", bench.partition.section},
                     {"interior_section_of_bond_areas", bench.partition.interior},
                     {"area_filling", bench.partition.filling},
                     {"fabric_deviator", s.fabric_deviator},
                     {"largest_overlap", s.largest_overlap}};
    for (const auto& [material, found] : bench.calibrations) {
        j["elasticity"].push_back({{"material", material},
                                   {"normal_factor", found.factors.normal_factor},
                                   {"shear_factor", found.factors.shear_factor},
                                   {"averaged_factor", found.factors.averaged_factor},
                                   {"young_modulus", found.young_modulus},
                                   {"poisson_ratio", found.poisson_ratio},
                                   {"in_reach", found.in_reach}});
    }
    if (bench.area_factor) {
        j["specimen"]["area_factor"] = *bench.area_factor;
    }
    if (bench.laguerre) {
        j["specimen"]["bonds_dropped_without_facet"] = bench.dropped;
        j["specimen"]["unbonded_share_of_facet_area"] = bench.laguerre->unbonded_share;
        j["specimen"]["cells_over_volume"] = bench.laguerre->volume_ratio;
        j["specimen"]["spheres_without_cell"] = bench.laguerre->without_cell;
    }
    j["steps"] = bench.model->steps();
    j["time_step_s"] = bench.model->dt();
    const MassScaling& scaling = bench.model->mass_scaling();
    j["mass_scaling"] = {{"added_mass", scaling.added},
                         {"added_later", scaling.added_later},
                         {"spheres", scaling.spheres},
                         {"largest_factor", scaling.largest_factor},
                         {"stable_step_without_s", scaling.step_before},
                         {"stable_step_with_s", scaling.step_after}};
    if (data.rate_check) {
        j["rate_check"] = {{"peak_at_half_rate_Pa", data.rate_check->peak},
                           {"peak_at_rate_over_that_minus_1", data.rate_check->difference},
                           {"steps", data.rate_check->steps}};
    } else {
        j["rate_check"] = "not done";
    }
    j["final_state_hash"] = hex(bench.model->state_hash());
    return j;
}

std::string text_of(const MassScaling& s) {
    if (s.spheres == 0 && s.added_later <= 0.0) {
        return "none";
    }
    std::string text =
        s.spheres == 0
            ? "none at the start"
            : fmt::format("{:.2f} % added mass on {} spheres, at most {:.3g} times the true one; stable step {:.3g} s instead of {:.3g} s",
                          100.0 * s.added, s.spheres, s.largest_factor, s.step_after, s.step_before);
    if (s.added_later > 0.0) {
        text += fmt::format("; {:.2g} % more in the course of the test, where new contacts pressed", 100.0 * s.added_later);
    }
    return text;
}

std::string as_text(const report::Record& r) {
    std::string out = fmt::format("{} ({}): {}\n", r.title, r.status, r.stopped_by);
    for (const auto& s : r.results) {
        const auto shown = report::readable(s);
        out += shown.value ? fmt::format("  {:<28} {:>10.5g} {}\n", shown.title, *shown.value, shown.unit)
                           : fmt::format("  {:<28} not determined\n", shown.title);
    }
    for (const auto& b : r.badges) {
        out += fmt::format("  {}: {}\n", b.name, b.verdict);
        for (const auto& [what, figure] : b.figures) {
            out += fmt::format("    {}: {}\n", what, figure);
        }
    }
    for (const auto& w : r.warnings) {
        out += fmt::format("  warning: {}\n", w);
    }
    return out;
}

} // namespace proveta
