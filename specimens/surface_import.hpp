// Surfaces of others: STL, OBJ, PLY and VTK files.
#pragma once

#include <string>
#include <vector>

#include "core/boundaries/surface_mesh.hpp"

namespace proveta {

constexpr double farthest_corner = 1e12; ///< of a surface, m: what lies beyond is a mistake

/// A surface as read, fit for contact.
struct ImportedSurface {
    SurfaceMesh mesh;
    SurfaceState state;             ///< of `mesh`
    std::vector<std::string> notes; ///< what was mended on the way, and what a user should know
};

/// Reads a surface by the file's ending: `.stl` (text or binary), `.obj`, `.ply`, `.vtk`, `.vtp`. scale: metres per unit of the file.
/// Vertices that coincide become one; faces without area and faces that are there twice go; polygons that are bent or not convex are cut
/// into triangles. Throws std::runtime_error, saying what, for a file that cannot be read or holds no face.
ImportedSurface import_surface(const std::string& file, double scale);

} // namespace proveta
