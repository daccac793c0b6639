// Lists of three numbers of a scene's input as vectors, and its boxes.
#pragma once

#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

inline Vec3 vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// Turned about the axes x, then y, then z, by angles in rad.
inline Eigen::Quaterniond attitude(const std::vector<double>& turned) {
    return Eigen::AngleAxisd(turned[2], Vec3::UnitZ()) * Eigen::AngleAxisd(turned[1], Vec3::UnitY()) *
           Eigen::AngleAxisd(turned[0], Vec3::UnitX());
}

/// The box between two corners of anything that has `from` and `to`.
template <class Region> Eigen::AlignedBox3d box_of(const Region& region) { return {vector(region.from), vector(region.to)}; }

} // namespace proveta
