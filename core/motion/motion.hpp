// Newton's and Euler's equations for the spheres: forces gathered, background damping, velocity Verlet in its leapfrog form.
#pragma once

#include "core/bonds/bonds.hpp"
#include "core/contacts/contacts.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Background damping (5.18-5.19): F_damp = -alpha_t |F| v / |v|, T_damp = -alpha_r |T| w / |w|.
struct BackgroundDamping {
    double translation = 0.2; ///< alpha_t, 0 to 1
    double rotation = 0.2;    ///< alpha_r, 0 to 1
};

/// Sums over the spheres of one step.
struct MotionSums {
    double damping_work = 0.0; ///< taken out by background damping in the step, J
    double fastest = 0.0;      ///< largest speed, m/s
    double kinetic = 0.0;      ///< at the time of the forces (only when measuring), J
    double unbalanced = 0.0;   ///< sum of |F| over spheres (only when measuring), N
};

/// Sums pair forces per sphere in a fixed order, applies damping and advances velocities and positions by dt: v(t + dt/2) from
/// v(t - dt/2) and F(t), x(t + dt) from v(t + dt/2) (table 2.1). Clears the external forces for the next step.
MotionSums move_spheres(Spheres& spheres, const Bonds& bonds, const Contacts& contacts, const BackgroundDamping& damping, double dt,
                        bool measure);

} // namespace proveta
