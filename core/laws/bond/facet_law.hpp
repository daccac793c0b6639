// The facet of the Confinement-Shear Lattice and of the Lattice Discrete Particle Model, on a bond: one boundary for tension and shear with
// damage, pore collapse and rehardening in compression, cohesion and friction that slide plastically under compression.
//
// References: G. Cusatis, Z. Bazant, L. Cedolin, J. Eng. Mech. 129 (2003) 1439 and 1449 (CSL); G. Cusatis, D. Pelessone, A. Mencarelli,
// Cem. Concr. Compos. 33 (2011) 881 (LDPM), whose equations are meant below. Softening in two stages is our own (docs/theory.md).
//
//   symbol         meaning                                                      unit
//   e_N, e_T       strains of the facet, elongation / d0 and slip / d0          -
//   E0, alpha      k_n d0 / A and k_t / k_n                                     Pa, -
//   e, s           effective strain sqrt(e_N^2 + alpha e_T^2) and stress        -, Pa
//   w              tan w = e_N / (sqrt(alpha) e_T): 0 shear, pi/2 tension       rad
//   R              E0 e / s_0(w), elastic stress over the initial strength      -
//   D              damage, s = (1 - D) E0 e, never decreasing                   -
//
// Tension and shear, e_N > 0:  s <= s_b(e, w), secant unloading                                                       (eqs. 17 to 22)
//   s_0 = 2 s_t / (sin w + sqrt(sin^2 w + 4 alpha cos^2 w / r_st^2)), in stresses the parabola s_T^2 = s_s^2 (1 - s_N / s_t)
//   one stage    s_b = s_0 exp(-h (R - 1)),        h = r_s/alpha + (2 / (L_t/L - 1) - r_s/alpha) g,  g = (2 w / pi)^n_t
//   two stages   the same with l_0 for L down to phi s_0: one stress-strain law for facets of every size; then a tail,
//                phi s_0 exp(-h_2 (R - R_1) / phi),  h_2 = h phi^2 (L_t/l_0 - 1) / (L_t/L - 1 - (1 - phi)(L_t/l_0 - 1)),
//                so that a facet torn in pure tension releases G_t = s_t^2 L_t / (2 E0) an area whatever its length
// Compression, e_N < 0:  s_N down to -s_bc(e_DV), e_DV = e_V + beta (e_N - e_V); the rest is plastic                  (eqs. 23 to 26)
// Shear under compression:  |s_T| <= (1 - c D) s_bs - c D mu_d s_N,
//   s_bs = s_s + (mu_0 - mu_inf) s_N0 (1 - exp(s_N / s_N0)) - mu_inf s_N                                              (eqs. 27 to 29)
// Closing of a damaged facet keeps its shear force, u_t <- (1 - D) u_t; opening it again returns to the secant. Both take energy.
// Failed, where a hundredth of the strength is left: no cohesion, friction mu_d with k_t, the slip starts at zero.
//
// Energies are those that a trapezoidal rule over the step gives, each from its own mechanism.
#pragma once

#include "core/geometry/lane_functions.hpp"
#include "core/laws/bond_point.hpp"

namespace proveta {

struct Facet {
    static constexpr const char* name = "facet";
    static constexpr const char* meaning =
        "a facet of CSL and LDPM: one boundary for tension and shear, pore collapse, friction that saturates";
    static constexpr bool asks_volumetric_strain = true;

    /// The card's numbers.
    struct Parameters {
        double sigma_t = 2.6e6;       ///< s_t, Pa
        double length_t = 0.5;        ///< L_t, m
        double shear_ratio_t = 6.25;  ///< r_st = s_s / s_t
        double exponent = 0.65;       ///< n_t
        double softening_s = 0.006;   ///< r_s
        double first_length = 0.0123; ///< l_0, m; 0: one stage
        double tail = 0.4;            ///< phi
        double sigma_c0 = 32.0e6;     ///< s_c0, Pa
        double hardening = 0.4;       ///< H_c0 / E0
        double transition = 6.0;      ///< kappa_c0
        double kappa_c1 = 1.0;
        double kappa_c2 = 0.0;
        double kappa_c3 = 0.1;
        double coupling = 0.5; ///< beta
        double mu_0 = 0.11;
        double mu_inf = 0.0;
        double sigma_n0 = 600.0e6;       ///< s_N0, Pa
        double cohesion_loss = 0.0;      ///< c
        double weibull_modulus = 0.0;    ///< of the scatter of strengths over facets; 0: none
        double correlation_length = 0.0; ///< of that scatter, m
    };

