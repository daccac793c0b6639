// LS+D: linear spring and dashpot with Coulomb friction, for contacts that were never bonded and for spheres against surfaces.
//
// Reference: thesis 2.5.1.
//   normal      F_n = k_n delta + c_n delta',  never pulling (F_n >= 0) unless told to, delta = overlap       (2.15-2.17)
//   dashpots    c_n = 2 xi sqrt(m_eq k_n),  c_t = 2 xi sqrt(m_eq k_t),  xi from restitution.hpp                (2.19-2.21)
//   tangential  incremental spring k_t and dashpot c_t, both inside the Coulomb check                          (2.31-2.32)
//
//   symbol   meaning                                  unit
//   delta    overlap: contact distance minus distance m
//   u_t      elastic tangential displacement          m
#pragma once

#include "core/contacts/contact_law.hpp"

namespace proveta::linear {

/// One contact's constants; mu may be infinite (no slip). With `tension` the normal spring acts both ways, apart as well as in contact:
/// the oscillator of textbooks; with both the contact is glued.
template <class T> struct Parameters {
    T k_n; ///< N/m
    T k_t; ///< N/m
    T c_n; ///< N s/m
    T c_t; ///< N s/m
    T mu;
    bool tension = false;
    bool impacts = false; ///< with the corrections of contact_law.hpp
    T mass = T(1.0);      ///< reduced, kg; for these
};

/// One step of one contact. overlap in m (negative: apart), approach: its increase in the step, m; dt in s; slip: tangential displacement
/// in the step, m; the state is brought to the end of the step. The dissipated energies are those of the trapezoidal rule.
template <class T>
PROVETA_INLINE contact::Response<T> advance(const Parameters<T>& p, const T& overlap, const T& approach, double dt, const T (&slip)[3],
                                            contact::State<T>& s) {
    using std::max;
    const T lowest = T(contact::lowest_force(p.tension));
    const auto touching = overlap > lowest;
    const T elastic = max(p.k_n * overlap, lowest);
    T dashpot = p.c_n;
    if (p.impacts) {
        dashpot = contact::lagging(p.c_n, dt, p.mass) * select(overlap < approach, contact::begun(overlap, approach), T(1.0));
    }
    const T viscous = select(touching, max(dashpot * (approach / dt), lowest - elastic), T(0.0));
    contact::Response<T> r;
    r.normal = elastic + viscous;
    r.stored = 0.5 * elastic * max(overlap, lowest);
    r.friction_work = T(0.0);
    r.dashpot_work = 0.5 * (s.viscous + viscous) * approach;
    s.viscous = viscous;
    // An infinite mu still needs pressure, unless the contact may pull.
    const T apart = p.tension ? select(p.mu > T(1e300), p.mu, T(0.0)) : T(0.0);
    const T limit = select(r.normal > T(0.0), p.mu * r.normal, apart);
    contact::coulomb(p.k_t, p.c_t, limit, touching, dt, slip, s, r);
    return r;
}

} // namespace proveta::linear
