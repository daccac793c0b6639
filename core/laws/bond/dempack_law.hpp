// The cohesive bond of the DEMpack model: elasto-damage in tension and shear, elasto-plasticity in compression, uncoupled Mohr-Coulomb
// failure, friction afterwards.
//
// Reference: M. Santasusana, "Numerical techniques for non-linear analysis of structures combining discrete element and finite element
// methods", thesis, UPC Barcelona, chapter 5; E. Onate et al., Comput. Part. Mech. 2 (2015) 301. Equation numbers are the thesis's.
//
//   symbol         meaning                                                      unit
//   d, d0          distance of the centres, now and at the start                m
//   u_n            shortening d0 - d, positive in compression                   m
//   u_p            plastic shortening                                           m
//   e              elongation -(u_n - u_p), positive in tension                 m
//   u_t            elastic tangential displacement at the contact point         m
//   A              contact area                                                 m2
//   k_n, k_t       stiffness a E A / d0 and b G A / d0 (5.34)                   N/m
//   d_n, d_t       damage in tension and in shear, 0 to 1, never decreasing     -
//
// Tension      F = -(1 - d_n) k_n e, damage from u_l = sigma_f A / k_n to u_f                              (5.20-5.24)
// Compression  F = min(k_n (u_n - u_p), envelope(u_n)); what lies above the envelope becomes plastic       (5.27-5.28)
// Shear        F = (1 - d_t) k_t u_t, damage from u_l = (tau_f A + mu_s max(F_n, 0)) / k_t to u_f          (5.20-5.24)
// Softening    by ratio, u_f = (1 + s) u_l:   d = (u - u_l) / (u_f - u_l), a parabola, as the thesis has it (5.23-5.24)
//              by fracture energy G:          d = (u_f / u) (u - u_l) / (u_f - u_l), a straight line in force that dissipates G A;
//                u_f = 2 G_f / sigma_f in tension; in shear the branch has the length 2 G_s / tau_f - tau_f A / k_t under any normal force
// After failure  no cohesion, same stiffnesses, Coulomb friction mu_d; the tangential spring starts anew at zero (5.2.5), so that a
//                failure never creates energy. Contact distance d0 - u_p, so that the normal force is continuous.
//
// Energies are those that a trapezoidal rule over the step gives, so the ledger closes to round-off whatever the step.
#pragma once

#include "core/laws/bond_point.hpp"

namespace proveta {

struct Dempack {
    static constexpr const char* name = "dempack";
    static constexpr const char* meaning = "the thesis's bond: elasto-damage, elasto-plastic compression, friction after failure (5.2)";
    static constexpr bool asks_volumetric_strain = false;

    /// The card's numbers. Defaults: thesis, table 5.5.
    struct Parameters {
        double sigma_f = 5.0e6;                   ///< tensile strength, Pa
        double tau_f = 16.0e6;                    ///< shear strength without normal force, Pa
        double mu_s = 0.9;                        ///< internal friction of the intact bond
        double softening_n = 0.2;                 ///< length of the softening branch in tension over u_l
        double softening_t = 0.2;                 ///< the same in shear
        double fracture_energy_n = 0.0;           ///< G_f in tension, J/m2; 0: softening by ratio
        double fracture_energy_t = 0.0;           ///< G_s, the same in shear
        double lcs[3] = {20.0e6, 45.0e6, 70.0e6}; ///< stresses where the compression envelope changes slope, ascending, Pa
        double yrc[3] = {3.0, 12.0, 22.0};        ///< k_n over the slope beyond each of them, >= 1
    };

    /// Parameters with what follows from them.
    struct Constants : Parameters, BondBasis {
        double opening_f = 0.0; ///< u_f in tension by fracture energy, 2 G_f / sigma_f, m; 0: by ratio
        double slip_f = 0.0;    ///< u_f in shear without normal force, 2 G_s / tau_f, m; 0: by ratio
    };

