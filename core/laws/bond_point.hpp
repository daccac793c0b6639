// What every bond law is given and gives back in a step. One bond with T = double, one bond a lane with T = Lanes.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/geometry/lanes.hpp"

namespace proveta {

constexpr double smallest = 1e-300; ///< keeps quotients defined for bonds without strength

/// How a bond failed. Kept for life.
enum class FailureMode : std::uint8_t { intact = 0, tension = 1, shear = 2 };

/// What a material's elasticity and surfaces tell its bond law.
struct BondBasis {
    double young_modulus = 28.0e9;  ///< E0 = k_n d0 / A, Pa
    double shear_ratio = 1.0 / 2.4; ///< k_t / k_n = b G / (a E), (5.17)
    double mu_d = 0.25;             ///< friction after failure
};

/// Geometry of a bond.
template <class T> struct BondShape {
    T k_n;        ///< normal stiffness, N/m
    T area;       ///< m2
    T length;     ///< d0, m
    T volumetric; ///< mean normal strain around the bond, e_V, positive in tension; 0 for laws that do not ask for it
    T strength;   ///< factor on the strength, 1 without scatter
};

/// What happens to a bond within one step.
template <class T> struct BondMotion {
    T shortening; ///< u_n at the end of the step, m
    T approach;   ///< increase of u_n during the step, m
    T slip[3];    ///< tangential displacement increment, m
};

/// Forces after the step, and where the energy of the step went.
template <class T> struct BondResponse {
    T normal;        ///< F_n, positive in compression, N
    T shear[3];      ///< force of j on i in the contact plane, N
    T damage_work;   ///< dissipated by damage and failure, J
    T plastic_work;  ///< dissipated by plastic shortening, J
    T friction_work; ///< dissipated by sliding, J
};

} // namespace proveta