    /// Parameters with what follows from them.
    struct Constants : Parameters, BondBasis {
        double sigma_s = 0.0;         ///< s_s, Pa
        double per_sigma_t = 0.0;     ///< 1 / s_t, 1/Pa
        double per_sigma_s = 0.0;     ///< 1 / s_s, 1/Pa
        double shear_softening = 0.0; ///< r_s / alpha
        double first_slope = 0.0;     ///< h of the first stage in pure tension
        double first_end = 0.0;       ///< -ln phi
        double first_energy = 0.0;    ///< (1 - phi)(L_t/l_0 - 1)
        double tail_rate = 0.0;       ///< 2 phi over the first slope
        double root_alpha = 0.0;
        double e_c0 = 0.0;      ///< s_c0 / E0
        double e_c1 = 0.0;      ///< kappa_c0 e_c0
        double e_v0 = 0.0;      ///< kappa_c3 e_c0
        double modulus_c = 0.0; ///< H_c0, Pa
    };

    /// Memory of a facet.
    template <class T> struct State {
        T u_t[3];  ///< elastic tangential displacement, of an open damaged facet that to which its secant belongs, m
        T plastic; ///< plastic shortening, m
        T damage;  ///< D; 1: failed
        T closed;  ///< damaged: 1 when last pressed; failed: 1 when by shear more than by tension
    };

    /// The state but for the slip, in the order of `Bonds::memory`.
    template <class S, class F> PROVETA_INLINE static void members(S& s, F&& f) {
        f("plastic", s.plastic);
        f("damage", s.damage);
        f("closed", s.closed);
    }

    template <class V> static void declare(V& v, Parameters& p) {
        v.number("tensile_strength", p.sigma_t, V::Unit::pressure, V::above(0), "tensile strength sigma_t of a facet (LDPM)");
        v.number("tensile_characteristic_length", p.length_t, V::Unit::length, V::above(0),
                 "l_t = 2 E0 G_t / sigma_t^2, which sets the fracture energy G_t of a facet in tension (LDPM)");
        v.number("shear_strength_ratio", p.shear_ratio_t, V::Unit::none, V::above(0),
                 "cohesion over tensile strength, sigma_s / sigma_t (LDPM)");
        v.number("softening_exponent", p.exponent, V::Unit::none, V::between(0, 100),
                 "n_t: how softening fades from pure tension to pure shear, (2 w / pi)^n_t (LDPM)");
        v.number("shear_softening_ratio", p.softening_s, V::Unit::none, V::between(0, 10),
                 "r_s: softening modulus in pure shear over E0; 0: shear does not soften (LDPM)");
        v.number(
            "softening_length", p.first_length, V::Unit::length, V::at_least(0),
            "l_0 of the first of two softening stages, which is then one stress-strain law for facets of every length; 0: one stage, by "
            "each facet's own length");
        v.number("tail_stress_ratio", p.tail, V::Unit::none, V::between(0.01, 0.99),
                 "phi: stress over strength at which the second stage begins, which brings the fracture energy to G_t");
        v.number("compressive_yield_strength", p.sigma_c0, V::Unit::pressure, V::above(0), "sigma_c0 where pores begin to collapse (LDPM)");
        v.number("initial_hardening_modulus_ratio", p.hardening, V::Unit::none, V::between(0, 1), "H_c0 / E0 of pore collapse (LDPM)");
        v.number("transitional_strain_ratio", p.transition, V::Unit::none, V::at_least(1),
                 "kappa_c0: strain at which rehardening begins over that of yield (LDPM)");
        v.number("deviatoric_strain_threshold_ratio", p.kappa_c1, V::Unit::none, V::at_least(0),
                 "kappa_c1: ratio of deviatoric to volumetric strain from which hardening is less (LDPM)");
        v.number("deviatoric_damage", p.kappa_c2, V::Unit::none, V::at_least(0), "kappa_c2: how much less; 0: none (LDPM)");
        v.number("deviatoric_reference_ratio", p.kappa_c3, V::Unit::none, V::above(0), "kappa_c3: e_V0 over the strain of yield (LDPM)");
        v.number(
            "volumetric_deviatoric_coupling", p.coupling, V::Unit::none, V::between(0, 1),
            "beta: share of the facet's own deviatoric strain in the strain that collapses pores; 1: its normal strain, 0: the mean strain "
            "around it (LDPM)");
        v.number("initial_friction", p.mu_0, V::Unit::none, V::between(0, 10), "mu_0: friction of unfailed facets at low pressure (LDPM)");
        v.number("asymptotic_friction", p.mu_inf, V::Unit::none, V::between(0, 10), "mu_inf: the same at high pressure (LDPM)");
        v.number("transitional_stress", p.sigma_n0, V::Unit::pressure, V::above(0), "sigma_N0: pressure between the two (LDPM)");
        v.number(
            "cohesion_loss", p.cohesion_loss, V::Unit::none, V::between(0, 1),
            "c: how far damage in tension leads the shear limit under compression over to a crack's friction mu_d: 1 in proportion, 0 not "
            "before failure (LDPM)");
        v.number("weibull_modulus", p.weibull_modulus, V::Unit::none, V::between(0, 1000),
                 "Weibull modulus of a scatter of tensile and shear strength over the facets, with the mean kept; 0: none");
        v.number("correlation_length", p.correlation_length, V::Unit::length, V::at_least(0),
                 "length over which that scatter is alike; 0: each facet by itself");
    }

