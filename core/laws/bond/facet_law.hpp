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
//                so that a facet torn in pure tension releases G_t = s_t^2 L_t / (2 E0) an area whatever its length; where L leaves the
//                tail less than a hundredth of the first stage's energy, l_0 is as much longer as that asks
// Compression, e_N < 0:  s_N down to -s_bc(e_DV), e_DV = e_V + beta (e_N - e_V); the rest is plastic                  (eqs. 23 to 26)
// Shear under compression:  |s_T| <= (1 - c D) s_bs - c D mu_d s_N,
//   s_bs = s_s + (mu_0 - mu_inf) s_N0 (1 - exp(s_N / s_N0)) - mu_inf s_N                                              (eqs. 27 to 29)
// Closing of a damaged facet keeps its shear force, u_t <- (1 - D) u_t; opening it again returns to the secant. Both take energy.
// Failed, where a hundredth of the strength is left: no cohesion, friction mu_d with k_t, the slip starts at zero.
//
// Energies are those that a trapezoidal rule over the step gives, each from its own mechanism.
#pragma once

#include "core/laws/bond/facet_bounds.hpp"

namespace proveta {

struct Facet : FacetBounds {
    static constexpr const char* name = "facet";
    static constexpr const char* meaning =
        "a facet of CSL and LDPM: one boundary for tension and shear, pore collapse, friction that saturates";
    static constexpr bool asks_volumetric_strain = true;

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

    static Parameters mix(const Parameters& a, const Parameters& b);
    static Parameters scaled(Parameters p, double factor);
    static Constants constants(const Parameters& p, const BondBasis& basis);
    static double tensile_limit(const Constants& c) { return c.sigma_t; }
    /// Facets longer than this soften by their own length from the peak on, or with one stage lose strength, m.
    static double longest_bond(const Constants& c);
    /// Whether the collapse of pores looks at the strain around the facet.
    static bool uses_volumetric_strain(const Parameters& p) { return p.coupling < 1.0 || p.kappa_c2 > 0.0; }

    /// Whether any facet is pressed so that `advance` asks for the strain around it.
    template <class T>
    PROVETA_INLINE static bool beyond_yield(const Constants& p, const BondShape<T>& bond, const BondMotion<T>& kin, const State<T>& s) {
        return any_of(bond.k_n * (kin.shortening - s.plastic) > p.sigma_c0 * bond.area);
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
        const T strength = strength_of(p, bond);
        const T most = bond.area * strength;
        const auto outside = in_shear * in_shear * dot(trial, trial) > most * (most - tension);
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
        const T now = reached(tension, T(in_shear * in_shear * slip));
        T damage = damage_old;
        const T across = p.root_alpha * slipped;
        const auto grows = pulled && (now > most) && !was_failed;
        if (any_of(grows)) {
            const T over = max(now, most);
            const T inverse = 1.0 / (over * most); // serves R and 1 / R
            const T left = strength_left(p, bond.length, T(over * over * inverse), quarter_turn(T(max(elongation, zero)), across));
            damage = select(grows, T(max(damage_old, one - left * (most * most * inverse))), damage_old);
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
        const T least = select(was_failed, T(p.mu_d * pressed), T(strength * bond.area * (p.sigma_s * (1.0 - p.cohesion_loss * damage))));
        auto slides = !opens && (force > least);
        T keep = one;
        if (any_of(slides)) { // the exponential of friction only then
            const T limit = select(was_failed, least, T(bond.area * shear_limit(p, strength, T(pressed / bond.area), damage)));
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
        const T zero = T(0.0);
        const T elongation = s.plastic - kin.shortening;
        const T strength = strength_of(p, bond);
        const T left = max(T(1.0) - s.damage, T(smallest));
        const T in_shear = shear * p.per_sigma_s / left;
        const T overload = reached(T(bond.k_n * max(elongation, zero) * p.per_sigma_t), T(in_shear * in_shear)) / (bond.area * strength);
        const T pressed = max(normal, zero) / bond.area;
        const T closed = shear / max(bond.area * shear_limit(p, strength, pressed, s.damage), T(smallest));
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
