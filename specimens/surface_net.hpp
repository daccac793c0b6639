// The specimen's surface as a net of triangles between its surface spheres, for pressures that follow it.
#pragma once

#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/boundaries/pressure.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Facets between the centres of surface spheres; see `make_pressure`.
struct SurfaceNet {
    std::vector<std::int32_t> sphere; ///< ascending
    std::vector<double> raise;        ///< m
    VectorField normal;               ///< of the true surface, outward
    std::vector<SurfaceTriangle> facets;
    double surface = 0.0; ///< true area that the net stands for, m2
};

/// Net of the side: spheres whose centre lies within 1.2 radii of it and that four bonds or more hold (fewer are a hinge, which a push from
/// outside folds), joined by the Delaunay triangulation of the unrolled side. Those
/// that lie as near to an end are the rim and count as lying in the end's plane. A plate has no such net. Throws std::invalid_argument
/// when there are too few spheres to go around.
SurfaceNet side_net(const Shape& shape, const Spheres& spheres, const Bonds& bonds);

/// Net of an end, flat in the end's plane: the upper one for outward = +1, the lower for -1.
SurfaceNet end_net(const Shape& shape, const Spheres& spheres, const Bonds& bonds, double outward);

} // namespace proveta