    static Parameters mix(const Parameters& a, const Parameters& b);
    static Parameters scaled(Parameters p, double factor);
    static Constants constants(const Parameters& p, const BondBasis& basis);
    static double tensile_limit(const Constants& c) { return c.sigma_t; }
    /// Facets longer than this release less than G_t in the second stage, or with one stage lose strength, m.
    static double longest_bond(const Constants& c);
    /// Whether the collapse of pores looks at the strain around the facet.
    static bool uses_volumetric_strain(const Parameters& p) { return p.coupling < 1.0 || p.kappa_c2 > 0.0; }

    /// Whether any facet is pressed so that `advance` asks for the strain around it.
    template <class T>
    PROVETA_INLINE static bool beyond_yield(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const State<T>& s) {
        return any_of(bond.k_n * (kin.shortening - s.plastic) > p.sigma_c0 * bond.area);
    }

    /// -s_bc: compressive stress at which pores collapse, Pa. e_n: normal strain of the facet, e_v: mean normal strain around it, both
    /// positive in tension.
    template <class T> PROVETA_INLINE static T collapse_stress(const Constants& p, const T& e_n, const T& e_v) {
        using std::max;
        using std::min;
        const T zero = T(0.0);
        const T deviatoric = e_n - e_v;
        const T strain = -(e_v + p.coupling * deviatoric);
        T modulus = T(p.modulus_c);
        if (p.kappa_c2 > 0.0) {
            const T size = max(deviatoric, T(-deviatoric));
            modulus = modulus / (1.0 + p.kappa_c2 * max(size / (p.e_v0 - min(e_v, zero)) - p.kappa_c1, zero));
        }
        const T straight = p.sigma_c0 + max(strain - p.e_c0, zero) * modulus;
        const T beyond = strain - p.e_c1;
        if (!any_of(beyond > zero)) {
            return straight;
        }
        const T end = p.sigma_c0 + (p.e_c1 - p.e_c0) * modulus;
        return select(beyond > zero, T(end * exp_of(T(beyond * modulus / end))), straight);
    }

    /// Strength by which a facet too long for one stage is cut; 1 with two stages.
    template <class T> PROVETA_INLINE static T cut(const Constants& p, const T& length) {
        using std::min;
        using std::sqrt;
        return p.first_length > 0.0 ? T(1.0) : T(sqrt(min(T(0.99 * p.length_t / length), T(1.0))));
    }

    /// s_b / s_0 at R >= 1; turn: 2 w / pi.
    template <class T> PROVETA_INLINE static T strength_left(const Constants& p, const T& length, const T& overload, const T& turn) {
        using std::max;
        const T g = p.exponent == 1.0 ? turn : p.exponent == 0.0 ? T(1.0) : exp_of(T(p.exponent * log_of(turn)));
        const double s = p.shear_softening;
        if (p.first_length <= 0.0) {
            const T h = s + (2.0 / (max(T(p.length_t / length), T(1.0 / 0.99)) - 1.0) - s) * g;
            return exp_of(T(-h * (overload - 1.0)));
        }
        const T first = s + (p.first_slope - s) * g;
        T along = first * (overload - 1.0);
        const auto past = along > T(p.first_end);
        if (any_of(past)) {
            const T spare = max(p.length_t - (1.0 + p.first_energy) * length, T(0.01 * p.first_energy * length));
            along = select(past, T(p.first_end + (along - p.first_end) * (p.tail_rate * length / spare)), along);
        }
        return exp_of(T(-along));
    }

