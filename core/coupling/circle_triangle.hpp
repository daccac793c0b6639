// Area and centroid of what a circle and a triangle in one plane have in common (thesis, appendix C), exactly.
#pragma once

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// A piece of a plane.
struct Piece {
    double area = 0.0;            ///< m2
    Vec3 centroid{0.0, 0.0, 0.0}; ///< m; of no meaning without area
};

/// The circle about `centre` (in the triangle's plane) of the given radius, m, and the triangle a, b, c. All eight cases of figure C.4 and
/// the limits between them.
Piece circle_triangle(const Vec3& centre, double radius, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace proveta