    /// Memory of a bond.
    template <class T> struct State {
        T u_t[3]; ///< elastic tangential displacement, m; turned with the bond's frame before the law sees it
        T u_p;    ///< plastic shortening, m
        T d_n;    ///< damage in tension; 1: failed
        T d_t;    ///< damage in shear; 1: failed
    };

    /// The state but for the slip, in the order of `Bonds::memory`.
    template <class S, class F> PROVETA_INLINE static void members(S& s, F&& f) {
        f("plastic", s.u_p);
        f("damage_n", s.d_n);
        f("damage_t", s.d_t);
    }

    template <class V> static void declare(V& v, Parameters& p) {
        v.number("sigma_f", p.sigma_f, V::Unit::pressure, V::at_least(0), "tensile strength of a bond (5.21)");
        v.number("tau_f", p.tau_f, V::Unit::pressure, V::at_least(0), "shear strength of a bond without normal force (5.21)");
        v.number("mu_s", p.mu_s, V::Unit::none, V::between(0, 10), "internal friction of an intact bond (5.21)");
        v.number("softening_tension", p.softening_n, V::Unit::none, V::between(1e-6, 1e6),
                 "length of the softening branch in tension over the limit displacement, u_f/u_l - 1 (5.24)");
        v.number("softening_shear", p.softening_t, V::Unit::none, V::between(1e-6, 1e6), "the same in shear (5.24)");
        v.number("fracture_energy_tension", p.fracture_energy_n, V::Unit::energy_per_area, V::at_least(0),
                 "fracture energy G_f of a bond in tension: straight softening to u_f = 2 G_f / sigma_f in place of softening_tension; 0: "
                 "not used");
        v.number("fracture_energy_shear", p.fracture_energy_t, V::Unit::energy_per_area, V::at_least(0),
                 "the same in shear, G_s, without normal force; in place of softening_shear");
        v.numbers("lcs", p.lcs, V::Unit::pressure, V::above(0),
                  "compressive stresses LCS1 to LCS3 where the envelope changes slope (5.28)");
        v.numbers("yrc", p.yrc, V::Unit::none, V::at_least(1),
                  "ratios YRC1 to YRC3 of the initial slope to the slope beyond each LCS (5.28)");
    }

    /// Parameters of bonds between two materials: the lower strength and friction, the mean of the rest.
    static Parameters mix(const Parameters& a, const Parameters& b);
    /// The same with all strengths multiplied.
    static Parameters scaled(Parameters p, double factor);
    static Constants constants(const Parameters& p, const BondBasis& basis);
    /// Stress at which a bond pulled apart begins to soften, Pa.
    static double tensile_limit(const Constants& c) { return c.sigma_f; }

    /// Length of the softening branch, u_f - u_l, m. u_l: limit displacement now; u_l0: the same without normal force; end: u_f by fracture
    /// energy (0: by ratio).
    template <class T> PROVETA_INLINE static T softening_length(double ratio, double end, const T& u_l, const T& u_l0) {
        using std::max;
        return end > 0.0 ? max(T(end) - u_l0, T(smallest)) : ratio * u_l;
    }

    /// Damage that belongs to displacement u >= u_l (5.23), 1 from u_f on.
    template <class T> PROVETA_INLINE static T damage_at(const T& u, const T& u_l, const T& length, bool by_energy) {
        using std::min;
        const T share = (u - u_l) / length;
        return min(by_energy ? share * (u_l + length) / u : share, T(1.0));
    }

    /// Force of the compression envelope at shortening u (5.28): slope k_n up to LCS1, k_n / YRC_i beyond LCS_i. Valid for u >= 0.
    template <class P, class T> PROVETA_INLINE static T compression_envelope(const P& p, const T& k_n, const T& area, const T& u) {
        const T trial = k_n * u;
        T bend = p.lcs[0] * area; // elastic force k_n u at which the branch begins
        T base = bend;            // envelope force there
        T force = trial;
        for (int b = 0; b < 3; ++b) {
            force = select(trial > bend, base + (trial - bend) * (1.0 / p.yrc[b]), force);
            if (b < 2) {
                const T rise = (p.lcs[b + 1] - p.lcs[b]) * area;
                bend = bend + rise * p.yrc[b];
                base = base + rise;
            }
        }
        return force;
    }