    /// Largest shear stress under compression, Pa: the facet's own, from which damage leads over to a crack's friction. pressed:
    /// compressive stress, at least 0.
    template <class T> PROVETA_INLINE static T shear_limit(const Constants& p, const T& strength, const T& pressed, const T& damage) {
        const T own =
            p.sigma_s * strength + (p.mu_0 - p.mu_inf) * p.sigma_n0 * (1.0 - exp_of(T(pressed * (-1.0 / p.sigma_n0)))) + p.mu_inf * pressed;
        return own + p.cohesion_loss * damage * (p.mu_d * pressed - own);
    }

    /// One step of one facet. Pure: everything comes in by argument and leaves by state and result; the state is brought to the end of the
    /// step. Failure shows as D reaching 1.
    template <class T>
    PROVETA_INLINE static BondResponse<T> advance(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, State<T>& s) {
        using std::max;
        using std::min;
        using std::sqrt;
        const T zero = T(0.0);
        const T one = T(1.0);
        const T k_t = bond.k_n * p.shear_ratio;
        BondResponse<T> r{zero, {zero, zero, zero}, zero, zero, zero};

        // Normal direction. Elastic shortening now and before; negative is elongation.
        const T elastic = kin.shortening - s.plastic;
        r.normal = bond.k_n * elastic;
        if (beyond_yield(p, bond, kin, s)) {
            const T bound = bond.area * collapse_stress(p, T(-kin.shortening / bond.length), bond.volumetric);
            const auto yields = r.normal > bound;
            if (any_of(yields)) {
                const T more = select(yields, T((r.normal - bound) / bond.k_n), zero);
                r.normal = select(yields, bound, r.normal);
                s.plastic = s.plastic + more;
                // mean of the force before and after: F1 - k (du - du_p) / 2
                r.plastic_work = (r.normal - 0.5 * bond.k_n * (kin.approach - more)) * more;
            }
        }

        // Inside the initial boundary and never damaged: nothing more to ask.
        T trial[3];
        for (int c = 0; c < 3; ++c) {
            trial[c] = s.u_t[c] + kin.slip[c];
        }
        // Both parts of the elastic stress over their strengths, times the area.
        const T tension = max(-r.normal, zero) * p.per_sigma_t;
        const T in_shear = k_t * p.per_sigma_s;
        const T capacity = bond.area * (bond.strength * cut(p, bond.length));
        const auto outside = in_shear * in_shear * dot(trial, trial) > capacity * (capacity - tension);
        if (!any_of(outside) && !any_of(s.damage > zero)) {
            for (int c = 0; c < 3; ++c) {
                s.u_t[c] = trial[c];
                r.shear[c] = k_t * trial[c];
            }
            return r;
        }

        const T before = elastic - kin.approach;
        const T elongation = -elastic;
        const auto pulled = elongation > zero;
        const T damage_old = s.damage;
        const auto was_failed = damage_old >= one;
        const auto damaged = (damage_old > zero) && !was_failed;
        const auto closing = damaged && !pulled && !(s.closed > zero);

        // Slip as the facet has it now, and the share of the shear stiffness that went with it until now.
        T old[3];
        for (int c = 0; c < 3; ++c) {
            old[c] = s.u_t[c];
        }
        const T scaled = select(closing, T(one - damage_old), one);
        r.damage_work = select(closing, T(0.5 * k_t * damage_old * (one - damage_old) * dot(old, old)), zero);
        for (int c = 0; c < 3; ++c) {
            old[c] = scaled * old[c];
            trial[c] = old[c] + kin.slip[c];
        }
        const T share_old = select(damaged && !closing && !(s.closed > zero), T(one - damage_old), one);
        const T slip = dot(trial, trial);
        const T slipped = sqrt(slip);

        // Open: damage.
        const T reached = 0.5 * (tension + sqrt(tension * tension + (4.0 * in_shear * in_shear) * slip));
        T damage = damage_old;
        const T across = p.root_alpha * slipped;
        const auto grows = pulled && (reached > capacity) && !was_failed;
        if (any_of(grows)) {
            const T most = max(reached, capacity);
            const T inverse = 1.0 / (most * capacity); // serves R and 1 / R
            const T left = strength_left(p, bond.length, T(most * most * inverse), quarter_turn(T(max(elongation, zero)), across));
            damage = select(grows, T(max(damage_old, one - left * (capacity * capacity * inverse))), damage_old);
            damage = select(grows && (left <= T(failed_at)), one, damage);
        }
        const auto fails_now = (damage >= one) && !was_failed;
        const auto opens = pulled && !was_failed;
        const T share = select(opens, T(one - damage), one);
        r.damage_work = r.damage_work + select(opens,
                                               T(0.5 * k_t * (share_old - share) * dot(old, trial) +
                                                 0.5 * bond.k_n * (damage - damage_old) * max(-before, zero) * elongation),
                                               zero);

        // Closed: slides over its cohesion and friction; failed: over Coulomb's alone.
        const T pressed = max(r.normal, zero);
        const T force = k_t * slipped;
        const T least =
            select(was_failed, T(p.mu_d * pressed), T(bond.strength * bond.area * (p.sigma_s * (1.0 - p.cohesion_loss * damage))));
        auto slides = !opens && (force > least);
        T keep = one;
        if (any_of(slides)) { // the exponential of friction only then
            const T limit = select(was_failed, least, T(bond.area * shear_limit(p, bond.strength, T(pressed / bond.area), damage)));
            slides = slides && (force > limit);
            keep = select(slides, T(limit / max(force, T(smallest))), one);
        }
        r.normal = select(pulled, T(select(was_failed, zero, share) * r.normal), r.normal);
        for (int c = 0; c < 3; ++c) {
            const T kept = select(fails_now, zero, T(keep * trial[c]));
            r.friction_work = r.friction_work + select(slides, T(0.5 * k_t * (old[c] + kept) * (trial[c] - kept)), zero);
            r.shear[c] = share * k_t * kept;
            s.u_t[c] = kept;
        }
        s.damage = damage;
        const T pressed_now = select(pulled || !(damage > zero), zero, one);
        s.closed = select(was_failed, s.closed, select(fails_now, select(across > elongation, one, zero), pressed_now));
        return r;
    }

