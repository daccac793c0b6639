// The elements: displacement-based, of constant or trilinear gradients, forces from the first Piola-Kirchhoff stress on the reference.
//
//   tetrahedron  one point                       f_a = -V P grad N_a                        (thesis 4.49)
//   hexahedron   eight Gauss points              f_a = -sum_q w_q P_q grad N_a
//   membrane     one point, plane stress         F = Q R with R in the sheet's own directions, f_a = -A t Q P' grad N_a
//
// Rayleigh's stiffness part is the second Piola-Kirchhoff stress a2 D : E' of the elastic tensor D at small strain and the rate of Green's
// strain: a2 K v while strains are small, and without any effect on rotations.
#pragma once

#include "core/solids/element_point.hpp"
#include "core/solids/solid_law.hpp"

namespace proveta {

/// Adds a point's forces on the element's nodes, N. x, v: positions and velocities of these.
template <int N>
PointSums add_point(const SolidMaterial& m, const ElementPoint<N>& p, const Nodal<N>& x, const Nodal<N>& v, PlasticState* state,
                    Nodal<N>& elastic, Nodal<N>& damping) {
    const Mat3 F = x * p.gradient;
    const SolidResponse r = respond(m, F, state);
    elastic.noalias() -= p.weight * r.first_piola * p.gradient.transpose();
    if (m.stiffness_damping > 0.0) {
        const Lame c = m.lame();
        const Mat3 along = F.transpose() * (v * p.gradient);
        const Mat3 rate = 0.5 * (along + along.transpose());
        const Mat3 viscous = m.stiffness_damping * (c.lambda * rate.trace() * Mat3::Identity() + 2.0 * c.mu * rate);
        damping.noalias() -= p.weight * F * viscous * p.gradient.transpose();
    }
    return {p.weight * r.stored, p.weight * r.plastic, r.first_piola.norm()};
}

/// The same of a membrane. across: its stretch in thickness, kept from step to step.
inline PointSums add_membrane(const SolidMaterial& m, const ElementPoint<3, 2>& p, const Nodal<3>& x, const Nodal<3>& v,
                              PlasticState* state, double& across, Nodal<3>& elastic, Nodal<3>& damping) {
    using Sheet = Eigen::Matrix<double, 3, 2>;
    const Sheet F = x * p.gradient;
    Sheet Q;
    const double r11 = F.col(0).norm();
    Q.col(0) = F.col(0) / r11;
    const double r12 = Q.col(0).dot(F.col(1));
    const Vec3 rest = F.col(1) - r12 * Q.col(0);
    const double r22 = rest.norm();
    Q.col(1) = rest / r22;
    Mat3 own;
    own << r11, r12, 0.0, 0.0, r22, 0.0, 0.0, 0.0, across;
    const SolidResponse r = respond_in_plane(m, own, state);
    across = own(2, 2);
    elastic.noalias() -= p.weight * Q * r.first_piola.topLeftCorner<2, 2>() * p.gradient.transpose();
    if (m.stiffness_damping > 0.0) {
        const Lame c = m.lame();
        const double in_plane = 2.0 * c.lambda * c.mu / (c.lambda + 2.0 * c.mu);
        const Eigen::Matrix2d along = F.transpose() * (v * p.gradient);
        const Eigen::Matrix2d rate = 0.5 * (along + along.transpose());
        const Eigen::Matrix2d viscous = m.stiffness_damping * (in_plane * rate.trace() * Eigen::Matrix2d::Identity() + 2.0 * c.mu * rate);
        damping.noalias() -= p.weight * F * viscous * p.gradient.transpose();
    }
    return {p.weight * r.stored, p.weight * r.plastic, r.first_piola.norm()};
}

} // namespace proveta
