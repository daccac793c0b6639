// Limit stresses of a facet, and the numbers of a card that they are made of. Symbols and references: facet_law.hpp.
#pragma once

#include "core/geometry/lane_functions.hpp"
#include "core/laws/bond_point.hpp"

namespace proveta {

struct FacetBounds {
    /// The card's numbers.
    struct Parameters {
        double sigma_t = 2.6e6;       ///< s_t, Pa
        double length_t = 0.52;       ///< L_t, m
        double shear_ratio_t = 6.25;  ///< r_st = s_s / s_t
        double exponent = 0.65;       ///< n_t
        double softening_s = 0.006;   ///< r_s
        double first_length = 0.0128; ///< l_0, m; 0: one stage
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

    /// Strength by which a facet is cut that is too long for its energy; 1 for others.
    template <class T> PROVETA_INLINE static T cut(const Constants& p, const T& length) {
        using std::sqrt;
        const T longest = T(0.99 * p.length_t);
        const auto beyond = length > longest;
        return any_of(beyond) ? select(beyond, T(sqrt(longest / length)), T(1.0)) : T(1.0);
    }

    /// Effective stress of an open facet over its strength in that direction, times the area of a facet whose strength is whole, m^2.
    /// tension, shear: forces over s_t and s_s, the latter squared.
    template <class T> PROVETA_INLINE static T reached(const T& tension, const T& shear_squared) {
        using std::sqrt;
        return 0.5 * (tension + sqrt(tension * tension + 4.0 * shear_squared));
    }

    /// Strength of this facet over the card's.
    template <class T> PROVETA_INLINE static T strength_of(const Constants& p, const BondShape<T>& bond) {
        return bond.strength * cut(p, bond.length);
    }

    /// s_b / s_0 at R >= 1; turn: 2 w / pi.
    template <class T> PROVETA_INLINE static T strength_left(const Constants& p, const T& length, const T& overload, const T& turn) {
        using std::max;
        const T g = p.exponent == 1.0 ? turn : p.exponent == 0.0 ? T(1.0) : exp_of(T(p.exponent * log_of(turn)));
        const double s = p.shear_softening;
        const T after_peak =
            max(T(p.length_t / length), T(1.0 / 0.99)) - 1.0; // energy that softening takes over that of the elastic branch
        if (p.first_length <= 0.0) {
            const T h = s + (2.0 / after_peak - s) * g;
            return exp_of(T(-h * (overload - 1.0)));
        }
        // At least a hundredth of the first stage's energy is the tail's: longer facets soften faster from the peak on.
        const T faster = max(T(1.01 * p.first_energy / after_peak), T(1.0));
        const T first = s + (p.first_slope * faster - s) * g;
        T along = first * (overload - 1.0);
        const auto past = along > T(p.first_end);
        if (any_of(past)) {
            const T energy = p.first_energy / faster;
            const T spare = max(p.length_t - (1.0 + energy) * length, T(0.01 * energy * length));
            along = select(past, T(p.first_end + (along - p.first_end) * (p.tail_rate * length / (faster * spare))), along);
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
};

} // namespace proveta
