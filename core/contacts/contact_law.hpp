// What the loose contact laws share: the state of a contact, what a step gives back, and the Coulomb check (thesis 2.32, 2.37).
//
//   trial   F = k_t (u_t + slip) + c_t v_t;  beyond mu F_n the whole of it, spring and dashpot, is scaled back to mu F_n
//
// A normal dashpot makes the restitution of an impact first order in the step, for two reasons. The speed in it is that of half a step
// before, c (v - dt/2 a), as if the reduced mass m were m - c dt/2: with q = c dt/(4 m) a dashpot of c (sqrt(1 + q^2) - q) has on that mass
// the damping ratio that c has on m, and restitution depends on nothing else. And the force of a contact's first step acts for a whole step
// though the contact lasts only for the share s of the one before and half of the one to come: it is given the impulse of s + 1/2 steps at
// the speed of the impact. With both the restitution is second order. Loose matter has them (`ContactStep::impacts`); in bonded
// specimens contacts close slowly.
//
//   symbol   meaning                                      unit
//   u_t      elastic tangential displacement, F_te / k_t  m
//   v_t      speed of j's contact point against i's       m/s
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/lanes.hpp"

namespace proveta::contact {

/// What a contact remembers. The dashpots' forces of the last step are kept so that their work is that of the trapezoidal rule.
template <class T> struct State {
    T u_t[3];       ///< m
    T viscous;      ///< normal force of the dashpot at the last step, N
    T viscous_t[3]; ///< tangential force of the dashpot at the last step, N
};

template <class T> struct Response {
    T normal;        ///< F_n with dashpot, compression positive, N
    T shear[3];      ///< force of j on i, N
    T stored;        ///< energy of the springs, J
    T friction_work; ///< by sliding and micro-slip in the step, J
    T dashpot_work;  ///< J
};

/// Lowest normal force of a contact.
PROVETA_INLINE double lowest_force(bool tension) { return tension ? -std::numeric_limits<double>::infinity() : 0.0; }

/// A dashpot c in N s/m that sees a speed half of dt seconds old, on a reduced mass in kg.
template <class T> PROVETA_INLINE T lagging(const T& c, double dt, const T& mass) {
    using std::sqrt;
    const T q = 0.25 * dt * c / mass;
    return c * (sqrt(1.0 + q * q) - q);
}

/// Steps that a contact which begins with this approach (m) and overlap (m) lasts until half of the next step: s + 1/2, s below 1.
template <class T> PROVETA_INLINE T begun(const T& overlap, const T& approach) {
    using std::max;
    return overlap / max(approach, T(1e-300)) + 0.5;
}

/// The tangential half of a step: k_t, c_t in N/m and N s/m, limit = mu F_n in N, slip in m, dt in s. Brings u_t and viscous_t to the end
/// of the step and adds the works; `stored` gets the tangential spring's energy. Without contact the spring is lost to friction.
template <class T, class Mask>
PROVETA_INLINE void coulomb(const T& k_t, const T& c_t, const T& limit, const Mask& touching, double dt, const T (&slip)[3], State<T>& s,
                            Response<T>& r) {
    using std::max;
    using std::sqrt;
    T spring[3];
    T dashpot[3];
    T size = T(0.0);
    for (int c = 0; c < 3; ++c) {
        spring[c] = s.u_t[c] + slip[c];
        dashpot[c] = c_t * (slip[c] / dt);
        const T trial = k_t * spring[c] + dashpot[c];
        size = size + trial * trial;
    }
    size = sqrt(size);
    const T scale = select(touching, select(size > limit, limit / max(size, T(1e-300)), T(1.0)), T(0.0));
    T u2 = T(0.0);
    for (int c = 0; c < 3; ++c) {
        const T keep = spring[c] * scale;
        const T viscous = dashpot[c] * scale;
        r.friction_work = r.friction_work + 0.5 * k_t * (s.u_t[c] + keep) * (spring[c] - keep);
        r.dashpot_work = r.dashpot_work + 0.5 * (s.viscous_t[c] + viscous) * slip[c];
        r.shear[c] = k_t * keep + viscous;
        u2 = u2 + keep * keep;
        s.u_t[c] = keep;
        s.viscous_t[c] = viscous;
    }
    r.stored = r.stored + 0.5 * (k_t * u2);
}

} // namespace proveta::contact
