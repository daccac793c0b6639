// LS+D: linear spring and dashpot with Coulomb friction, for contacts that were never bonded and for spheres against surfaces.
//
// Reference: thesis 2.5.1.
//   normal      F_n = k_n delta + c_n delta',  never pulling (F_n >= 0), delta = overlap                      (2.15-2.16)
//   dashpot     c_n = 2 xi sqrt(m_eq k_n),  xi = -ln e / sqrt(pi^2 + ln^2 e)                                  (2.19-2.21)
//   tangential  incremental spring k_t, |F_t| <= mu F_n                                                       (2.31-2.32)
//
//   symbol   meaning                                  unit
//   delta    overlap: contact distance minus distance m
//   u_t      elastic tangential displacement          m
//   e        normal restitution, 0 < e <= 1           -
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/lanes.hpp"

namespace proveta::linear {

/// Damping ratio xi that gives restitution e while the spring may pull (2.21). e in (0, 1].
inline double damping_ratio(double restitution) {
    const double l = std::log(restitution);
    return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// One contact's constants. Units as in the table above; mu may be infinite (no slip).
template <class T> struct Parameters {
    T k_n; ///< N/m
    T k_t; ///< N/m
    T c_n; ///< N s/m
    T mu;
};

template <class T> struct Response {
    T normal;        ///< F_n with dashpot, N
    T shear[3];      ///< force of j on i, N
    T stored;        ///< energy of the springs, J
    T friction_work; ///< J
    T dashpot_work;  ///< J
};

/// One step of one contact. overlap in m (negative: apart), approach: its increase in the step, m; dt in s; slip in m; u_t is brought to
/// the end of the step. The dissipated energies are those of the trapezoidal rule.
template <class T>
inline Response<T> advance(const Parameters<T>& p, const T& overlap, const T& approach, double dt, const T (&slip)[3], T (&u_t)[3]) {
    using std::max;
    using std::sqrt;
    const T zero = T(0.0);
    const auto touching = overlap > zero;
    const T elastic = max(p.k_n * overlap, zero);
    const T viscous = select(touching, max(p.c_n * approach / dt, -elastic), zero);
    Response<T> r;
    r.normal = elastic + viscous;
    r.dashpot_work = viscous * approach;

    T trial[3];
    for (int c = 0; c < 3; ++c) {
        trial[c] = u_t[c] + slip[c];
    }
    const T force = p.k_t * sqrt(trial[0] * trial[0] + trial[1] * trial[1] + trial[2] * trial[2]);
    const T coulomb = select(touching, p.mu * r.normal, zero); // an infinite mu still needs contact
    const T scale = select(force > coulomb, coulomb / max(force, T(1e-300)), T(1.0));
    r.friction_work = zero;
    T u2 = zero;
    for (int c = 0; c < 3; ++c) {
        const T keep = trial[c] * scale;
        r.friction_work = r.friction_work + 0.5 * p.k_t * (u_t[c] + keep) * (trial[c] - keep);
        u_t[c] = keep;
        r.shear[c] = p.k_t * keep;
        u2 = u2 + keep * keep;
    }
    r.stored = 0.5 * (elastic * max(overlap, zero) + p.k_t * u2);
    return r;
}

} // namespace proveta::linear
