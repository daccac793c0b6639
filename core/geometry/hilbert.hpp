// Space-filling order: points that are near in space get near numbers, so that a bond finds its two spheres in the same cache lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Position along the Hilbert curve of a cell of the 2^bits grid (J. Skilling, AIP Conf. Proc. 707, 381, 2004).
/// cell: three indices below 2^bits; bits at most 21. Returns a key below 2^(3 bits).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> cell, int bits);

/// Permutation that sorts points along a Hilbert curve through their bounding box: the k-th place is taken by point order[k].
/// Ties keep the given order, so the result is unique. positions: metres, any number of points.
std::vector<std::uint32_t> hilbert_order(const VectorField& positions);

} // namespace proveta
