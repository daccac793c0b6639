#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    // clang-format off
    static const std::vector<Case> all{
        // chapter 2
        restitution(),
        rolling_resistance(),
        parabolic_flight(),
        lsd_impact(),
        hertz_impact(),
        impact_steps(),
        sphere_between_plates(),
        damped_critical_step(),
        cylinder_precession(),
        // chapter 3
        facet_edge_vertex(),
        normal_continuity(),
        concave_error(),
        tangential_continuity(),
        multi_contact(),
        sliding_to_rolling(),
        brachistochrone(),
        // chapter 4
        circle_triangle(),
        membrane_balloon(),
        beam_impact(),
        adm_vs_direct(),
        pendulum_energy(),
        pendulum_energy_long(),
        // chapter 5
        regular_lattice(),
        dempack_bond(),
        two_body_energy(),
        weak_equals_none(),
        bonded_cantilever(),
        released_law(),
        facet_bond(),
        facet_bar(),
        polygon_areas(),
        area_models(),
        area_partition(),
        elastic_study(),
        elastic_calibration(),
        elastic_calibration_small(),
        elastic_laboratory(),
        elastic_laboratory_small(),
        mesh_convergence(),
        step_convergence(),
        rate_convergence(),
        hydrostatic_criterion(),
        objectivity(),
    };
    // clang-format on
    return all;
}

} // namespace proveta::verification
