// HM+D: Hertzian normal spring, tangential spring of Mindlin's no-slip theory, dashpots and Coulomb friction.
//
// Reference: thesis 2.5.2 after C. Thornton, S.J. Cummins, P.W. Cleary, Powder Technology 233, 30-46 (2013); appendix A.
//   stiffness   k_n = 2 E* sqrt(R_eq delta),  k_t = 8 G* sqrt(R_eq delta)                                     (2.38)
//   normal      F_n = 2/3 k_n delta + c_n delta',  never pulling unless told to; k_n = dF_n/d delta           (2.35)
//   dashpots    c_n = 2 xi sqrt(m_eq k_n),  c_t = 2 xi sqrt(m_eq k_t)                                          (2.39)
//   tangential  loading keeps the old force, unloading scales it by k_t(new)/k_t(old); then k_t slip          (2.36)
//   sliding     spring and dashpot together at most mu F_n                                                     (2.37)
//
//   symbol   meaning                                          unit
//   delta    overlap                                          m
//   E*, G*   equivalent moduli (2.40c-d, against walls 2.41)  Pa
//   u_t      F_te / k_t: unloading keeps it                   m
//
// A spring whose stiffness changes under load gives energy away: F^2/2 (1/k_old - 1/k_new) when it stiffens under the same force,
// (k_old - k_new) u (u + slip)/2 when it softens under the same displacement. Both are slip of the contact's rim and count as friction.
#pragma once

#include "core/contacts/contact_law.hpp"

namespace proveta::hertz {

/// One contact's constants, each the quantity of its name at an overlap of one metre; mu may be infinite. With `tension` the dashpot may
/// pull as long as the spheres overlap.
template <class T> struct Parameters {
    T k_n; ///< 2 E* sqrt(R_eq): k_n over delta^(1/2), N/m^(3/2)
    T k_t; ///< 8 G* sqrt(R_eq), N/m^(3/2)
    T c_n; ///< 2 xi sqrt(m_eq k_n): c_n over delta^(1/4), N s/m^(5/4)
    T c_t; ///< N s/m^(5/4)
    T mu;
    bool tension = false;
    bool impacts = false; ///< with the corrections of contact_law.hpp
    T mass = T(1.0);      ///< reduced, kg; for these
};

/// One step of one contact; arguments as in `linear::advance`. The overlap of the last step is overlap - approach.
template <class T>
PROVETA_INLINE contact::Response<T> advance(const Parameters<T>& p, const T& overlap, const T& approach, double dt, const T (&slip)[3],
                                            contact::State<T>& s) {
    using std::max;
    using std::sqrt;
    const T zero = T(0.0);
    const T delta = max(overlap, zero);
    const T root = sqrt(delta);
    const T fourth_root = sqrt(root);
    const T k_n = p.k_n * root;
    const T k_t = p.k_t * root;
    const auto touching = overlap > zero;

    const T elastic = (2.0 / 3.0) * k_n * delta;
    T dashpot = p.c_n * fourth_root;
    if (p.impacts) {
        // Of a contact that begins: the mean of c over n steps, as it grows with the fourth root of the way, times n.
        const T n = contact::begun(overlap, approach);
        const T first = 0.8 * p.c_n * n * sqrt(sqrt(max(n * approach, zero)));
        dashpot = contact::lagging(T(select(overlap < approach, first, dashpot)), dt, p.mass);
    }
    const T viscous = select(touching, max(dashpot * (approach / dt), T(contact::lowest_force(p.tension)) - elastic), zero);
    contact::Response<T> r;
    r.normal = elastic + viscous;
    r.stored = 0.4 * elastic * delta;
    r.friction_work = zero;
    r.dashpot_work = 0.5 * (s.viscous + viscous) * approach;
    s.viscous = viscous;

    const T k_old = p.k_t * sqrt(max(overlap - approach, zero));
    const auto loading = k_t >= k_old;
    const T ratio = select(k_t > k_old, k_old / max(k_t, T(1e-300)), T(1.0));
    for (int c = 0; c < 3; ++c) {
        const T u = s.u_t[c];
        r.friction_work = r.friction_work + select(loading, 0.5 * k_old * u * u * (1.0 - ratio), 0.5 * (k_old - k_t) * u * (u + slip[c]));
        s.u_t[c] = u * ratio; // unloading: ratio 1
    }
    const T limit = select(r.normal > zero, p.mu * r.normal, zero);
    contact::coulomb(k_t, T(p.c_t * fourth_root), limit, touching, dt, slip, s, r);
    return r;
}

} // namespace proveta::hertz
