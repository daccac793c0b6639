// Rotation of rigid bodies of any inertia: direct explicit integration of Euler's equations, and RK4 on quaternions.
//
// Reference: thesis 2.7 after A. Munjiza, J.P. Latham, N.W.M. John, Int. J. Numer. Meth. Engng 56, 35-55 (2003).
//   momentum   H(n+1) = H(n) + dt T                                                                        (2.92)
//   spin       w = q (I'^-1 (q^-1 H))                                                                      (2.93-2.94)
//   stages     w1 = w(n), w2 at q(w1, dt/2) q, w3 at q(w2, dt/2) q, w4 at q(w3, dt) q, all with H(n+1)      (2.95-2.96)
//   attitude   q(n+1) = q((w1 + 2 w2 + 2 w3 + w4)/6, dt) q(n),  w(n+1) from it                              (2.97)
//   direct     I' w' (n+1) = I' w' (n) + dt (T' - w' x I' w') in the body's frame                           (2.99)
//
//   symbol   meaning                                                  unit
//   q        attitude: turns the body's principal frame into space    -
//   I'       principal moments of inertia                             kg m2
//   H, T     angular momentum, torque, in space                       N m s, N m
//   w        spin, in space                                           rad/s
//
// The RK4 of (2.95-2.97) averages rotation vectors without the commutators of a Lie group method: its angular momentum is exact, its
// attitude of second order where the spin turns.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/vector_field.hpp"

namespace proveta::rotation {

using Quaternion = Eigen::Quaterniond;

/// A rotating body. `spin` and `momentum` belong together; `start` makes them so.
struct State {
    Quaternion attitude = Quaternion::Identity();
    Vec3 inertia = Vec3::Ones();  ///< principal, kg m2
    Vec3 spin = Vec3::Zero();     ///< in space, rad/s
    Vec3 momentum = Vec3::Zero(); ///< in space, N m s
};

/// The turn by a constant spin over dt seconds (2.79, 2.98).
inline Quaternion turn(const Vec3& spin, double dt) {
    const Vec3 half = 0.5 * dt * spin;
    const double angle = half.norm();
    const double s = angle > 1e-8 ? std::sin(angle) / angle : 1.0 - angle * angle / 6.0;
    return {std::cos(angle), s * half.x(), s * half.y(), s * half.z()};
}

/// Spin of a body with this attitude and angular momentum.
inline Vec3 spin_of(const Quaternion& attitude, const Vec3& inertia, const Vec3& momentum) {
    return attitude * (attitude.conjugate() * momentum).cwiseQuotient(inertia);
}

/// A body with principal moments of inertia, an attitude and a spin in space.
inline State start(const Vec3& inertia, const Quaternion& attitude, const Vec3& spin) {
    return {attitude, inertia, spin, attitude * inertia.cwiseProduct(attitude.conjugate() * spin)};
}

/// Rotational energy, J.
inline double energy(const State& s) { return 0.5 * s.spin.dot(s.momentum); }

/// One step of dt seconds under a constant torque in space, RK4 on quaternions.
inline void advance_rk4(State& s, const Vec3& torque, double dt) {
    s.momentum += dt * torque;
    const auto at = [&](const Vec3& spin, double time) { return spin_of(turn(spin, time) * s.attitude, s.inertia, s.momentum); };
    const Vec3 w1 = s.spin;
    const Vec3 w2 = at(w1, 0.5 * dt);
    const Vec3 w3 = at(w2, 0.5 * dt);
    const Vec3 w4 = at(w3, dt);
    s.attitude = (turn((w1 + 2.0 * w2 + 2.0 * w3 + w4) / 6.0, dt) * s.attitude).normalized();
    s.spin = spin_of(s.attitude, s.inertia, s.momentum);
}

/// The same step by direct explicit integration.
inline void advance_direct(State& s, const Vec3& torque, double dt) {
    const Vec3 w = s.attitude.conjugate() * s.spin;
    const Vec3 t = s.attitude.conjugate() * torque;
    const Vec3 local = w + dt * (t - w.cross(s.inertia.cwiseProduct(w))).cwiseQuotient(s.inertia);
    s.attitude = (turn(s.spin, dt) * s.attitude).normalized();
    s.spin = s.attitude * local;
    s.momentum = s.attitude * s.inertia.cwiseProduct(local);
}

} // namespace proveta::rotation
