// One place that knows all laws of deformable bodies: in three dimensions, and in plane stress for membranes.
#pragma once

#include "core/solids/j2_plasticity.hpp"
#include "core/solids/kirchhoff.hpp"
#include "core/solids/neo_hookean.hpp"

namespace proveta {

/// Stress and energy at a deformation gradient; a plastic law advances its state.
inline SolidResponse respond(const SolidMaterial& m, const Mat3& F, PlasticState* state) {
    switch (m.law) {
    case SolidLaw::kirchhoff: return kirchhoff::respond(m.lame(), F);
    case SolidLaw::neo_hookean: return neo_hookean::respond(m.lame(), F);
    case SolidLaw::j2: return j2::respond(m, F, *state);
    }
    return {};
}

/// The same in a sheet whose third direction bears no stress. F is block-diagonal: the sheet's own gradient in its first two directions,
/// the stretch across it in the third, which is found and given back there. state: as in `respond`.
inline SolidResponse respond_in_plane(const SolidMaterial& m, Mat3& F, PlasticState* state) {
    const Lame c = m.lame();
    if (m.law == SolidLaw::kirchhoff) {
        const double trace = 0.5 * (F.topLeftCorner<2, 2>().squaredNorm() - 2.0);
        F(2, 2) = std::sqrt(kirchhoff::square_of_stretch_across(c, trace));
        return kirchhoff::respond(c, F);
    }
    if (m.law == SolidLaw::neo_hookean) {
        F(2, 2) = std::sqrt(neo_hookean::square_of_stretch_across(c, F.topLeftCorner<2, 2>().determinant()));
        return neo_hookean::respond(c, F);
    }
    // Newton's method on the stress across, with the elastic stiffness as slope at first and the chord through the last two points then.
    double before = F(2, 2);
    double stress_before = 0.0;
    for (int k = 0; k < 50; ++k) {
        PlasticState trial = *state;
        const SolidResponse r = j2::respond(m, F, trial);
        const double stress = r.first_piola(2, 2);
        if (std::fabs(stress) <= 1e-10 * m.young_modulus || k == 49 || !std::isfinite(stress)) {
            *state = trial;
            return r;
        }
        const double slope = k == 0 ? c.lambda + 2.0 * c.mu : (stress - stress_before) / (F(2, 2) - before);
        before = F(2, 2);
        stress_before = stress;
        F(2, 2) = std::max(0.5 * F(2, 2), F(2, 2) - stress / (slope > 0.0 ? slope : c.lambda + 2.0 * c.mu));
    }
    return {};
}

} // namespace proveta
