// Forms of clusters: mass properties of solids and of unions of spheres, and spheres that fill a solid.
#pragma once

#include <vector>

#include "core/boundaries/surface_mesh.hpp"
#include "core/particles/clusters.hpp"

namespace proveta {

/// Volume, centre and second moments of a body of density 1.
struct MassProperties {
    double volume = 0.0;         ///< m3
    Vec3 centre = Vec3::Zero();  ///< m
    Mat3 inertia = Mat3::Zero(); ///< about the centre, m5
};

/// Of the inside of a closed surface, exactly, by tetrahedra. Normals may all point inwards. Throws std::invalid_argument for an open
/// surface or one without volume.
MassProperties mass_properties(const SurfaceMesh& closed);

/// Of a union of spheres, overlaps counted once: columns along z are exact, `columns` of them along the longer side of x and y. The error
/// of the volume is about 1e-5 with 400.
MassProperties mass_properties(const std::vector<Vec3>& centre, const std::vector<double>& radius, int columns = 400);

/// Moves spheres into the principal frame of a body with these properties.
ClusterShape cluster_shape(std::vector<Vec3> centre, std::vector<double> radius, const MassProperties& body);

/// How spheres fill a solid.
struct FillRule {
    int spheres = 20;       ///< at most
    double coverage = 0.98; ///< of the volume, at which it ends
    int cells = 40;         ///< of the grid along the longest side
    double overhang = 0.0;  ///< by which spheres may stand out of the surface, over the largest inscribed radius
};

/// A cluster from a closed surface: of all spheres inscribed at the points of a grid, again and again the one that fills most of what is
/// still empty. Mass properties are those of the solid. Throws std::invalid_argument as `mass_properties`.
ClusterShape fill_with_spheres(const SurfaceMesh& closed, const FillRule& rule);

/// Share of the solid's volume that the spheres fill, and of the spheres' union that lies outside it, by the same grid.
struct Fit {
    double filled = 0.0, outside = 0.0;
};
Fit fit_of(const SurfaceMesh& closed, const ClusterShape& shape, int cells = 60);

} // namespace proveta
