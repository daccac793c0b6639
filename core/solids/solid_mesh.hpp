// The mesh of a deformable body: linear tetrahedra, 8-node hexahedra and membrane triangles.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Nodes and elements. Tetrahedra and hexahedra are numbered as in VTK and Gmsh: of a tetrahedron the fourth node lies on the side that the
/// first three, counter-clockwise, face; of a hexahedron the upper four stand over the lower four, which are counter-clockwise seen from
/// above. Membranes face where their corners are counter-clockwise seen from.
struct SolidMesh {
    using Tetrahedron = std::array<std::uint32_t, 4>;
    using Hexahedron = std::array<std::uint32_t, 8>;
    using Triangle = std::array<std::uint32_t, 3>;

    /// Nodes with a name, such as a physical group of a mesh file.
    struct Group {
        std::string name;
        std::vector<std::uint32_t> node; ///< ascending
    };

    std::vector<Vec3> node; ///< m
    std::vector<Tetrahedron> tetrahedra;
    std::vector<Hexahedron> hexahedra;
    std::vector<Triangle> membranes;
    std::vector<Group> groups;

    [[nodiscard]] std::size_t elements() const { return tetrahedra.size() + hexahedra.size() + membranes.size(); }
};

/// What is wrong with a mesh, in words; empty when the calculation can use it: nodes out of range or not numbers, elements without volume
/// or area, or turned inside out, nodes of no element.
std::vector<std::string> problems_of(const SolidMesh& mesh);

/// The same without nodes that no element uses, and with inverted tetrahedra and hexahedra turned right. Returns how many were turned.
std::size_t tidy(SolidMesh& mesh);

/// A face of a body's surface: three corners, or four of a hexahedron; counter-clockwise seen from outside.
struct SkinFace {
    std::array<std::uint32_t, 4> node; ///< the last of a triangle equals its third
    bool quadrilateral = false;
};

/// The faces that belong to one element only, and all membranes; in the order of the elements.
std::vector<SkinFace> skin_of(const SolidMesh& mesh);

/// Volume of tetrahedra and hexahedra, m3 (those of bent faces: by the hexahedron's own shape functions).
double volume_of(const SolidMesh& mesh);

} // namespace proveta
