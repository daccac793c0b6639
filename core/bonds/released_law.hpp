// The cohesive bond as the released DEMpack code computes it, for comparison with that code. It differs from the thesis in most branches
// and is kept with its faults: unloading jumps, it is not energy-consistent, and a failed bond keeps pulling sideways.
//
// Reference: Kratos Multiphysics, DEMApplication, constitutive law DEM_Dempack (October 2019), read as a description; symbols as in
// dempack_law.hpp.
//
//   Compression  loading along the envelope of LCS and YRC. Below the largest shortening u_m so far: back along the same envelope while its
//                force there has not passed the yield stress, else straight from the largest force with slope k_n E_p / E.
//   Tension      k_n e up to F_t = sigma_f A at u_t, then F_t (1 - d), d = (e - u_t) / (s_n u_t) never decreasing: between u_t and the end
//                (1 + s_n) u_t the force is held while unloading; below u_t it is k_n e again.
//   Shear        increments of slope k_t times the ratio of the active branch of compression to k_n, or (1 - d) in tension. Once over
//                tau_f A + mu_s max(F_n, 0) it is latched: held at the limit times 1 - D, D the slip since then over c_s u_tau, u_tau =
//                limit / k_t; D >= 1, or c_s = 0, is failure.
//   After failure  compression only; no friction, but the shear force of that moment stays for good, turning with the bond.
#pragma once

#include <cmath>

#include "core/bonds/dempack_law.hpp"

