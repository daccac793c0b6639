// Newton's and Euler's equations for the spheres: forces gathered, background damping, four explicit schemes.
#pragma once

#include "core/bonds/bonds.hpp"
#include "core/contacts/contacts.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Explicit integration schemes (2.6.1). Velocities are those of the last half step for velocity Verlet, of whole steps for the others.
enum class Scheme {
    velocity_verlet,  ///< v(t + dt/2) = v(t - dt/2) + dt a(t), x(t + dt) = x(t) + dt v(t + dt/2)     (2.57-2.58)
    symplectic_euler, ///< v(t + dt) = v(t) + dt a(t), x(t + dt) = x(t) + dt v(t + dt)                (2.49-2.50)
    forward_euler,    ///< the same with x(t + dt) = x(t) + dt v(t); unstable without damping         (2.46-2.47)
    taylor            ///< the same with x(t + dt) = x(t) + dt v(t) + dt^2/2 a(t); unstable likewise  (2.51-2.52)
};

/// Background damping. Non-viscous (5.18-5.19): F_damp = -alpha_t |F| v / |v|, T_damp = -alpha_r |T| w / |w|. Viscous: F_damp = -c_t m v,
/// T_damp = -c_r I w with the mean velocity of the step, which leaves the stable step as it is.
struct BackgroundDamping {
    double translation = 0.2; ///< alpha_t, 0 to 1; viscous: c_t, 1/s
    double rotation = 0.2;    ///< alpha_r, 0 to 1; viscous: c_r, 1/s
    bool viscous = false;
};

/// How the spheres move.
struct MotionRule {
    Scheme scheme = Scheme::velocity_verlet;
    BackgroundDamping damping;
    Vec3 gravity = Vec3::Zero(); ///< m/s2
};

/// Sums over the spheres of one step.
struct MotionSums {
    double damping_work = 0.0; ///< taken out by background damping in the step, J
    double fastest = 0.0;      ///< largest speed, m/s
    double kinetic = 0.0;      ///< at the time of the forces (only when measuring), J
    double unbalanced = 0.0;   ///< sum of |F| over spheres (only when measuring), N
};

/// Sums pair forces per sphere in a fixed order, applies gravity and damping and advances velocities and positions by dt. first: the
/// velocities are those of the positions' own time, as at the start of a test, so that velocity Verlet begins with half a kick (table
/// 2.1). Clears the external forces for the next step.
MotionSums move_spheres(Spheres& spheres, const Bonds& bonds, const Contacts& contacts, const MotionRule& rule, double dt, bool first,
                        bool measure);

} // namespace proveta
