// Restitution of a linear spring and dashpot, both ways: from the damping ratio and back.
//
// Reference: thesis (2.21, 2.27); T. Schwager, T. Poeschel, "Coefficient of restitution and linear-dashpot model revisited", Granular
// Matter 9, 465-469 (2007), eqs. 13-21 for the contact that never pulls: it ends when the force, not the overlap, returns to zero.
//
//   pulling  e = exp(-pi xi/w),                              w = sqrt(1 - xi^2)                                    (2.27)
//   cut      e = exp(-xi/w (pi - atan2(2 xi w, w^2 - xi^2)))                        for xi < 1
//            e = exp(-xi/w ln((xi + w)/(xi - w))),           w = sqrt(xi^2 - 1)     for xi > 1, and exp(-2) at xi = 1
//
// Both hold for the Hertzian law too, whose dashpot goes with the fourth root of the overlap: in the coordinate 4/5 overlap^(5/4) its
// path of speed against overlap is that of a linear spring of stiffness 5/6 k_n, the zero of the force included. The same damping ratio
// then asks for a dashpot sqrt(5/6) times as large.
#pragma once

#include <cmath>
#include <numbers>

namespace proveta::restitution {

/// Factor on the damping ratio of the Hertzian law that gives it the restitution of the linear one.
constexpr double hertz_factor = 0.9128709291752769; // sqrt(5/6)

/// Damping ratio xi that gives restitution e, 0 < e <= 1, while the contact may pull (2.21).
inline double ratio_pulling(double e) {
    const double l = std::log(e);
    return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// Restitution of a contact that never pulls, with damping ratio xi >= 0.
inline double cut(double xi) {
    const double w = std::sqrt(std::fabs(1.0 - xi * xi));
    if (w < 1e-6) {
        return std::exp(-2.0);
    }
    return xi < 1.0 ? std::exp(-xi / w * (std::numbers::pi - std::atan2(2.0 * xi * w, w * w - xi * xi)))
                    : std::exp(-xi / w * 2.0 * std::log(xi + w)); // (xi + w)(xi - w) = 1
}

/// Damping ratio that gives restitution e, 0 < e <= 1, to a contact that never pulls: the inverse of `cut`, which falls with xi.
inline double ratio_cut(double e) {
    double low = 0.0;
    double high = 1.0;
    while (cut(high) > e) {
        high *= 2.0;
    }
    for (int k = 0; k < 80 && e < 1.0; ++k) {
        const double mid = 0.5 * (low + high);
        (cut(mid) > e ? low : high) = mid;
    }
    return e < 1.0 ? 0.5 * (low + high) : 0.0;
}

} // namespace proveta::restitution
