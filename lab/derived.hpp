// Arithmetic on stress-strain curves that derived results share.
#pragma once

#include <optional>
#include <vector>

#include "reports/record/record.hpp"

namespace proveta {

/// A line y = slope x + intercept.
struct Line {
    double slope = 0.0;
    double intercept = 0.0;
};

/// Least-squares line through the points first to last, both included; empty when x does not vary.
std::optional<Line> fit(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last);

/// Index of the largest value; 0 for an empty list.
std::size_t peak_index(const std::vector<double>& y);

/// First index, up to `last`, whose value reaches `level`.
std::optional<std::size_t> first_reaching(const std::vector<double>& y, double level, std::size_t last);

/// Line of y over x between the points where y first reaches `from_share` and `to_share` of its peak.
std::optional<Line> line_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share);
/// Its slope.
std::optional<double> slope_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share);

/// x where y first reaches `share` of its peak, by linear interpolation.
std::optional<double> x_at_share(const std::vector<double>& x, const std::vector<double>& y, double share);

/// y where x first reaches a value, by linear interpolation; empty when it never does.
std::optional<double> y_at(const std::vector<double>& x, const std::vector<double>& y, double at);

/// Offset yield: the first y that lies below the line of slope `modulus` through the foot of `line`, shifted by `offset` along x. Empty
/// when there is none.
std::optional<double> offset_yield(const std::vector<double>& x, const std::vector<double>& y, const Line& line, double offset);

/// The loading of a test, off which unloading and reloading, and stages that only prepare it, are left. Strains and stresses in the sense
/// of the test (positive as it goes on); strains count from where the loading began, stresses are total, Pa.
struct Loading {
    std::vector<std::size_t> row; ///< of the curve
    std::vector<double> strain;   ///< of the platens
    std::vector<double> gauge, girth, volume;
    std::vector<double> stress, deviator;
};
Loading loading_of(const report::Table& curve, double sense);

/// Phases in the curve's column `phase`.
constexpr double phase_preparing = 0.0;
constexpr double phase_loading = 1.0;
constexpr double phase_cycling = 2.0;

/// The first n samples of a loading.
Loading first_samples(const Loading& loading, std::size_t n);

} // namespace proveta
