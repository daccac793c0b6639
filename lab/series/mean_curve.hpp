// The mean of the curves of several specimens, with its spread.
#pragma once

#include <cstddef>
#include <vector>

#include "lab/series/outcome.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// A measured curve, e.g. axial stress over axial strain, in the order of measurement. x and y of equal length.
struct SampledCurve {
    std::vector<double> x, y;
};

/// The part of a curve that a mean can be made of: samples whose x exceeds that of all before. Where x runs backward, in a cycle of
/// unloading and reloading or by noise, the samples are left out until x has passed its former largest value, and the curve is straight
/// in between: a mean over such cycles would mix loading with unloading. Samples that are not finite are left out too.
SampledCurve advancing(const SampledCurve& curve);

/// Mean of several curves at common x, and how they scatter there. All vectors of equal length. From the first x, where the last of the
/// curves begins, up to `common` (inclusive) all curves are there; past it each mean is one of those that are left, so that it jumps where
/// a curve ends.
struct MeanCurve {
    std::vector<double> x;
    std::vector<std::size_t> curves; ///< how many reach this x
    std::vector<double> mean;
    std::vector<double> deviation;  ///< standard deviation over curves - 1; not a number for a single curve
    std::vector<double> half_width; ///< of the 95 % confidence band of the mean, each x for itself; not a number for a single curve
    std::size_t common = 0;         ///< index of the last x that all curves reach
};

/// Made of the advancing parts, linear between samples. The grid has at least `intervals` intervals, equal up to the end of the shortest
/// curve, which is a grid point, and equal from there to the end of the longest. None when a curve has fewer than two different x or when
/// there is no x that all curves share.
Outcome<MeanCurve> mean_curve(const std::vector<SampledCurve>& members, std::size_t intervals = 400);

/// mean_curve.csv. x, y: the columns that the curves were made of; those of the table are named after them.
report::Table mean_curve_table(const MeanCurve& mean, const report::Column& x, const report::Column& y);

/// How the numbers of a plot are shown: factors to the units in the axis titles.
struct PlotAxes {
    std::string title;
    std::string x_title, y_title;
    double x_factor = 1.0, y_factor = 1.0;
};

/// Members thin and grey (whole, cycles included), the mean bold, its confidence band dashed; the last two as far as all curves reach.
report::Plot mean_curve_plot(const MeanCurve& mean, const std::vector<SampledCurve>& members, const PlotAxes& axes);

} // namespace proveta
