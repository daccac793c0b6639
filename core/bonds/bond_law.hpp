// What a run of bonds of one material pair obeys: which law, its parameters, and the optional bending and twisting stiffness.
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

#include "core/bonds/released_law.hpp"

namespace proveta {

/// Which constitutive law a bond obeys.
enum class LawKind {
    dempack, ///< the thesis's (dempack_law.hpp)
    released ///< the released code's (released_law.hpp)
};

/// What decides that a bond fails.
enum class Criterion {
    bond,         ///< its own normal and shear force (5.20-5.26)
    mohr_coulomb, ///< the averaged stress around its two spheres, Mohr-Coulomb with tension cut-off; at once, without softening
    rankine       ///< the averaged stress around its two spheres, largest tension; at once, without softening
};

/// A law with everything the kernel needs. With an averaged criterion the law itself never fails: its strengths are infinite.
struct BondLaw : released::Parameters {
    LawKind kind = LawKind::dempack;
    Criterion criterion = Criterion::bond;
    double averaged_sigma_f = 0.0; ///< strengths of an averaged criterion, Pa
    double averaged_tau_f = 0.0;
    double bending = 0.0;  ///< f_b
    double twisting = 0.0; ///< f_t

    [[nodiscard]] bool has_moments() const { return bending > 0.0 || twisting > 0.0; }

    /// Bending stiffness of a bond, N m. k_n in N/m, area in m2.
    template <class T> [[nodiscard]] PROVETA_INLINE T bending_stiffness(const T& k_n, const T& area) const {
        return bending / (4.0 * std::numbers::pi) * k_n * area;
    }
    /// Twisting stiffness of a bond, N m.
    template <class T> [[nodiscard]] PROVETA_INLINE T twisting_stiffness(const T& k_n, const T& area) const {
        return twisting / (2.0 * std::numbers::pi) * shear_ratio * k_n * area;
    }
};

} // namespace proveta
