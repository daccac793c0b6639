// What a run of bonds of one material pair obeys: one of the laws of laws/bond, and the optional bending and twisting stiffness.
//
// Bending and twisting (off by default), as in parallel-bond models (D. Potyondy, P. Cundall, Int. J. Rock Mech. Min. Sci. 41 (2004) 1329):
// the bond is a beam of circular section A, I = A^2 / (4 pi), J = 2 I, length d0, between the contact's two faces:
//
//   M_b = f_b E I / d0 theta_b = f_b k_n A / (4 pi) theta_b,     M_t = f_t G J / d0 theta_t = f_t k_t A / (2 pi) theta_t
//
// theta is the integral of the relative spin w_j - w_i, carried with the bond's frame; its part along n is twist, the rest bending. Moments
// shrink with the bond's damage and vanish with it; they do not add to the bond's stress.
#pragma once

#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/laws/bond_law_list.hpp" // written by CMake from the files of laws/bond

namespace proveta {

namespace bond_laws {
template <class List> struct Variants;
template <class... Laws> struct Variants<TypeList<Laws...>> {
    using Parameters = std::variant<typename Laws::Parameters...>;
    using Constants = std::variant<typename Laws::Constants...>;
    template <class F> static void each(F&& f) { (f(std::type_identity<Laws>{}), ...); }
};
/// The law to whose parameters or constants X belongs.
template <class X, class List> struct Of;
template <class X, class First, class... Rest> struct Of<X, TypeList<First, Rest...>> {
    static constexpr bool here = std::is_same_v<X, typename First::Parameters> || std::is_same_v<X, typename First::Constants>;
    using Type = typename std::conditional_t<here, std::type_identity<First>, Of<X, TypeList<Rest...>>>::type;
    using type = Type;
};
template <class X> struct Of<X, TypeList<>> { using type = void; };
} // namespace bond_laws

/// Parameters of one of the laws; which one is the law.
using BondParameters = bond_laws::Variants<BondLaws>::Parameters;
/// What the bond loop takes of them.
using BondConstants = bond_laws::Variants<BondLaws>::Constants;
/// The law of a set of parameters or constants: LawOf<decltype(p)>::advance(...).
template <class X> using LawOf = typename bond_laws::Of<std::remove_cvref_t<X>, BondLaws>::type;

/// Calls f(std::type_identity<Law>{}) for each law.
template <class F> void for_each_bond_law(F&& f) { bond_laws::Variants<BondLaws>::each(std::forward<F>(f)); }

/// What decides that a bond fails.
enum class Criterion {
    bond,         ///< its law
    mohr_coulomb, ///< the averaged stress around its two spheres, Mohr-Coulomb with tension cut-off; at once, without softening
    rankine       ///< the averaged stress around its two spheres, largest tension; at once, without softening
};

/// Beams of bonds: what resists bending and twisting.
struct BondBeams {
    double bending = 0.0;  ///< f_b
    double twisting = 0.0; ///< f_t
    double shear_ratio = 1.0 / 2.4;

    [[nodiscard]] PROVETA_INLINE bool any() const { return bending > 0.0 || twisting > 0.0; }

    /// Bending stiffness of a bond, N m. k_n in N/m, area in m2.
    template <class T> [[nodiscard]] PROVETA_INLINE T bending_stiffness(const T& k_n, const T& area) const {
        return bending / (4.0 * std::numbers::pi) * k_n * area;
    }
    /// Twisting stiffness of a bond, N m.
    template <class T> [[nodiscard]] PROVETA_INLINE T twisting_stiffness(const T& k_n, const T& area) const {
        return twisting / (2.0 * std::numbers::pi) * shear_ratio * k_n * area;
    }
};

/// Strengths of an averaged criterion; the law itself then never fails.
struct AveragedCriterion {
    Criterion kind = Criterion::bond;
    double sigma_f = 0.0; ///< Pa
    double tau_f = 0.0;   ///< Pa
    double mu_s = 0.0;
};

/// Bonds of one pair of materials.
struct BondGroup {
    BondConstants law;
    BondBeams beams;
    AveragedCriterion criterion;
    bool volumetric = false; ///< the law looks at the strain around the bond

    [[nodiscard]] double shear_ratio() const { return beams.shear_ratio; }
    /// Stress at which a bond pulled apart begins to soften or fails, Pa.
    [[nodiscard]] double tensile_limit() const;
};

} // namespace proveta
