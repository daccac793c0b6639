// The curves of a test: what is drawn of them, and which one stands for the test.
#pragma once

#include <vector>

#include "lab/series/mean_curve.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// The test's own plots, then what every test shows. sense: that of the press; bonded: the specimen has bonds that can fail. Throws
/// std::out_of_range when the protocol draws columns that there are not.
std::vector<report::Plot> test_plots(const Protocol& protocol, double sense, bool bonded, const TestData& data);

/// The curve that stands for a test: the first of its first plot, in SI units and in the sense that the test draws it.
struct MainCurve {
    SampledCurve values;
    report::Column x, y; ///< the columns of the curve or the energies that it is made of
    PlotAxes axes;       ///< how it is drawn
};

/// Throws std::out_of_range when the protocol draws columns that there are not.
MainCurve main_curve(const Protocol& protocol, const TestData& data);

} // namespace proveta
