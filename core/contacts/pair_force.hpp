// What one pair of spheres exerts, in one cache line.
#pragma once

namespace proveta {

/// Force of a pair (bond or contact) of spheres i and j with centre distance d and normal n from i to j: `force` acts on i, its opposite
/// on j; `moment` = d n x force, of which i gets the share `share_i` as torque and j the rest: r_c x F for a contact point that divides
/// the line of centres in that proportion (2.4-2.9). One line a pair, because each is read twice, by its spheres, in scattered order.
struct alignas(64) PairForce {
    double force[3] = {0.0, 0.0, 0.0};  ///< N
    double moment[3] = {0.0, 0.0, 0.0}; ///< N m
    double share_i = 0.5;               ///< lever arm of i over d, 0 to 1
    double unused = 0.0;
};

} // namespace proveta
