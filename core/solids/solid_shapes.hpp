// Meshes of deformable bodies made by the program. All in metres.
#pragma once

#include "core/solids/solid_mesh.hpp"

namespace proveta {

/// A box about the origin of nx x ny x nz hexahedra; with `tetrahedra` each is cut into six tetrahedra around the diagonal from its lowest
/// to its highest corner, so that neighbours match. Groups x-, x+, y-, y+, z-, z+: the nodes of the sides.
SolidMesh box_mesh(const Vec3& size, int nx, int ny, int nz, bool tetrahedra);

/// A solid cylinder about z from 0 to `height` of hexahedra: a square core of `core` x `core` cells, `rings` of cells around it, `layers`
/// along z. Groups z-, z+ and side.
SolidMesh cylinder_mesh(double radius, double height, int core, int rings, int layers);

/// A tube of membrane triangles about z from 0 to `height`, open at its ends; it faces outwards. `around` nodes on each ring, `layers` of
/// quadrilaterals cut in two, each layer turned by half a cell against the last so that triangles are near equilateral. Groups z-, z+.
SolidMesh tube_membrane(double radius, double height, int around, int layers);

/// A sphere of membrane triangles about the origin: an icosahedron cut `cuts` times; it faces outwards.
SolidMesh sphere_membrane(double radius, int cuts);

/// A rectangle of membrane triangles about the origin across z, nx x ny cells each cut in two with diagonals that alternate; it faces up.
/// Groups x-, x+, y-, y+ and rim.
SolidMesh sheet_membrane(double length_x, double length_y, int nx, int ny);

} // namespace proveta
