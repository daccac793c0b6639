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

#include "core/laws/bond/dempack_law.hpp"

namespace proveta {

struct KratosDempack {
    static constexpr const char* name = "kratos_dempack";
    static constexpr const char* meaning = "the bond as the released DEMpack code computes it; for comparison with it";
    static constexpr bool asks_volumetric_strain = false;

    /// The card's numbers. Defaults: thesis, table 5.5.
    struct Parameters {
        double sigma_f = 5.0e6;                   ///< tensile strength, Pa
        double tau_f = 16.0e6;                    ///< shear strength without normal force, Pa
        double mu_s = 0.9;                        ///< internal friction of the intact bond
        double softening_n = 0.2;                 ///< s_n, length of the softening branch in tension over u_t
        double lcs[3] = {20.0e6, 45.0e6, 70.0e6}; ///< stresses where the compression envelope changes slope, ascending, Pa
        double yrc[3] = {3.0, 12.0, 22.0};        ///< k_n over the slope beyond each of them, >= 1
        double yield_stress = 20.0e6;             ///< beyond it unloading is straight, Pa
        double plastic_ratio = 1.0;               ///< E_p / E
        double shear_energy = 1.0;                ///< c_s
    };
    struct Constants : Parameters, BondBasis {};

    /// State of Dempack with other meanings: u_t shear force over k_t, u_p the largest shortening u_m, d_n the softening in tension, d_t
    /// the slip of latched shear, brought between 0 and 1.
    template <class T> using State = Dempack::State<T>;
    template <class S, class F> PROVETA_INLINE static void members(S& s, F&& f) { Dempack::members(s, f); }

    template <class V> static void declare(V& v, Parameters& p) {
        v.number("sigma_f", p.sigma_f, V::Unit::pressure, V::at_least(0), "tensile strength of a bond (5.21)");
        v.number("tau_f", p.tau_f, V::Unit::pressure, V::at_least(0), "shear strength of a bond without normal force (5.21)");
        v.number("mu_s", p.mu_s, V::Unit::none, V::between(0, 10), "internal friction of an intact bond (5.21)");
        v.number("softening_tension", p.softening_n, V::Unit::none, V::between(1e-6, 1e6),
                 "length of the softening branch in tension over the limit displacement, u_f/u_l - 1 (5.24)");
        v.numbers("lcs", p.lcs, V::Unit::pressure, V::above(0),
                  "compressive stresses LCS1 to LCS3 where the envelope changes slope (5.28)");
        v.numbers("yrc", p.yrc, V::Unit::none, V::at_least(1),
                  "ratios YRC1 to YRC3 of the initial slope to the slope beyond each LCS (5.28)");
        v.number("yield_stress", p.yield_stress, V::Unit::pressure, V::at_least(0), "stress beyond which unloading is straight");
        v.number("plastic_modulus_ratio", p.plastic_ratio, V::Unit::none, V::between(0, 1),
                 "E_p / E, slope of that unloading over the initial one");
        v.number("shear_energy", p.shear_energy, V::Unit::none, V::at_least(0),
                 "slip to failure past the shear limit over the displacement at the limit; 0: at once");
    }

    static Parameters mix(const Parameters& a, const Parameters& b);
    static Parameters scaled(Parameters p, double factor);
    static Constants constants(const Parameters& p, const BondBasis& basis) { return {p, basis}; }
    static double tensile_limit(const Constants& c) { return c.sigma_f; }

