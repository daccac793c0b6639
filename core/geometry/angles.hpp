// Angles for people; the program reckons in radians.
#pragma once

#include <numbers>

namespace proveta {

inline constexpr double degrees = 180.0 / std::numbers::pi; ///< in a radian

} // namespace proveta
