// Where a result goes as what it is studied by goes to zero.
#pragma once

#include <optional>
#include <vector>

namespace proveta {

/// Fit of y = limit + slope x^power by least squares.
struct Extrapolation {
    double limit = 0.0;
    double slope = 0.0;
    double power = 1.0;
    std::optional<double> half_width; ///< of the 95 % confidence interval of the limit, for normal errors and the power taken as known
};

/// Fits values y found at x > 0; several values may belong to one x. With four or more different x the power is the one of 1/2, 1 and 2
/// that fits best; with fewer it is 1. Empty for fewer than two different x.
std::optional<Extrapolation> extrapolate(const std::vector<double>& x, const std::vector<double>& y);

} // namespace proveta
