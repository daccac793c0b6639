#include "lab/sweep/sweep_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

constexpr std::size_t most_curves = 100; // of a plot
constexpr std::size_t most_lines = 8;    // of a plot that a key tells apart

std::vector<double> own_values(const Sweep& sweep, std::size_t k) {
    std::vector<double> out;
    for (const auto& values : sweep.values) {
        out.push_back(values[k]);
    }
    return out;
}

} // namespace

Shown::Shown(const std::string& name, const std::string& si_unit, const std::vector<double>& values) {
    const report::InUnit in({name, "", std::nullopt, si_unit, ""}, values);
    unit = in.unit;
    factor = in.factor;
}

std::string Shown::text(double v) const { return report::three_digits(v * factor); }

std::string Shown::heading(const std::string& name) const { return unit.empty() ? name : fmt::format("{} [{}]", name, unit); }

std::string label(const Parameter& p) { return p.times.empty() ? p.name : fmt::format("{} over {}", p.name, p.times); }

Shown shown(const Sweep& sweep, std::size_t parameter) {
    const Parameter& p = sweep.space[parameter];
    return {p.times.empty() ? p.name : "", p.times.empty() ? p.unit : "", own_values(sweep, parameter)};
}

report::Plot all_curves_plot(const TestCurves& curves) {
    report::Plot plot{fmt::format("{}: the main curves of all points.", curves.test), curves.axes.x_title, curves.axes.y_title, {}, {}};
    std::size_t drawn = 0;
    for (const auto& c : curves.at) {
        if (c.x.empty() || drawn++ >= most_curves) {
            continue;
        }
        report::Curve line{"", c.x, c.y, "#1f4e79"};
        line.width = 0.8;
        for (double& x : line.x) {
            x *= curves.axes.x_factor;
        }
        for (double& y : line.y) {
            y *= curves.axes.y_factor;
        }
        plot.curves.push_back(std::move(line));
    }
    return plot;
}

report::Plot along_curve_plot(const Sweep& sweep, const TestCurves& curves) {
    const CurveSensitivity& s = *curves.sensitivity;
    const bool morris = sweep.trajectories();
    report::Plot plot{
        fmt::format("{}: who shapes what part of the curve. {} of {} at each {} with the parameters, over {} points, as far as "
                    "all curves go; grey: the mean curve over its peak{}.",
                    curves.test, morris ? "Elementary effects (mu* over the largest)" : "Rank correlation", curves.axes.y_title,
                    curves.axes.x_title, s.n, morris ? "" : "; dashed: what chance stays within nineteen times in twenty"),
        curves.axes.x_title,
        morris ? "mu* over the largest" : "rank correlation",
        {},
        {}};
    std::vector<double> x = s.x;
    for (double& v : x) {
        v *= curves.axes.x_factor;
    }
    const double peak =
        std::fabs(*std::max_element(s.mean.begin(), s.mean.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
    report::Curve mean{"mean curve over its peak", x, s.mean, "#b8c0c8"};
    mean.width = 3.5;
    for (double& y : mean.y) {
        y = peak > 0.0 ? y / peak : 0.0;
    }
    plot.curves.push_back(std::move(mean));
    for (const double side : {1.0, -1.0}) {
        if (!morris) {
            const double bound = side * significant_correlation(s.n);
            report::Curve edge{"", {x.front(), x.back()}, {bound, bound}, "#9aa5b1", report::CurveStyle::dashed};
            edge.width = 0.9;
            plot.curves.push_back(std::move(edge));
        }
    }
    for (std::size_t k = 0; k < std::min(s.s.size(), most_lines); ++k) {
        report::Curve line{sweep.space[k].name, {}, {}};
        tell_apart(line, k);
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (std::isfinite(s.s[k][i])) {
                line.x.push_back(x[i]);
                line.y.push_back(s.s[k][i]);
            }
        }
        plot.curves.push_back(std::move(line));
    }
    return plot;
}

report::Plot influence_plot(const Sweep& sweep, const SweepOutcome& o, const std::string& test, const std::vector<std::size_t>& columns) {
    report::Plot plot{fmt::format("{}: influence of the parameters on its main results.", test),
                      sweep.trajectories() ? "mu* over the largest of the result" : "rank correlation",
                      "",
                      {},
                      {}};
    const auto order = by_influence(o.sensitivities[columns.front()]);
    for (const auto k : order) {
        plot.rows.push_back(sweep.space[k].name);
    }
    const auto m = static_cast<double>(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        for (std::size_t r = 0; r < order.size(); ++r) {
            const double value = o.sensitivities[columns[j]][order[r]].value;
            const double y = -1.0 - static_cast<double>(r) + 0.7 * (0.5 - (static_cast<double>(j) + 0.5) / m);
            report::Curve bar{r == 0 ? o.table.results[columns[j]].result : "", {0.0, std::isfinite(value) ? value : 0.0}, {y, y}};
            tell_apart(bar, j);
            bar.width = 22.0 / m;
            plot.curves.push_back(std::move(bar));
        }
    }
    return plot;
}

report::Plot scatter_plot(const Sweep& sweep, const SweepOutcome& o, std::size_t c) {
    const std::size_t k = by_influence(o.sensitivities[c]).front();
    const auto& column = o.table.results[c];
    const auto values = own_values(sweep, k);
    const Shown x = shown(sweep, k);
    const Shown y(column.result, column.unit, column.mean);
    report::Plot plot{fmt::format("{} over {}, {}.", column.name(), label(sweep.space[k]),
                                  beyond_chance(o.sensitivities[c][k]) ? "the parameter that matters most for it"
                                                                       : "of which it shows no influence beyond chance"),
                      x.heading(label(sweep.space[k])),
                      y.heading(column.name()),
                      {},
                      {}};
    plot.x_from_zero = false;
    report::Curve dots{"", {}, {}};
    dots.style = report::CurveStyle::points;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(column.mean[i])) {
            dots.x.push_back(values[i] * x.factor);
            dots.y.push_back(column.mean[i] * y.factor);
        }
    }
    plot.curves.push_back(std::move(dots));
    return plot;
}

} // namespace proveta
