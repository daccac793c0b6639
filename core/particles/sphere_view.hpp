// Bare pointers into the spheres' kinematics. The compiled variants of a kernel see these and nothing else, so that no inline function
// of a shared header is ever compiled for a processor that the machine does not have.
#pragma once

#include <cstdint>

namespace proveta {

/// Positions (m), velocities (m/s) and spins (rad/s), one array per component.
struct SphereView {
    const double* position[3];
    const double* velocity[3];
    const double* spin[3];
    std::int32_t count; ///< of spheres
};

} // namespace proveta