    /// Slope of the envelope at elastic trial force k_n u, over k_n.
    template <class T> PROVETA_INLINE static T envelope_slope(const Constants& p, const T& k_n, const T& area, const T& u) {
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
    PROVETA_INLINE static T normal_force(const Constants& p, const T& k_n, const T& area, const T& u, const T& most, const T& d,
                                         const Mask& broken) {
        using std::max;
        const T zero = T(0.0);
        const T along = Dempack::compression_envelope(p, k_n, area, max(u, zero));
        const T top = Dempack::compression_envelope(p, k_n, area, most);
        const auto straight = (u < most) && (top > p.yield_stress * area);
        const T pressed = select(straight, top - p.plastic_ratio * k_n * (most - u), along);
        const T limit = p.sigma_f * area;
        const T pulled = select(-k_n * u > limit, -limit * (T(1.0) - d), k_n * u);
        return select(u >= zero, pressed, select(broken, zero, pulled));
    }

    /// Energy that the law takes as stored, J: F_n^2 / (2 k_n) and k_t u_t^2 / 2.
    template <class T>
    PROVETA_INLINE static T stored_energy(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& /*kin*/, const T& normal,
                                          const State<T>& s) {
        const T& k_n = bond.k_n;
        const T u2 = s.u_t[0] * s.u_t[0] + s.u_t[1] * s.u_t[1] + s.u_t[2] * s.u_t[2];
        return 0.5 * normal * normal / k_n + 0.5 * k_n * p.shear_ratio * u2;
    }

    /// One step of one bond; arguments as Dempack::advance. What the law gains or loses beyond its stored energy (`stored_energy`) is
    /// booked as plastic work in compression and as damage in tension and shear, and may be negative: the law's jumps make energy.
    template <class T>
    PROVETA_INLINE static BondResponse<T> advance(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, State<T>& s) {
        using std::max;
        using std::min;
        using std::sqrt;
        const T zero = T(0.0);
        const T one = T(1.0);
        const T tiny = T(smallest);
        const T& k_n = bond.k_n;
        const T& area = bond.area;
        const T k_t = k_n * p.shear_ratio;
        const auto was_broken = (s.d_n >= one) || (s.d_t >= one);
        const T normal_before = normal_force(p, k_n, area, kin.shortening - kin.approach, s.u_p, s.d_n, was_broken);
        const T stored_before = stored_energy(p, bond, kin, normal_before, s);

        // Normal direction.
        const T u_l = max(p.sigma_f * area / k_n, tiny);
        const T softening = min(max((-kin.shortening - u_l) / (p.softening_n * u_l), zero), one);
        s.d_n = select(was_broken, s.d_n, max(s.d_n, softening));
        s.u_p = max(s.u_p, kin.shortening);
        BondResponse<T> r{zero, {zero, zero, zero}, zero, zero, zero};
        const auto torn = was_broken || (s.d_n >= one);
        r.normal = normal_force(p, k_n, area, kin.shortening, s.u_p, s.d_n, torn);

        // Shear. The branch of compression that is active sets the slope; in tension the softening does.
        const auto straight = (kin.shortening < s.u_p) && (Dempack::compression_envelope(p, k_n, area, s.u_p) > p.yield_stress * area);
        const T slope =
            select(kin.shortening >= zero, select(straight, T(p.plastic_ratio), envelope_slope(p, k_n, area, s.u_p)), one - s.d_n);
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
        const T lost = work - (stored_energy(p, bond, kin, r.normal, s) - stored_before);
        const auto elastic = !(latched || broken || straight || (s.d_n > zero) || (slope < one));
        const T booked = select(elastic, zero, lost);
        r.plastic_work = select(kin.shortening >= zero && !latched, booked, zero);
        r.damage_work = booked - r.plastic_work;
        return r;
    }

    /// As Dempack::failure_criterion: the larger of shear over its limit and tension over sigma_f A.
    template <class T>
    PROVETA_INLINE static T failure_criterion(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& /*kin*/, const T& normal,
                                              const T& shear, const State<T>& s) {
        const T& area = bond.area;
        using std::max;
        using std::min;
        const T zero = T(0.0);
        const T in_shear = shear / max(p.tau_f * area + p.mu_s * max(normal, zero), T(smallest));
        const T tension = max(-normal, zero) / max(p.sigma_f * area, T(smallest));
        const auto broken = (s.d_n >= T(1.0)) || (s.d_t >= T(1.0));
        return select(broken, T(1.0), min(max(in_shear, tension), T(1.0)));
    }

    template <class T> PROVETA_INLINE static auto failed(const State<T>& s) { return Dempack::failed(s); }
    template <class T> PROVETA_INLINE static auto failed_in_shear(const State<T>& s) { return Dempack::failed_in_shear(s); }
    template <class T> PROVETA_INLINE static T intact(const State<T>& s) { return Dempack::intact(s); }
    static void fail(State<double>& s, FailureMode mode) { Dempack::fail(s, mode); }
};

} // namespace proveta
