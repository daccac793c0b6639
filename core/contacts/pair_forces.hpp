// Forces of pairs of spheres, kept per pair and then summed per sphere in a fixed order, so that no sum depends on threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/contacts/pair_kinematics.hpp"
#include "core/geometry/vector_field.hpp"

namespace proveta {

/// What a list of pairs (bonds or contacts) exerts. For pair k between spheres i and j with centre distance d and normal n from i to j:
/// `force` acts on i and its opposite on j; `moment` = d n x force; sphere i gets the share `share_i` of it as torque and j the rest,
/// which is r_c x F for a contact point that divides the line of centres in that proportion (2.4-2.9).
struct PairForces {
    VectorField force;              ///< N
    VectorField moment;             ///< N m
    std::vector<double> share_i;    ///< lever arm of i over d, 0 to 1

    [[nodiscard]] PairForceView view() {
        return {{force.x.data(), force.y.data(), force.z.data()}, {moment.x.data(), moment.y.data(), moment.z.data()}};
    }

    void resize(std::size_t n) {
        force.resize(n);
        moment.resize(n);
        share_i.resize(n, 0.5);
    }
};

/// For each sphere the pairs it belongs to, in ascending pair order. Entry: 2 * pair + side, side 0 for the first sphere of the pair.
struct Incidence {
    std::vector<std::uint32_t> offset;    ///< n + 1 entries
    std::vector<std::uint32_t> entry;

    [[nodiscard]] std::uint32_t degree(std::size_t sphere) const { return offset[sphere + 1] - offset[sphere]; }
};

/// Builds the incidence of `first[k]`, `second[k]` over n spheres.
Incidence make_incidence(std::size_t n, const std::vector<std::int32_t>& first, const std::vector<std::int32_t>& second);

} // namespace proveta
