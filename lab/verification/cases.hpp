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
Case sphere_between_plates();
Case damped_critical_step();
Case cylinder_precession();

// Chapter 5
Case polygon_areas();

} // namespace proveta::verification