    /// One step of one bond. Pure: everything comes in by argument and leaves by state and result.
    ///
    /// The state is brought to the end of the step. Failure shows as damage reaching 1.
    template <class T>
    PROVETA_INLINE static BondResponse<T> advance(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, State<T>& s) {
        using std::max;
        using std::min;
        using std::sqrt;
        const T zero = T(0.0);
        const T one = T(1.0);
        const T& k_n = bond.k_n;
        const T& area = bond.area;
        const T k_t = k_n * p.shear_ratio;
        BondResponse<T> r{zero, {zero, zero, zero}, zero, zero, zero};

        // Normal direction. Elastic shortening now and before; negative is elongation.
        const T elastic = kin.shortening - s.u_p;
        const T before = elastic - kin.approach;
        const auto was_broken = (s.d_n >= one) || (s.d_t >= one);
        const T d_n_old = s.d_n;
        const T d_t_old = s.d_t;
        r.normal = k_n * elastic;

        const T yield_force = p.lcs[0] * area;
        if (any_of(r.normal > yield_force)) {
            const T envelope = compression_envelope(p, k_n, area, max(kin.shortening, zero));
            const auto yields = (r.normal > envelope) && (r.normal > zero);
            const T more = select(yields, (r.normal - envelope) / k_n, zero);
            r.normal = select(yields, envelope, r.normal);
            s.u_p = s.u_p + more;
            // mean of the force before and after: F1 - k (du - du_p) / 2
            r.plastic_work = (r.normal - 0.5 * k_n * (kin.approach - more)) * more;
        }

        const T elongation = -elastic;
        const T strength_n = p.sigma_f * area;
        if (any_of(-r.normal > strength_n)) {
            const T u_l = max(strength_n / k_n, T(smallest));
            const T damage =
                damage_at(max(elongation, u_l), u_l, softening_length(p.softening_n, p.opening_f, u_l, u_l), p.opening_f > 0.0);
            s.d_n = select(was_broken, d_n_old, max(d_n_old, damage));
        }

        // Shear: the limit follows the current normal force.
        T old[3];
        T trial[3];
        for (int c = 0; c < 3; ++c) {
            old[c] = s.u_t[c];
            trial[c] = old[c] + kin.slip[c];
        }
        const T length2 = dot(trial, trial);
        const T compression = max(r.normal, zero);
        const T strength_t = p.tau_f * area + p.mu_s * compression;
        if (any_of(k_t * k_t * length2 > strength_t * strength_t)) {
            const T u_l = max(strength_t / k_t, T(smallest));
            const T u_l0 = p.tau_f * area / k_t;
            const T u = max(sqrt(length2), u_l);
            const T damage = damage_at(u, u_l, softening_length(p.softening_t, p.slip_f, u_l, u_l0), p.slip_f > 0.0);
            s.d_t = select(was_broken, d_t_old, max(d_t_old, damage));
        }

        const auto broken = (s.d_n >= one) || (s.d_t >= one);
        const auto in_tension = elongation > zero;
        const T stays_n = select(broken, zero, one - s.d_n); // share of the tensile stiffness that is left
        r.normal = select(in_tension, r.normal * stays_n, r.normal);
        for (int c = 0; c < 3; ++c) {
            s.u_t[c] = trial[c];
            r.shear[c] = k_t * trial[c] * (one - s.d_t);
        }

        // Dissipation by damage: (1/2) k u(before) u(now) times the loss of stiffness, which is what the trapezoidal work leaves over.
        const T lost_n = select(was_broken, zero, (one - d_n_old) - stays_n);
        const T lost_t = select(was_broken, zero, select(broken, one - d_t_old, s.d_t - d_t_old));
        if (any_of(lost_n > zero) || any_of(lost_t > zero)) {
            const T product_n = max(-before, zero) * max(elongation, zero);
            const T product_t = old[0] * trial[0] + old[1] * trial[1] + old[2] * trial[2];
            r.damage_work = 0.5 * k_n * product_n * lost_n + 0.5 * k_t * product_t * lost_t;
        }

        if (any_of(broken)) {
            const auto fails_now = broken && !was_broken;
            const T coulomb = p.mu_d * max(r.normal, zero);
            const T length = sqrt(length2);
            const T force = k_t * length;
            const T scale = select(force > coulomb, coulomb / max(force, T(smallest)), one);
            for (int c = 0; c < 3; ++c) {
                const T keep = select(fails_now, zero, trial[c] * scale); // at failure the spring starts at zero
                const T slid = select(was_broken, trial[c] - keep, zero);
                const T friction = 0.5 * k_t * (old[c] + keep) * slid;
                r.friction_work = r.friction_work + friction;
                s.u_t[c] = select(broken, keep, s.u_t[c]);
                r.shear[c] = select(broken, k_t * keep, r.shear[c]);
            }
        }
        return r;
    }

