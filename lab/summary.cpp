#include "lab/summary.hpp"

#include <fmt/format.h>

#include "lab/provenance.hpp"

namespace proveta {

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
