// Particles that are all there at the start: packed into a box without overlaps that matter.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Largest overlap, over the smaller radius, with which grown particles may start. Most start with a fifth of it.
constexpr double most_grown_overlap = 0.05;

/// Share of a box that equal spheres fill at most, and that they fill at random.
constexpr double densest_share = 0.74;
constexpr double usual_share = 0.6;

/// Spheres in a box.
struct Grown {
    std::vector<Vec3> centre;        ///< m
    std::vector<std::size_t> number; ///< of each in the list of radii
};

/// Packs spheres of the given radii, in m, into the box at random. Where they do not fit without overlaps above `most_grown_overlap`, fewer
/// of them, the same mixture, come back: about as many as do fit.
Grown grow_in(const Eigen::AlignedBox3d& box, const std::vector<double>& radii, std::uint64_t seed);

/// Volume of spheres over that of the box.
double filled_share(const Eigen::AlignedBox3d& box, const std::vector<double>& radii);

} // namespace proveta