namespace proveta::released {

/// The thesis law's parameters, used as above, and three of its own. Units as there.
struct Parameters : dempack::Parameters {
    double yield_stress = 20.0e6; ///< beyond it unloading is straight, Pa
    double plastic_ratio = 1.0;   ///< E_p / E
    double shear_energy = 1.0;    ///< c_s
};

/// State of dempack::State with other meanings: u_t shear force over k_t, u_p the largest shortening u_m, d_n the softening in tension,
/// d_t the slip of latched shear, brought between 0 and 1.
template <class T> using State = dempack::State<T>;

/// Slope of the envelope at elastic trial force k_n u, over k_n.
template <class T> PROVETA_INLINE T envelope_slope(const Parameters& p, const T& k_n, const T& area, const T& u) {
    T slope = T(1.0);
    T bend = p.lcs[0] * area;
    for (int b = 0; b < 3; ++b) {
        slope = select(k_n * u > bend, T(1.0 / p.yrc[b]), slope);
        if (b < 2) {
            bend = bend + (p.lcs[b + 1] - p.lcs[b]) * area * p.yrc[b];
        }
    }
    return slope;
}

/// Normal force at shortening u for the largest shortening `most` and softening d; `broken` bonds take compression only.
template <class T, class Mask>
PROVETA_INLINE T normal_force(const Parameters& p, const T& k_n, const T& area, const T& u, const T& most, const T& d, const Mask& broken) {
    using std::max;
    const T zero = T(0.0);
    const T along = dempack::compression_envelope(p, k_n, area, max(u, zero));
    const T top = dempack::compression_envelope(p, k_n, area, most);
    const auto straight = (u < most) && (top > p.yield_stress * area);
    const T pressed = select(straight, top - p.plastic_ratio * k_n * (most - u), along);
    const T limit = p.sigma_f * area;
    const T pulled = select(-k_n * u > limit, -limit * (T(1.0) - d), k_n * u);
    return select(u >= zero, pressed, select(broken, zero, pulled));
}

/// Energy that the law takes as stored, J: F_n^2 / (2 k_n) and k_t u_t^2 / 2.
template <class T>
PROVETA_INLINE T stored_energy(const Parameters& p, const T& k_n, const T& /*shortening*/, const T& normal, const State<T>& s) {
    const T u2 = s.u_t[0] * s.u_t[0] + s.u_t[1] * s.u_t[1] + s.u_t[2] * s.u_t[2];
    return 0.5 * normal * normal / k_n + 0.5 * k_n * p.shear_ratio * u2;
}

/// One step of one bond; arguments as dempack::advance. What the law gains or loses beyond its stored energy (`stored_energy`) is booked as
/// plastic work in compression and as damage in tension and shear, and may be negative: the law's jumps make energy.
template <class T>
PROVETA_INLINE dempack::Response<T> advance(const Parameters& p, const T& k_n, const T& area, const dempack::Kinematics<T>& kin,
                                            State<T>& s) {
    using std::max;
    using std::min;
    using std::sqrt;
    const T zero = T(0.0);
    const T one = T(1.0);
    const T tiny = T(dempack::smallest);
    const T k_t = k_n * p.shear_ratio;
    const auto was_broken = (s.d_n >= one) || (s.d_t >= one);
    const T normal_before = normal_force(p, k_n, area, kin.shortening - kin.approach, s.u_p, s.d_n, was_broken);
    const T stored_before = stored_energy(p, k_n, zero, normal_before, s);

    // Normal direction.
    const T u_l = max(p.sigma_f * area / k_n, tiny);
    const T softening = min(max((-kin.shortening - u_l) / (p.softening_n * u_l), zero), one);
    s.d_n = select(was_broken, s.d_n, max(s.d_n, softening));
    s.u_p = max(s.u_p, kin.shortening);
    dempack::Response<T> r{zero, {zero, zero, zero}, zero, zero, zero};
    const auto torn = was_broken || (s.d_n >= one);
    r.normal = normal_force(p, k_n, area, kin.shortening, s.u_p, s.d_n, torn);

    // Shear. The branch of compression that is active sets the slope; in tension the softening does.
    const auto straight = (kin.shortening < s.u_p) && (dempack::compression_envelope(p, k_n, area, s.u_p) > p.yield_stress * area);
    const T slope = select(kin.shortening >= zero, select(straight, T(p.plastic_ratio), envelope_slope(p, k_n, area, s.u_p)), one - s.d_n);
    const auto was_latched = s.d_t > zero;
    T old[3];
    T trial2 = zero;
    T slip2 = zero;
    for (int c = 0; c < 3; ++c) {
        old[c] = s.u_t[c];
        s.u_t[c] = select(was_latched, old[c], old[c] + slope * kin.slip[c]);
        trial2 = trial2 + s.u_t[c] * s.u_t[c];
        slip2 = slip2 + kin.slip[c] * kin.slip[c];
    }
    const T limit = (p.tau_f * area + p.mu_s * max(r.normal, zero)) / max(k_t, tiny); // u_tau
    const T trial = sqrt(trial2);
    const auto latched = was_latched || (trial > limit);
    // Slip since latching over c_s u_tau without normal force, x, is kept as x / (1 + x), which stays below 1 until the bond fails; a
    // latched bond keeps a trace of it even if it does not slip.
    const T unit = max(T(p.shear_energy * p.tau_f) * area / max(k_t, tiny), tiny);
    const T x = select(latched, s.d_t / max(one - s.d_t, tiny) + max(sqrt(slip2) / unit, T(1e-15)), zero);
    const T share = p.shear_energy > 0.0 ? x * unit / max(p.shear_energy * limit, tiny) : one; // D
    const auto sheared = latched && (share >= one);
    s.d_t = select(was_broken, s.d_t, select(sheared, one, x / (one + x)));
    const auto broken = torn || sheared;
    const T held = select(latched, (one - share) * limit / max(trial, tiny), one);
    for (int c = 0; c < 3; ++c) {
        s.u_t[c] = select(torn, old[c], s.u_t[c] * held);
        r.shear[c] = k_t * s.u_t[c];
    }
    r.normal = normal_force(p, k_n, area, kin.shortening, s.u_p, s.d_n, broken);

    T work = 0.5 * (normal_before + r.normal) * kin.approach;
    for (int c = 0; c < 3; ++c) {
        work = work + 0.5 * (k_t * old[c] + r.shear[c]) * kin.slip[c];
    }
    const T lost = work - (stored_energy(p, k_n, zero, r.normal, s) - stored_before);
    const auto elastic = !(latched || broken || straight || (s.d_n > zero) || (slope < one));
    const T booked = select(elastic, zero, lost);
    r.plastic_work = select(kin.shortening >= zero && !latched, booked, zero);
    r.damage_work = booked - r.plastic_work;
    return r;
}

/// As dempack::failure_criterion: the larger of shear over its limit and tension over sigma_f A.
template <class T>
PROVETA_INLINE T failure_criterion(const Parameters& p, const T& /*k_n*/, const T& area, const T& /*shortening*/, const T& normal,
                                   const T& shear, const State<T>& s) {
    using std::max;
    using std::min;
    const T zero = T(0.0);
    const T in_shear = shear / max(p.tau_f * area + p.mu_s * max(normal, zero), T(dempack::smallest));
    const T tension = max(-normal, zero) / max(p.sigma_f * area, T(dempack::smallest));
    const auto broken = (s.d_n >= T(1.0)) || (s.d_t >= T(1.0));
    return select(broken, T(1.0), min(max(in_shear, tension), T(1.0)));
}

} // namespace proveta::released
