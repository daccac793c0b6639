// Stones: convex bodies with plane facets, as crushed rock has them.
#pragma once

#include <cstdint>

#include "core/boundaries/surface_mesh.hpp"
#include "core/particles/clusters.hpp"

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

/// The same form `factor` times as large.
ClusterShape scaled(const ClusterShape& shape, double factor);

} // namespace proveta
