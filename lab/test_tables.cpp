#include "lab/test_tables.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <filesystem>

#include "core/input/units.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"

namespace proveta {

namespace {

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

report::TextTable ledger_table(const report::Table& energy) {
    report::TextTable t{"Energy ledger at the end", {{"Term", "J", "What it is"}}};
    for (std::size_t k = 2; k < energy.columns.size() && !energy.rows.empty(); ++k) {
        t.rows.push_back({energy.columns[k].name, report::three_digits(energy.rows.back()[k]), energy.columns[k].meaning});
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

namespace {

// Where the spheres come from: a seed, or the file they were imported from.
std::string source_of(const Deck& deck, const Specimen& specimen) {
    const std::string mesh = input::text_at(specimen.recipe, "imported_from");
    const std::string from = !mesh.empty() ? "imported from " + mesh + " (axis " + input::text_at(specimen.recipe, "axis") + ")"
                             : specimen.recipe.contains("seed") ? fmt::format("seed {}", specimen.recipe["seed"].dump())
                                                                : "made outside this program";
    const std::string stored = std::filesystem::path(deck.specimen.file).filename().string();
    return stored.empty() ? from : from + ", stored as " + stored;
}

} // namespace

report::TextTable provenance_table(const Deck& deck, const Bench& bench, double seconds) {
    const int threads = omp_get_max_threads();
    return {"Provenance",
            {{"What", "Value"},
             {"Program", version_text()},
             {"Deck", deck.source},
             {"Specimen", fmt::format("{}, hash {}", source_of(deck, bench.specimen), hex(bench.specimen_hash))},
             {"Steps", fmt::format("{} of {:.4g} s (stable step at least {:.4g} s)", bench.model->steps(), bench.model->dt(),
                                   bench.model->stable_step())},
             {"Wall time", fmt::format("{} of loading, on {} thread{}", Progress::duration(seconds), threads, threads > 1 ? "s" : "")},
             {"Final state", hex(bench.model->state_hash())},
             {"To repeat", "proveta run manifest.json --out NEW_FOLDER"},
             {"Written", now_utc()}}};
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

} // namespace proveta
