// Units at the door: a number is SI, a string may carry its unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/input/declare.hpp"

namespace proveta::input {

/// SI unit of a dimension as text, e.g. "Pa"; empty for pure numbers.
std::string si_unit(Unit unit);

/// Unit texts accepted for a dimension, SI first.
std::vector<std::string> accepted_units(Unit unit);

/// The dimension that an SI unit is the unit of; the first where several have it, none where it is no unit.
std::optional<Unit> dimension_of(const std::string& si);

/// Result of reading a text such as "28 GPa".
struct Quantity {
    double value = 0.0;  ///< SI
    std::string problem; ///< empty when all went well
};

/// Reads a number and its unit ("150 mm", "0.3", "60 %"). Never throws; NaN and infinities are problems.
Quantity parse_quantity(const std::string& text, Unit unit);

/// A value with a handy unit, e.g. "28 GPa", for people to read.
std::string format_quantity(double value, Unit unit);

/// A number in the shortest form that reads back the same.
std::string format_number(double value);

} // namespace proveta::input
