// The main curves of a sweep's tests, and which parameter shapes which part of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/sweep/table.hpp"

namespace proveta {

/// The main curves of one test at all points.
struct TestCurves {
    std::string test;
    std::string x, y; ///< headings of curve.csv
    PlotAxes axes;
    std::vector<SampledCurve> at; ///< a point each, the mean over its seeds; empty where a job failed
    std::optional<CurveSensitivity> sensitivity;
};

/// Reads the curves of all jobs. A test whose main curve is none of curve.csv's columns is left out.
std::vector<TestCurves> curves_of(const Sweep& sweep, const SweepTable& table, const TrialFolders& folders);

/// curve_sensitivity.csv.
report::TextTable curve_rows(const Sweep& sweep, const std::vector<TestCurves>& curves);

} // namespace proveta
