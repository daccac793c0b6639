// Compressible Neo-Hookean elasticity (thesis 4.37-4.39; Bonet and Wood).
//
//   w = lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3)     P = mu (F - F^-T) + lambda ln J F^-T
#pragma once

#include <cmath>

#include "core/solids/solid_material.hpp"

namespace proveta::neo_hookean {

/// F must have a positive determinant; otherwise the answer is not a number.
inline SolidResponse respond(const Lame& c, const Mat3& F) {
    const double log_j = std::log(F.determinant());
    const Mat3 turned = F.inverse().transpose();
    return {c.mu * (F - turned) + c.lambda * log_j * turned,
            0.5 * c.lambda * log_j * log_j - c.mu * log_j + 0.5 * c.mu * (F.squaredNorm() - 3.0), 0.0};
}

/// Square of the stretch across a sheet in plane stress whose area has grown by the factor `area`: lambda ln J + mu (t - 1) = 0 with
/// J^2 = area^2 t. Newton's method in ln t, whose derivative never vanishes.
inline double square_of_stretch_across(const Lame& c, double area) {
    const double log_area = std::log(area);
    double log_t = -2.0 * c.lambda * log_area / (c.lambda + 2.0 * c.mu); // exact for small strain
    for (int k = 0; k < 20; ++k) {
        const double t = std::exp(log_t);
        const double value = c.lambda * (log_area + 0.5 * log_t) + c.mu * (t - 1.0);
        const double step = value / (0.5 * c.lambda + c.mu * t);
        log_t -= step;
        if (!(std::fabs(step) > 1e-14)) {
            break;
        }
    }
    return std::exp(log_t);
}

} // namespace proveta::neo_hookean
