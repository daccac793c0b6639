// Plots, roses and pictures as SVG text.
#pragma once

#include <string>
#include <vector>

#include "reports/record/record.hpp"

namespace proveta::report {

/// A text with the characters that mean something in HTML and SVG replaced.
std::string escape(const std::string& text);

/// How large a plot is drawn and lettered, in units of its viewBox.
struct PlotLook {
    double width = 640;
    double height = 380;
    double letters = 12;
    bool key = true; ///< with a key of the curves in it
};

/// Ends of a plot's axes, rounded to ticks.
struct PlotRange {
    double x0, x1, y0, y1;
};
PlotRange range_of(const Plot& plot);

/// Which sign tells each curve apart besides its colour: markers are numbered from 0; -1: none is needed.
std::vector<int> markers_of(const Plot& plot);

/// A curve's sign as a key shows it, about 26 wide and 14 high from (x, y - 7).
std::string key_sign(const Curve& curve, int marker, double x, double y);

std::string to_svg(const Plot& plot, const PlotLook& look = {});
std::string to_svg(const Rose& rose);
std::string to_svg(const Picture& picture);

} // namespace proveta::report
