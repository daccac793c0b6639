// Meshes of deformable bodies from files of other programs.
#pragma once

#include <string>
#include <vector>

#include "core/solids/solid_mesh.hpp"

namespace proveta {

struct ImportedSolid {
    SolidMesh mesh;
    std::vector<std::string> notes; ///< what was left out or mended
};

/// Reads a Gmsh mesh (.msh, versions 2.2 and 4.1, ASCII or binary) or a VTK one (.vtk unstructured grid, .vtu). scale: metres a unit of the
/// file. Volume elements make the body: linear tetrahedra and hexahedra; triangles and quadrilaterals (cut in two) become membranes where
/// the file has no volume elements, and are otherwise left to name groups of nodes, as points and lines are. Physical groups of Gmsh keep
/// their names (their number where they have none). Unused nodes go, inverted elements are turned. Throws std::runtime_error, saying what
/// is wrong and where, for files that cannot be read or hold no such elements, elements of other kinds (named), or elements without volume.
ImportedSolid import_solid(const std::string& file, double scale = 1.0);

} // namespace proveta
