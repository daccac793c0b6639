// Relative motion of two spheres at their contact point, shared by bonds and loose contacts.
#pragma once

#include <cstdint>

#include "core/contacts/pair_force.hpp"
#include "core/geometry/lanes.hpp"
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
inline PairKinematics<T> pair_kinematics(const SphereView& s, const std::int32_t* i, const std::int32_t* j, const T& share, const T (&u)[3],
                                         double dt) {
    using std::sqrt;
    PairKinematics<T> k;
    T n[3];
    T dv[3];
    T w_i[3];
    T w_j[3];
    for (int c = 0; c < 3; ++c) {
        n[c] = gather<T>(s.position[c], j) - gather<T>(s.position[c], i);
        dv[c] = gather<T>(s.velocity[c], j) - gather<T>(s.velocity[c], i);
        w_i[c] = gather<T>(s.spin[c], i);
        w_j[c] = gather<T>(s.spin[c], j);
    }
    k.distance = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const T inverse = 1.0 / k.distance;
    for (auto& c : n) {
        c = c * inverse;
    }

    // Relative velocity of the contact points: dv - d (share_i w_i + share_j w_j) x n.
    T w[3];
    for (int c = 0; c < 3; ++c) {
        w[c] = k.distance * (share * w_i[c] + (1.0 - share) * w_j[c]);
    }
    k.separation = dv[0] * n[0] + dv[1] * n[1] + dv[2] * n[2];
    k.twist = 0.5 * dt * ((w_i[0] + w_j[0]) * n[0] + (w_i[1] + w_j[1]) * n[1] + (w_i[2] + w_j[2]) * n[2]);
    const T out_of_plane = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    const T twist = k.twist;
    const T shrink = 1.0 - 0.5 * twist * twist;
    for (int c = 0; c < 3; ++c) {
        const int p = (c + 1) % 3;
        const int q = (c + 2) % 3;
        const T tangential = dv[c] - k.separation * n[c];
        k.slip[c] = (tangential - (w[p] * n[q] - w[q] * n[p])) * dt;
        const T turn = tangential * inverse * dt; // change of n in the step
        k.turned[c] = u[c] * shrink + twist * (n[p] * u[q] - n[q] * u[p]) - out_of_plane * (n[c] - 0.5 * turn);
        k.n[c] = n[c];
        k.turn[c] = turn;
        k.rolled[c] = (w_j[c] - w_i[c]) * dt;
    }
    return k;
}

/// Writes pairs out[0], out[1], ...: normal force (compression positive) and shear force of j on i, N.
template <class T> inline void store_pair_forces(PairForce* out, const PairKinematics<T>& k, const T& normal, const T (&shear)[3]) {
    constexpr std::size_t stride = sizeof(PairForce) / sizeof(double);
    for (int c = 0; c < 3; ++c) {
        const int p = (c + 1) % 3;
        const int q = (c + 2) % 3;
        scatter<stride>(&out->force[c], shear[c] - normal * k.n[c]);
        scatter<stride>(&out->moment[c], k.distance * (k.n[p] * shear[q] - k.n[q] * shear[p]));
    }
}

/// Lever shares of pairs in[0], in[1], ...
template <class T> inline T load_shares(const PairForce* in) {
    if constexpr (std::is_same_v<T, double>) {
        return in->share_i;
    } else {
        return T([&](auto lane) { return in[lane].share_i; });
    }
}

} // namespace proveta
