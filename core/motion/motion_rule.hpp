// What the motion kernels need to know of schemes and damping, free of everything else.
#pragma once

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

/// Sums over the spheres of one step.
struct MotionSums {
    double damping_work = 0.0; ///< taken out by background damping in the step, J
    double fastest = 0.0;      ///< largest speed, m/s
    double kinetic = 0.0;      ///< at the time of the forces (only when measuring), J
    double unbalanced = 0.0;   ///< sum of |F| over spheres (only when measuring), N
};

} // namespace proveta
