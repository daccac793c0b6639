// Mohr circles of a single test that is confined.
#pragma once

#include <optional>

#include "reports/record/record.hpp"

namespace proveta {

/// Half circles at half the largest deviator, at the largest, and at the end, MPa. None where the side carries nothing or as much as the
/// axis. curve: the test's. loose: cohesionless matter, whose friction angle at the largest deviator is a line from the origin.
std::optional<report::Plot> circles_of_test(const report::Table& curve, bool loose);

} // namespace proveta
