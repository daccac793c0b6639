// Spheres as files of others have them, before they are a specimen.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

struct ReadSphere {
    Vec3 centre = Vec3::Zero(); ///< in the file's unit, or m where `ReadSpheres::in_metres`
    double radius = 0.0;
    int group = 0;
    long long number = 0; ///< of its line or node
};

struct ReadSpheres {
    std::vector<ReadSphere> spheres;
    const char* numbered = "line";     ///< what the spheres' numbers are of
    bool in_metres = false;            ///< the file says its units
    std::vector<std::string> notes;    ///< what was read as what
    std::vector<std::string> warnings; ///< what was read but not used

    /// "line 5", "node 141".
    [[nodiscard]] std::string where(std::size_t sphere) const { return fmt::format("{} {}", numbered, spheres[sphere].number); }
};

/// Tables of spheres: headings say what the columns are; without headings x, y, z, r and a group, if that is the one reading that makes
/// sense. columns: what they are in their order, "x,y,z,d,-", instead; empty: as above. Throws std::runtime_error with file, line and
/// reason.
ReadSpheres read_sphere_table(const std::string& file, const std::string& columns);

/// Kratos: blocks Nodes, NodalData RADIUS and COHESIVE_GROUP, each closed; every node has a radius.
ReadSpheres read_mdpa(const std::string& file);

/// GiD, ASCII or binary (little-endian, as GiD writes meshes of spheres).
ReadSpheres read_gid(const std::string& file);

} // namespace proveta
