// Rolling resistance: a torque against the relative spin of two bodies in contact.
//
// Reference: thesis 2.5.4, T = -eta_r R_r |F_n| w_rel/|w_rel| (2.42), R_r the smaller radius, the sphere's own against a wall; after
// C.M. Wensrich, A. Katterfeld, Powder Technology 217, 409-417 (2012), model A.
//
// (2.42) as it stands flips its sign every step once w_rel is small. Here the torque is at most a share of the one that would stop the
// relative spin within a step, T <= share I_eq |w_rel| / dt: near rest it is a viscous torque that lets the spin die out over some twenty
// steps. The share is small enough for a sphere with many contacts, each of which does this without knowing of the others, never to
// overshoot: twenty neighbours at once may take all of the spin and no more. The torque thus never drives motion. It does not hold a sphere
// still on a slope either: below the slope eta_r the sphere creeps.
//
//   symbol   meaning                                          unit
//   arm      eta_r R_r                                        m
//   I_eq     I_i I_j / (I_i + I_j), against a wall I_i        kg m2
//   w_rel    spin of i minus spin of j                        rad/s
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/lanes.hpp"

namespace proveta::rolling {

/// Share of the relative spin that one contact may take out in a step.
constexpr double share = 0.05;

template <class T> struct Response {
    T torque[3]; ///< on i, the opposite on j, N m
    T power;     ///< dissipated, W
};

/// Torque for the normal force F_n >= 0 in N and the relative spin in rad/s; dt in s.
template <class T>
PROVETA_INLINE Response<T> torque(const T& arm, const T& normal, const T& reduced_inertia, const T (&spin)[3], double dt) {
    using std::max;
    using std::min;
    using std::sqrt;
    const T size = sqrt(spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2]);
    const T full = arm * max(normal, T(0.0));
    const T moment = min(full, share * reduced_inertia * size / dt);
    Response<T> r;
    for (int c = 0; c < 3; ++c) {
        r.torque[c] = -moment * spin[c] / max(size, T(1e-300));
    }
    r.power = moment * size;
    return r;
}

} // namespace proveta::rolling
