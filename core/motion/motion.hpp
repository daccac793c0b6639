// Newton's and Euler's equations for the spheres: loads collected, background damping, four explicit schemes.
#pragma once

#include "core/contacts/loads.hpp"
#include "core/motion/motion_rule.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// How the spheres move.
struct MotionRule {
    Scheme scheme = Scheme::velocity_verlet;
    BackgroundDamping damping;
    Vec3 gravity = Vec3::Zero(); ///< m/s2
    double kick = 0.0;           ///< of the velocities of velocity Verlet, s: half the last step and half this one; 0: as the positions
};

/// Moves one block of spheres: collects its loads, applies gravity and damping, advances velocities and positions by dt seconds and empties
/// the rows of the loads for the next step. first: the velocities are those of the positions' own time, as at the start of a test, so that
/// velocity Verlet begins with half a kick (table 2.1). `fastest` of the result is squared.
MotionSums move_spheres(Spheres& spheres, Loads& loads, const SphereBlock& block, const MotionRule& rule, double dt, bool first,
                        bool measure);

} // namespace proveta
