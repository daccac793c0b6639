// Scatter of strength over the facets of a specimen.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bonds/bonds.hpp"

namespace proveta {

/// Factors on the strengths of the bonds, one a bond, for cards of the law facet with a Weibull modulus: Weibull-distributed with mean 1,
/// alike over the correlation length l by exp(-r^2 / (2 l^2)). The same for the same specimen and seed. Empty without scatter.
std::vector<double> scattered_strengths(const Spheres& spheres, const Bonds& bonds, std::uint64_t seed);

} // namespace proveta
