// Meshes of solids as tests look at them: their surfaces, groups and notes.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/solids/solid_shapes.hpp"
#include "specimens/solid_import.hpp"

namespace proveta::testing {

/// A face goes round them.
inline std::vector<std::uint32_t> corners(const SkinFace& face) {
    return {face.node.begin(), face.node.begin() + (face.quadrilateral ? 4 : 3)};
}

inline Vec3 twice_area(const SolidMesh& mesh, const std::vector<std::uint32_t>& corner) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
        sum += (mesh.node[corner[k]] - mesh.node[corner[0]]).cross(mesh.node[corner[k + 1]] - mesh.node[corner[0]]);
    }
    return sum;
}

/// A surface as its faces are: area, volume inside, nodes - edges + faces, and how often an edge runs one way but not the other.
struct Shell {
    double area = 0.0;
    double volume = 0.0;
    std::ptrdiff_t euler = 0;
    std::size_t open = 0;
};

inline Shell shell_of(const SolidMesh& mesh) {
    Shell out;
    std::set<std::uint32_t> nodes;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> way;
    for (const auto& face : skin_of(mesh)) {
        const auto corner = corners(face);
        out.area += 0.5 * twice_area(mesh, corner).norm();
        out.volume += mesh.node[corner[0]].dot(twice_area(mesh, corner)) / 6.0;
        for (std::size_t k = 0; k < corner.size(); ++k) {
            const auto a = corner[k];
            const auto b = corner[(k + 1) % corner.size()];
            nodes.insert(a);
            edges.insert(std::minmax(a, b));
            way[std::minmax(a, b)] += a < b ? 1 : -1;
        }
        ++out.euler;
    }
    out.euler += static_cast<std::ptrdiff_t>(nodes.size()) - static_cast<std::ptrdiff_t>(edges.size());
    for (const auto& [edge, sum] : way) {
        out.open += sum == 0 ? 0 : 1;
    }
    return out;
}

/// Nodes of a mesh's group; throws where there is none of that name.
inline const std::vector<std::uint32_t>& group(const SolidMesh& mesh, const std::string& name) {
    for (const auto& g : mesh.groups) {
        if (g.name == name) {
            return g.node;
        }
    }
    throw std::runtime_error("no group " + name);
}

/// Checks that a text holds a part, and shows both where it does not.
inline bool says(const std::string& text, const std::string& part) {
    INFO("\"" << text << "\" lacks \"" << part << "\"");
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

inline bool any_has(const std::vector<std::string>& texts, const std::string& part) {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& t) { return t.find(part) != std::string::npos; });
}

/// What the import of a mesh is refused with; empty when it is not.
inline std::string message(const std::string& file) {
    try {
        import_solid(file);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

/// The text with its first `from` as `to`; throws where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    if (at == std::string::npos) {
        throw std::runtime_error("nothing to replace: " + from);
    }
    return text.replace(at, from.size(), to);
}

} // namespace proveta::testing
