// Which parameter shapes a result, and which part of a curve.
#pragma once

#include <optional>
#include <vector>

#include "lab/series/mean_curve.hpp"
#include "lab/sweep/design.hpp"

namespace proveta {

/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values);

/// Spearman's rank correlation (1904): Pearson's of the ranks, -1 to 1. Counts pairs of which both are finite; empty for fewer than three
/// of them, or when one of the two does not vary.
std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// The magnitude that a rank correlation of n independent pairs exceeds once in twenty: t / sqrt(n - 2 + t^2) with the two-sided 95 %
/// quantile t of Student's distribution for n - 2 degrees of freedom, an approximation that is good from about 10 pairs on. 1 for fewer
/// than 4.
double significant_correlation(std::size_t n);

/// Elementary effects of one parameter on a result.
struct Effects {
    std::size_t n = 0;    ///< effects that could be determined
    double mu = 0.0;      ///< mean: change of the result per full range of the parameter, in the result's unit
    double mu_star = 0.0; ///< mean of their magnitudes (Campolongo, Cariboni, Saltelli 2007)
    double sigma = 0.0;   ///< standard deviation over n - 1: interactions and curvature; not a number for one effect
};

/// Of Morris' trajectories and the results at their points; effects with a result that is not finite are left out. One entry a parameter.
std::vector<Effects> elementary_effects(const std::vector<Point>& points, const std::vector<double>& y);

/// How a curve's y depends on each parameter, along x.
struct CurveSensitivity {
    std::vector<double> x;              ///< common to all curves, in equal steps
    std::vector<double> mean;           ///< of y over the points
    std::vector<std::vector<double>> s; ///< for each parameter, at each x: rank correlation, or Morris' mu* over the largest of any
                                        ///< parameter anywhere; not a number where there is none
    std::size_t n = 0;                  ///< points with a curve
};

/// curves: one a point, an empty one where it failed. Empty without a common range of x.
std::optional<CurveSensitivity> curve_sensitivity(const std::vector<Point>& points, const std::vector<SampledCurve>& curves,
                                                  bool trajectories, std::size_t samples = 101);

} // namespace proveta
