// Lists of three numbers of a scene's input as vectors, and its boxes.
#pragma once

#include <fmt/format.h>

#include <string>
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

/// Adds a note where a file's points span more than a laboratory holds, as those in mm do. whose: "Surface \"s\"".
inline void say_size(const std::string& whose, const std::vector<Vec3>& points, std::vector<std::string>& notes) {
    constexpr double long_length = 10.0; // m
    Eigen::AlignedBox3d box;
    for (const auto& p : points) {
        box.extend(p);
    }
    if (const Vec3 size = box.sizes(); !points.empty() && size.maxCoeff() > long_length) {
        notes.push_back(
            fmt::format("{} is {:.4g} x {:.4g} x {:.4g} m: if its file is in mm, \"scale\": 0.001.", whose, size.x(), size.y(), size.z()));
    }
}

} // namespace proveta
