// Pressures on the surface of a specimen (thesis 5.5.3).
#pragma once

#include "core/bonds/bonds.hpp"
#include "core/boundaries/pressure.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Pressure on the lateral surface, normalised to its true area; it follows the specimen. Throws std::invalid_argument when there are too
/// few spheres at the side.
Pressure lateral_pressure(const Shape& shape, const Spheres& spheres, const Bonds& bonds);

/// The same on one end: the upper one for outward = +1, the lower for -1.
Pressure end_pressure(const Shape& shape, const Spheres& spheres, const Bonds& bonds, double outward);

} // namespace proveta
