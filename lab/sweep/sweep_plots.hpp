// The plots of a sweep's page.
#pragma once

#include "lab/sweep/sweep_report.hpp"

namespace proveta {

/// Values in the unit that suits their largest.
struct Shown {
    std::string unit;
    double factor = 1.0;

    /// name: of the result or parameter, which may say what it is: a strain, a modulus.
    Shown(const std::string& name, const std::string& si_unit, const std::vector<double>& values);
    [[nodiscard]] std::string text(double v) const;
    [[nodiscard]] std::string heading(const std::string& name) const;
};

/// What the own values of a parameter are called: those of a multiple are in no unit.
std::string label(const Parameter& p);
/// They in the unit that suits them.
Shown shown(const Sweep& sweep, std::size_t parameter);

/// Main curves of all points.
report::Plot all_curves_plot(const TestCurves& curves);

/// Who shapes what part of the curve: needs its sensitivity.
report::Plot along_curve_plot(const Sweep& sweep, const TestCurves& curves);

/// Bars of some results of a test, a row a parameter, the one that matters most for the first result on top.
report::Plot influence_plot(const Sweep& sweep, const SweepOutcome& outcome, const std::string& test,
                            const std::vector<std::size_t>& columns);

/// A result over the parameter that matters most for it.
report::Plot scatter_plot(const Sweep& sweep, const SweepOutcome& outcome, std::size_t column);

} // namespace proveta
