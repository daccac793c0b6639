// St. Venant-Kirchhoff elasticity: Hooke's law between the second Piola-Kirchhoff stress and Green's strain (thesis 4.34-4.35).
//
//   E = (F^T F - 1)/2     S = lambda tr(E) 1 + 2 mu E     w = lambda/2 tr(E)^2 + mu E:E     P = F S
//
// Any rotation, small strain: under strong compression (below F = 1/sqrt(3) uniaxially) it softens and lets elements turn inside out.
#pragma once

#include "core/solids/solid_material.hpp"

namespace proveta::kirchhoff {

inline SolidResponse respond(const Lame& c, const Mat3& F) {
    const Mat3 strain = 0.5 * (F.transpose() * F - Mat3::Identity());
    const double trace = strain.trace();
    return {F * (c.lambda * trace * Mat3::Identity() + 2.0 * c.mu * strain), 0.5 * c.lambda * trace * trace + c.mu * strain.squaredNorm(),
            0.0};
}

/// Square of the stretch across a sheet in plane stress whose Green strains in its plane sum to `trace`: S_33 = 0.
inline double square_of_stretch_across(const Lame& c, double trace) { return 1.0 - 2.0 * c.lambda * trace / (c.lambda + 2.0 * c.mu); }

} // namespace proveta::kirchhoff