    /// Energy that the facet can give back, J: normal and tangential springs. Same arguments as `advance`, after it.
    template <class T>
    PROVETA_INLINE static T stored_energy(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const T& normal,
                                          const State<T>& s) {
        const T elongation = s.plastic - kin.shortening;
        const auto pulled = elongation > T(0.0);
        const T in_normal = 0.5 * select(pulled, T(-normal * elongation), T(normal * normal / bond.k_n));
        const T share = select(pulled && !failed(s), T(T(1.0) - s.damage), T(1.0));
        return in_normal + 0.5 * bond.k_n * p.shear_ratio * share * dot(s.u_t, s.u_t);
    }

    /// How near the facet is to failure, 0 to 1: open, the larger of R and D; pressed, shear stress over its limit; 1 when failed.
    template <class T>
    PROVETA_INLINE static T failure_criterion(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const T& normal,
                                              const T& shear, const State<T>& s) {
        using std::max;
        using std::min;
        using std::sqrt;
        const T zero = T(0.0);
        const T elongation = s.plastic - kin.shortening;
        const T left = max(T(1.0) - s.damage, T(smallest));
        const T tension = bond.k_n * max(elongation, zero) / (p.sigma_t * bond.area);
        const T in_shear = shear / (left * p.sigma_s * bond.area);
        const T overload = 0.5 * (tension + sqrt(tension * tension + 4.0 * in_shear * in_shear)) / (bond.strength * cut(p, bond.length));
        const T pressed = max(normal, zero) / bond.area;
        const T closed = shear / max(bond.area * shear_limit(p, bond.strength, pressed, s.damage), T(smallest));
        const T open = select(s.damage > zero, s.damage, overload);
        return select(failed(s), T(1.0), min(select(elongation > zero, open, closed), T(1.0)));
    }

    template <class T> PROVETA_INLINE static auto failed(const State<T>& s) { return s.damage >= T(1.0); }
    template <class T> PROVETA_INLINE static auto failed_in_shear(const State<T>& s) { return s.closed > T(0.0); }
    /// Share of the stiffness against moments that damage has left.
    template <class T> PROVETA_INLINE static T intact(const State<T>& s) { return T(1.0) - s.damage; }

    static void fail(State<double>& s, FailureMode mode) {
        s.damage = 1.0;
        s.closed = mode == FailureMode::shear ? 1.0 : 0.0;
    }

  private:
    static constexpr double failed_at = 0.01; ///< of the strength: what is left when a facet has failed
};

} // namespace proveta
