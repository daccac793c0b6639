// What the compiled variants of the motion kernel share.
#pragma once

#include <cstddef>

#include "core/motion/motion_rule.hpp"

namespace proveta {

/// Bare pointers into the spheres' arrays and the rows of their loads.
struct MotionView {
    double *position[3], *velocity[3], *spin[3];
    const double *mass, *inertia;
    double* rows;
};

/// How velocities and positions advance in this step.
struct MotionStep {
    double dt;      ///< of the positions, s
    double kick_dt; ///< of the velocities, s: half a step at the start of velocity Verlet
    double newer;   ///< share of the new velocity in that at the time of the forces
    double gravity[3];
    BackgroundDamping damping;
    bool measure;
};

/// Moves spheres begin to end under the loads in their rows and empties these.
using MotionKernel = void (*)(const MotionView&, const MotionStep&, Scheme, std::size_t begin, std::size_t end, MotionSums&);

// The same source compiled for three instruction sets (core/CMakeLists.txt).
void motion_kernel_baseline(const MotionView&, const MotionStep&, Scheme, std::size_t, std::size_t, MotionSums&);
void motion_kernel_avx2(const MotionView&, const MotionStep&, Scheme, std::size_t, std::size_t, MotionSums&);
void motion_kernel_avx512(const MotionView&, const MotionStep&, Scheme, std::size_t, std::size_t, MotionSums&);

} // namespace proveta
