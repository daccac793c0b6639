#include "lab/series/mean_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lab/series/statistics.hpp"

namespace proveta {

namespace {

// Equal steps no longer than `step` from one end, which is left out, to the other, which is met.
void add_steps(std::vector<double>& grid, double from, double to, double step) {
    const double n = std::max(1.0, std::ceil((to - from) / step * (1.0 - 1e-12)));
    for (double k = 1.0; k < n; k += 1.0) {
        grid.push_back(from + (to - from) * (k / n));
    }
    grid.push_back(to);
}

// Linear interpolation in a curve whose x ascends; x must lie within it. `from` is where the last search ended, for ascending x.
double value_at(const SampledCurve& c, double x, std::size_t& from) {
    while (from + 2 < c.x.size() && c.x[from + 1] < x) {
        ++from;
    }
    const double t = (x - c.x[from]) / (c.x[from + 1] - c.x[from]);
    return (1.0 - t) * c.y[from] + t * c.y[from + 1];
}

report::Curve scaled(std::string name, std::vector<double> x, std::vector<double> y, const PlotAxes& axes) {
    for (double& v : x) {
        v *= axes.x_factor;
    }
    for (double& v : y) {
        v *= axes.y_factor;
    }
    return {std::move(name), std::move(x), std::move(y)};
}

} // namespace

SampledCurve advancing(const SampledCurve& curve) {
    if (curve.x.size() != curve.y.size()) {
        throw std::invalid_argument("a curve with as many y as x");
    }
    SampledCurve out;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]) && (out.x.empty() || curve.x[k] > out.x.back())) {
            out.x.push_back(curve.x[k]);
            out.y.push_back(curve.y[k]);
        }
    }
    return out;
}

Outcome<MeanCurve> mean_curve(const std::vector<SampledCurve>& members, std::size_t intervals) {
    if (members.empty()) {
        return {std::nullopt, "there are no curves"};
    }
    std::vector<SampledCurve> curves;
    double first = -std::numeric_limits<double>::infinity();
    double common = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();
    for (const auto& member : members) {
        curves.push_back(advancing(member));
        const auto& x = curves.back().x;
        if (x.size() < 2) {
            return {std::nullopt, fmt::format("curve {} has fewer than two different x", curves.size())};
        }
        first = std::max(first, x.front());
        common = std::min(common, x.back());
        last = std::max(last, x.back());
    }
    if (!(common > first)) {
        return {std::nullopt, "the curves have no range of x in common"};
    }
    MeanCurve out;
    out.x.push_back(first);
    const double step = (last - first) / static_cast<double>(std::max<std::size_t>(intervals, 1));
    add_steps(out.x, first, common, step);
    out.common = out.x.size() - 1;
    if (last > common) {
        add_steps(out.x, common, last, step);
    }
    std::vector<std::size_t> from(curves.size(), 0);
    std::vector<double> values;
    for (const double x : out.x) {
        values.clear();
        for (std::size_t c = 0; c < curves.size(); ++c) {
            if (x <= curves[c].x.back()) {
                values.push_back(value_at(curves[c], x, from[c]));
            }
        }
        const Sample s = sample_of(values);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        out.curves.push_back(s.n);
        out.mean.push_back(s.mean);
        out.deviation.push_back(s.spread ? s.spread->deviation : unknown);
        out.half_width.push_back(s.spread ? s.spread->half_width : unknown);
    }
    return {std::move(out), ""};
}

report::Table mean_curve_table(const MeanCurve& mean, const report::Column& x, const report::Column& y) {
    report::Table t;
    t.notes = {"Mean of several curves at common " + x.name + ". Where " + x.name +
                   " runs backward (unloading, noise), samples are left out until it has passed its former largest value.",
               "Each row is the mean of those curves that reach it; it jumps where one ends. nan: a single curve has no spread."};
    t.columns = {x,
                 {"curves", "", "number of curves that reach this " + x.name},
                 {"mean_" + y.name, y.unit, "mean: " + y.meaning},
                 {"deviation_" + y.name, y.unit, "standard deviation over the curves, with n - 1"},
                 {"low_" + y.name, y.unit, "lower end of the 95 % confidence interval of the mean (Student t)"},
                 {"high_" + y.name, y.unit, "upper end of the same"}};
    for (std::size_t k = 0; k < mean.x.size(); ++k) {
        t.rows.push_back({mean.x[k], static_cast<double>(mean.curves[k]), mean.mean[k], mean.deviation[k],
                          mean.mean[k] - mean.half_width[k], mean.mean[k] + mean.half_width[k]});
    }
    return t;
}

report::Plot mean_curve_plot(const MeanCurve& mean, const std::vector<SampledCurve>& members, const PlotAxes& axes) {
    report::Plot plot{axes.title, axes.x_title, axes.y_title, {}, {}};
    for (const auto& member : members) {
        report::Curve c = scaled(plot.curves.empty() ? fmt::format("specimens ({})", members.size()) : "", member.x, member.y, axes);
        c.colour = "#a9b4bf";
        c.width = 0.9;
        plot.curves.push_back(std::move(c));
    }
    const auto end = static_cast<std::ptrdiff_t>(mean.common) + 1;
    const std::vector<double> x(mean.x.begin(), mean.x.begin() + end);
    const std::vector<double> middle(mean.mean.begin(), mean.mean.begin() + end);
    plot.curves.push_back(scaled("mean", x, middle, axes));
    plot.curves.back().width = 3.0;
    if (members.size() > 1) {
        for (const double side : {1.0, -1.0}) {
            std::vector<double> edge = middle;
            for (std::size_t k = 0; k < edge.size(); ++k) {
                edge[k] += side * mean.half_width[k];
            }
            report::Curve c = scaled(side > 0.0 ? "95 % confidence of the mean" : "", x, edge, axes);
            c.style = report::CurveStyle::dashed;
            c.width = 1.2;
            plot.curves.push_back(std::move(c));
        }
    }
    return plot;
}

} // namespace proveta