    /// Energy that the bond can give back, J: normal and tangential springs. Same arguments as `advance`, after it.
    template <class T>
    PROVETA_INLINE static T stored_energy(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const T& normal,
                                          const State<T>& s) {
        const T& k_n = bond.k_n;
        const T elongation = s.u_p - kin.shortening;
        const T in_normal = 0.5 * select(elongation > T(0.0), -normal * elongation, normal * normal / k_n);
        const auto broken = (s.d_n >= T(1.0)) || (s.d_t >= T(1.0));
        const T left = select(broken, T(1.0), T(1.0) - s.d_t);
        const T u2 = s.u_t[0] * s.u_t[0] + s.u_t[1] * s.u_t[1] + s.u_t[2] * s.u_t[2];
        return in_normal + 0.5 * k_n * p.shear_ratio * left * u2;
    }

    /// How near the bond is to failure, 0 to 1 (5.44): the larger of shear force over its limit and, in tension, e / u_f. 1 when failed.
    template <class T>
    PROVETA_INLINE static T failure_criterion(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const T& normal,
                                              const T& shear, const State<T>& s) {
        using std::max;
        using std::min;
        const T& k_n = bond.k_n;
        const T& area = bond.area;
        const T zero = T(0.0);
        const T u_l = p.sigma_f / k_n * area;
        const T u_f = u_l + softening_length(p.softening_n, p.opening_f, u_l, u_l);
        const T tension = max(s.u_p - kin.shortening, zero) / max(u_f, T(smallest));
        const T in_shear = shear / max(p.tau_f * area + p.mu_s * max(normal, zero), T(smallest));
        const auto broken = (s.d_n >= T(1.0)) || (s.d_t >= T(1.0));
        return select(broken, T(1.0), min(max(tension, in_shear), T(1.0)));
    }

    /// Whether the bond has failed, and whether it did so in shear.
    template <class T> PROVETA_INLINE static auto failed(const State<T>& s) { return (s.d_n >= T(1.0)) || (s.d_t >= T(1.0)); }
    template <class T> PROVETA_INLINE static auto failed_in_shear(const State<T>& s) { return !(s.d_n >= T(1.0)); }

    /// Share of the stiffness against moments that damage has left, and the damage to show.
    template <class T> PROVETA_INLINE static T intact(const State<T>& s) {
        using std::max;
        return T(1.0) - max(s.d_n, s.d_t);
    }

    /// A failure that something else decided (averaged stress).
    static void fail(State<double>& s, FailureMode mode) { (mode == FailureMode::tension ? s.d_n : s.d_t) = 1.0; }
};

} // namespace proveta
