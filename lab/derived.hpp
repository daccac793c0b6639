// Results derived from curves. Compression positive throughout.
#pragma once

#include <optional>
#include <vector>

namespace proveta {

/// A straight line through points by least squares.
struct Line {
    double slope = 0.0;
    double intercept = 0.0;
};

/// Fit through the points of (x, y) with index in [first, last]; nothing with fewer than two different x.
std::optional<Line> fit(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last);

/// Index of the largest value, 0 for none.
std::size_t peak_index(const std::vector<double>& y);

/// First index up to `last` at which y reaches `level`.
std::optional<std::size_t> first_reaching(const std::vector<double>& y, double level, std::size_t last);

/// Slope of y over x between two shares of the peak of y, on the way up.
std::optional<double> slope_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share);

/// Linear interpolation of y at the first crossing of the share of the peak, as (x, y).
std::optional<double> x_at_share(const std::vector<double>& x, const std::vector<double>& y, double share);

} // namespace proveta
