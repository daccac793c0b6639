// Pieces that hold together by bonds.
#pragma once

#include <cstdint>
#include <vector>

#include "core/model.hpp"

namespace proveta {

/// Number of the fragment of each sphere: connected by bonds that have not failed, numbered by size, 0 the largest.
std::vector<int> fragments(const Bonds& bonds, std::size_t spheres);
std::vector<int> fragments(const Model& model);

/// Number of spheres in each fragment, by its number.
std::vector<std::size_t> fragment_sizes(const std::vector<int>& fragments);

/// Marks spheres that have come off: those in fragments of less than a hundredth of all spheres. Averages over the specimen leave them out.
std::vector<std::uint8_t> detached_spheres(const Model& model);

} // namespace proveta
