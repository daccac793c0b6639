// Relative motion of two spheres at their contact point, shared by bonds and loose contacts.
#pragma once

#include <cstdint>

#include "core/geometry/lanes.hpp"
#include "core/geometry/rows.hpp"
#include "core/particles/sphere_view.hpp"

namespace proveta {

/// Motion of a pair (or of a vector of pairs) over one step. n points from i to j.
template <class T> struct PairKinematics {
    T n[3];
    T distance;   ///< of the centres, m
    T separation; ///< speed at which the centres part, m/s
    T slip[3];    ///< tangential displacement of j's contact point against i's in the step, m
    T turned[3];  ///< the old tangential displacement, carried with the pair's frame, m
    T turn[3];    ///< change of n in the step
    T twist;      ///< rotation about n in the step by the mean spin, rad
    T rolled[3];  ///< rotation of j against i in the step, rad
};

/// Geometry and relative motion of the pairs i[0..], j[0..] (2.6-2.13). share: lever arm of i over the distance; u: tangential
/// displacement so far, m; dt in s. The old displacement turns with n by the smallest rotation and about n by the mean spin, to second
/// order in the angles of a step, which keeps its length to fourth.
template <class T>
PROVETA_INLINE PairKinematics<T> pair_kinematics(const SphereView& s, const std::int32_t* i, const std::int32_t* j, const T& share,
                                                 const T (&u)[3], double dt) {
    PairKinematics<T> k;
    T n[3];
    T dv[3];
    T w_i[3];
    T w_j[3];
    const NearGather<T> of_i(i, s.count);
    for (int c = 0; c < 3; ++c) {
        n[c] = gather<T>(s.position[c], j) - of_i(s.position[c]);
        dv[c] = gather<T>(s.velocity[c], j) - of_i(s.velocity[c]);
        w_i[c] = of_i(s.spin[c]);
        w_j[c] = gather<T>(s.spin[c], j);
    }
    const T square = dot(n, n);
    const T inverse = inverse_sqrt(square);
    k.distance = square * inverse;
    for (int c = 0; c < 3; ++c) {
        n[c] = n[c] * inverse;
        k.n[c] = n[c];
    }

    // Relative velocity of the contact points: dv - d (share_i w_i + share_j w_j) x n.
    T w[3];
    T spin[3];
    for (int c = 0; c < 3; ++c) {
        k.rolled[c] = w_j[c] - w_i[c];
        w[c] = k.distance * sub_mul(w_j[c], share, k.rolled[c]);
        spin[c] = w_i[c] + w_j[c];
        k.rolled[c] = k.rolled[c] * dt;
    }
    k.separation = dot(dv, n);
    const T twist = 0.5 * dt * dot(spin, n);
    k.twist = twist;
    const T out_of_plane = dot(u, n);
    const T shrink = sub_mul(T(1.0), T(0.5 * twist), twist);
    const T per_turn = inverse * dt;
    for (int c = 0; c < 3; ++c) {
        const T tangential = sub_mul(dv[c], k.separation, n[c]);
        k.slip[c] = (tangential - cross(w, n, c)) * dt;
        k.turn[c] = tangential * per_turn; // change of n in the step
        const T turned = mul_add(twist, cross(n, u, c), T(u[c] * shrink));
        k.turned[c] = sub_mul(turned, out_of_plane, sub_mul(n[c], T(0.5), k.turn[c]));
    }
    return k;
}

/// Distance of two centres by the very operations of `pair_kinematics`, so that a pair which has not moved has no overlap, to the last bit.
PROVETA_INLINE double distance_at_rest(double x, double y, double z) {
    const double to[3] = {x, y, z};
    const double square = dot(to, to);
    return square * inverse_sqrt(square);
}

/// Adds the pairs to their spheres' loads: normal force (compression positive) and shear force of j on i, in N. The contact point divides
/// the line of centres in the proportion `share`, so that i gets this share of the moment d n x F as torque and j the rest: r_c x F
/// (2.4-2.9). couple: moment of j on i besides, N m. Returns the force on i.
template <class T> struct Vector3 { T x[3]; };
template <class T>
PROVETA_INLINE Vector3<T> add_pair_loads(double* rows, const std::int32_t* i, const std::int32_t* row_j, const PairKinematics<T>& k,
                                         const T& share, const T& normal, const T (&shear)[3], const T (&couple)[3]) {
    T on_i[6];
    T on_j[6];
    for (int c = 0; c < 3; ++c) {
        on_i[c] = sub_mul(shear[c], normal, k.n[c]);
        on_j[c] = -on_i[c];
        const T moment = k.distance * cross(k.n, shear, c);
        on_i[3 + c] = mul_add(share, moment, couple[c]);
        on_j[3 + c] = moment - on_i[3 + c];
    }
    add_rows(rows, i, row_j, on_i, on_j);
    return {{on_i[0], on_i[1], on_i[2]}};
}

} // namespace proveta
