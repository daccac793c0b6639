// Stones: convex bodies with plane facets, as crushed rock has them.
#pragma once

#include <cstdint>

#include "core/boundaries/surface_mesh.hpp"
#include "core/particles/clusters.hpp"
#include "specimens/random.hpp"

namespace proveta {

/// A kind of stones by its ratios of axes (Th. Zingg, Schweiz. Mineral. Petrogr. Mitt. 15, 39, 1935).
struct StoneKind {
    double elongation = 0.75; ///< intermediate over longest axis, 0 to 1
    double flatness = 0.75;   ///< shortest over intermediate axis, 0 to 1
    int facets = 14;          ///< at least 6; the fewer, the more angular
};

/// A stone of the volume of a sphere of diameter 1: a polyhedron around an ellipsoid with these ratios of axes, touched by each facet; the
/// facets lie at random, none near another. Closed, normals outwards. The same kind and seed give the same stone.
SurfaceMesh stone_surface(const StoneKind& kind, std::uint64_t seed);

/// A stone at its place.
struct Stone {
    int form = 0;                                      ///< which of the forms
    double size = 0.0;                                 ///< diameter of the sphere of its volume, m
    Vec3 position = Vec3::Zero();                      ///< centre of mass, m
    rotation::Quaternion attitude{1.0, 0.0, 0.0, 0.0}; ///< turns the form's principal frame into space
};

/// A form of size 1, the diameter of the sphere of its volume, from a closed surface. Inscribed spheres, `spheres` of them at most, fill
/// less than the body; they are enlarged so that their union has its volume, for a bed of clusters to be as dense as one of bodies. Throws
/// std::invalid_argument as `fill_with_spheres`.
ClusterShape form_of(const SurfaceMesh& closed, int spheres);

/// Radius of the sphere about a form's centre of mass that holds all of its spheres, m.
double reach_of(const ClusterShape& form);

/// Uniform over all attitudes.
rotation::Quaternion any_attitude(Random& random);

/// The same form `factor` times as large.
ClusterShape scaled(const ClusterShape& shape, double factor);

} // namespace proveta
