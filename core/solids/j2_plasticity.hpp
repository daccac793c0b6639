// Von Mises plasticity at finite strain with linear isotropic hardening: F = F_e F_p (thesis 4.40-4.42), elastic in Hencky's logarithmic
// strain, returned to the yield surface along the radius (J. C. Simo, Comput. Methods Appl. Mech. Engrg. 99 (1992) 61-112).
//
//   b_e = F C_p^-1 F^T     eps = ln(b_e)/2     tau = kappa tr(eps) 1 + 2 mu dev(eps)     w = kappa/2 tr(eps)^2 + mu dev(eps):dev(eps)
//   yield   q = sqrt(3/2) |dev tau| <= sigma_Y + H alpha
//   return  dalpha = (q_trial - sigma_Y - H alpha)/(3 mu + H), dev(eps) shortened by 3 mu dalpha / q_trial
//
// In logarithmic strain the small-strain closed forms hold at any strain: uniaxially tau = sigma_Y + E H/(E + H) (ln l - sigma_Y/E).
// The thesis names a hyperelastic law without saying which; at the elastic strains of metals Hencky's and Neo-Hooke's are alike.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/solids/solid_material.hpp"

namespace proveta::j2 {

/// Advances the state to the deformation gradient F, of positive determinant.
inline SolidResponse respond(const SolidMaterial& m, const Mat3& F, PlasticState& state) {
    const Lame c = m.lame();
    const double kappa = c.lambda + 2.0 / 3.0 * c.mu;
    const Mat3 elastic = F * state.inverse * F.transpose();
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.compute(0.5 * (elastic + elastic.transpose()));
    const Vec3 log_strain = 0.5 * solver.eigenvalues().array().log().matrix();
    const double trace = log_strain.sum();
    Vec3 deviator = log_strain.array() - trace / 3.0;
    const double q = std::sqrt(1.5) * 2.0 * c.mu * deviator.norm();
    const double excess = q - m.yield_stress - m.hardening * state.strain;
    SolidResponse r;
    if (excess > 0.0) {
        const double growth = excess / (3.0 * c.mu + m.hardening);
        deviator *= 1.0 - 3.0 * c.mu * growth / q;
        // Work of the stress along the step: the yield stress grows linearly meanwhile.
        r.plastic = growth * (m.yield_stress + m.hardening * (state.strain + 0.5 * growth));
        state.strain += growth;
        const Mat3& axes = solver.eigenvectors();
        const Vec3 squares = (2.0 * (deviator.array() + trace / 3.0)).exp().matrix();
        const Mat3 back = F.inverse();
        const Mat3 inverse = back * (axes * squares.asDiagonal() * axes.transpose()) * back.transpose();
        state.inverse = 0.5 * (inverse + inverse.transpose());
    }
    const Vec3 tau = 2.0 * c.mu * deviator + Vec3::Constant(kappa * trace);
    r.first_piola = solver.eigenvectors() * tau.asDiagonal() * solver.eigenvectors().transpose() * F.inverse().transpose();
    r.stored = 0.5 * kappa * trace * trace + c.mu * deviator.squaredNorm();
    return r;
}

} // namespace proveta::j2
