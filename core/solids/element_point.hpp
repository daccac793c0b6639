// The points at which elements are integrated (elements.hpp), without the laws: what a body keeps of its elements.
#pragma once

#include <array>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// An integration point of an element with N nodes. Gradients by reference coordinates, 1/m; in a membrane by its own two directions.
template <int N, int D = 3> struct ElementPoint {
    Eigen::Matrix<double, N, D> gradient;
    double weight = 0.0; ///< reference volume, m3
};

/// Nodal vectors of an element, one a column.
template <int N> using Nodal = Eigen::Matrix<double, 3, N>;

/// What a point adds up to. stress: the largest true stress in any direction, roughly, Pa.
struct PointSums {
    double stored = 0.0, plastic = 0.0; ///< J
    double stress = 0.0;
};

/// Integration point of a tetrahedron of positive volume.
ElementPoint<4> tetrahedron_point(const Nodal<4>& x);
/// The eight of a hexahedron; a weight that is not positive tells a distorted one.
std::array<ElementPoint<8>, 8> hexahedron_points(const Nodal<8>& x);
/// The point of a membrane of the given thickness.
ElementPoint<3, 2> membrane_point(const Nodal<3>& x, double thickness);

} // namespace proveta
