// The cases, one file each in this folder, in the order of the thesis.
#pragma once

#include "lab/verification/case.hpp"

namespace proveta::verification {

// Chapter 2
Case restitution();
Case rolling_resistance();
Case parabolic_flight();
Case lsd_impact();
Case hertz_impact();
Case impact_steps();
Case sphere_between_plates();
Case damped_critical_step();
Case cylinder_precession();

// Chapter 3
Case facet_edge_vertex();
Case normal_continuity();
Case concave_error();
Case tangential_continuity();
Case multi_contact();
Case sliding_to_rolling();
Case brachistochrone();

// Chapter 4
Case circle_triangle();
Case membrane_balloon();
Case beam_impact();
Case adm_vs_direct();
Case pendulum_energy();
Case pendulum_energy_long();

// Chapter 5
Case regular_lattice();
Case dempack_bond();
Case two_body_energy();
Case weak_equals_none();
Case bonded_cantilever();
Case mesh_convergence();
Case step_convergence();
Case rate_convergence();
Case hydrostatic_criterion();
Case objectivity();
Case released_law();
Case facet_bond();
Case facet_bar();
Case polygon_areas();
Case area_models();
Case area_partition();
Case elastic_study();
Case elastic_calibration();
Case elastic_calibration_small();
Case elastic_laboratory();
Case elastic_laboratory_small();

} // namespace proveta::verification
