// Pressures on the surface of a specimen (thesis 5.5.3).
#pragma once

#include "core/boundaries/pressure.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Pressure on the lateral surface: spheres whose centre lies within 1.2 radii of it, with shares pi R^2 of the surface that add up to it.
/// On a cylinder the normals follow the specimen; on a prism each sphere belongs to its nearest side.
Pressure lateral_pressure(const Shape& shape, const Spheres& spheres);

/// The same on one end: the upper one for outward = +1, the lower for -1.
Pressure end_pressure(const Shape& shape, const Spheres& spheres, double outward);

} // namespace proveta
