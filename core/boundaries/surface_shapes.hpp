// Surfaces made by the program. All in metres; normals point outwards of closed ones.
#pragma once

#include "core/boundaries/surface_mesh.hpp"

namespace proveta {

/// A rectangle about the origin across z, in one face; lengths along x and y.
SurfaceMesh plane_surface(double length_x, double length_y);
/// A box about the origin, in six faces.
SurfaceMesh box_surface(const Vec3& size);
/// A disc about the origin across z: one polygon of `sides` corners on the circle.
SurfaceMesh disc_surface(double radius, int sides);
/// A cylinder or cone about z from 0 to `height`: side of quadrilaterals, or of triangles towards an apex, and the ends that are asked for.
/// sides: number of faces around; rows: along the height.
SurfaceMesh cylinder_surface(double bottom_radius, double top_radius, double height, int sides, bool bottom, bool top, int rows = 1);
/// A sphere about the origin: an icosahedron whose faces are cut in four `cuts` times, corners on the sphere.
SurfaceMesh sphere_surface(double radius, int cuts);
/// A screw's blade about z: from inner to outer radius, rising by `pitch` a turn from z = 0 to `height`; `steps` quadrilaterals a turn,
/// each cut into two triangles because it is not plane, and `rings` of them along the radius. A negative pitch turns the other way, from
/// the top.
SurfaceMesh helix_surface(double inner_radius, double outer_radius, double pitch, double height, int steps, int rings);

/// Every face cut about its edges' middles: triangles into four triangles, other polygons into quadrilaterals about their centre.
SurfaceMesh refined(const SurfaceMesh& mesh);
/// Every polygon of more than three corners cut into triangles from its first corner.
SurfaceMesh triangulated(const SurfaceMesh& mesh);

} // namespace proveta
