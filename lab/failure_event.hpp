// A bond's failure.
#pragma once

#include "core/bonds/bonds.hpp"

namespace proveta {

struct FailureEvent {
    double time;         ///< s
    double axial_strain; ///< nominal
    Vec3 position;       ///< middle of the bond, m
    FailureMode mode;
    double energy;     ///< dissipated by the bond's damage from first softening to failure, J
    double area = 0.0; ///< of the bond, m2
};

} // namespace proveta
