// Whether platens can press on a specimen at all, seen before anything is solved.
#pragma once

#include <optional>
#include <string>

#include "core/bonds/bonds.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Why a network cannot be pressed between platens along z like a solid body: they touch too few spheres, or it is in pieces. Empty: it
/// can.
std::optional<std::string> not_pressable(const Shape& shape, const Spheres& spheres, const Bonds& bonds);

/// How many spheres the platens touch, in words.
std::string touched_spheres(const Shape& shape, const Spheres& spheres);

} // namespace proveta
