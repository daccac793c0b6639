// Designs of experiments: which points of the unit cube to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace proveta {

/// A point of the unit cube, a coordinate for each parameter.
using Point = std::vector<double>;

/// All combinations of levels, the last parameter's changing fastest. levels: coordinates of each parameter.
std::vector<Point> grid(const std::vector<std::vector<double>>& levels);

/// n points of which each parameter has one in every n-th of its range, at a random place in it (McKay, Beckman, Conover 1979). The same
/// for a seed on every machine.
std::vector<Point> latin_hypercube(std::size_t n, std::size_t parameters, std::uint64_t seed);

/// The first n points of Sobol's sequence after the origin, with the direction numbers of Joe and Kuo (2008) as in Boost. Fills the cube
/// evenly, at its best for n a power of two. Throws std::invalid_argument for more parameters than there are direction numbers for (3667).
std::vector<Point> sobol(std::size_t n, std::size_t parameters);

/// Morris' trajectories (Technometrics 33, 1991), parameters + 1 points each: from a random point of a lattice of `levels` (even) each
/// parameter changes once, in random order, up or down by levels / (2 (levels - 1)).
std::vector<Point> morris(std::size_t trajectories, std::size_t parameters, std::size_t levels, std::uint64_t seed);

} // namespace proveta
