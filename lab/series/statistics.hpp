// Few numbers, honestly: mean, spread and how well the mean is known.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace proveta {

/// The quantile t with P(|T| <= t) = 0.95 of Student's distribution, that is its 97.5 % quantile. To 16 digits up to 30 degrees of freedom;
/// beyond by two terms of the expansion about the normal quantile (R. A. Fisher, E. A. Cornish 1960), there to 5e-5 of its value or better.
/// Infinite for no degree of freedom.
double student_t95(std::size_t degrees_of_freedom);

/// How values scatter; needs two.
struct Spread {
    double deviation;                ///< standard deviation, over n - 1
    std::optional<double> variation; ///< deviation over the mean's magnitude; empty for a mean of zero
    double half_width;               ///< of the 95 % confidence interval of the mean: t s / sqrt(n), for values of a normal distribution
    double least, most;
};

/// Values of one quantity over a series.
struct Sample {
    std::size_t n = 0;
    double mean = 0.0;            ///< 0 for none
    std::optional<Spread> spread; ///< empty for fewer than two: one specimen says nothing of its scatter
};

/// Two passes, so that a small scatter about a large mean keeps its digits.
Sample sample_of(const std::vector<double>& values);

} // namespace proveta
