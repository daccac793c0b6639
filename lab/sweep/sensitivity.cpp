#include "lab/sweep/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lab/derived.hpp"
#include "lab/series/statistics.hpp"

namespace proveta {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// The parameter that alone changes between two points of a trajectory; empty from one trajectory to the next.
std::optional<std::size_t> changed(const Point& a, const Point& b) {
    std::optional<std::size_t> out;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (a[k] != b[k]) {
            if (out) {
                return std::nullopt;
            }
            out = k;
        }
    }
    return out;
}

std::vector<double> coordinates(const std::vector<Point>& points, std::size_t k) {
    std::vector<double> out;
    for (const auto& point : points) {
        out.push_back(point[k]);
    }
    return out;
}

} // namespace

std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> out(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) {
            ++last;
        }
        for (std::size_t k = first; k <= last; ++k) {
            out[order[k]] = 0.5 * static_cast<double>(first + last) + 1.0;
        }
        first = last + 1;
    }
    return out;
}

std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> a;
    std::vector<double> b;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (std::isfinite(x[k]) && std::isfinite(y[k])) {
            a.push_back(x[k]);
            b.push_back(y[k]);
        }
    }
    if (a.size() < 3) {
        return std::nullopt;
    }
    a = ranks(a);
    b = ranks(b);
    const double middle = 0.5 * (static_cast<double>(a.size()) + 1.0); // mean of any ranks
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ab += (a[k] - middle) * (b[k] - middle);
        aa += (a[k] - middle) * (a[k] - middle);
        bb += (b[k] - middle) * (b[k] - middle);
    }
    return aa > 0.0 && bb > 0.0 ? std::optional(std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0)) : std::nullopt;
}

double significant_correlation(std::size_t n) {
    if (n < 4) {
        return 1.0;
    }
    const double t = student_t95(n - 2);
    return t / std::sqrt(static_cast<double>(n - 2) + t * t);
}

std::vector<Effects> elementary_effects(const std::vector<Point>& points, const std::vector<double>& y) {
    const std::size_t parameters = points.empty() ? 0 : points.front().size();
    std::vector<std::vector<double>> effects(parameters);
    // The first points of trajectories come at every (parameters + 1)-th place.
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const auto k = (i + 1) % (parameters + 1) == 0 ? std::nullopt : changed(points[i], points[i + 1]);
        if (k && std::isfinite(y[i]) && std::isfinite(y[i + 1])) {
            effects[*k].push_back((y[i + 1] - y[i]) / (points[i + 1][*k] - points[i][*k]));
        }
    }
    std::vector<Effects> out;
    for (auto& of_parameter : effects) {
        const Sample all = sample_of(of_parameter);
        for (double& e : of_parameter) {
            e = std::fabs(e);
        }
        out.push_back({all.n, all.mean, sample_of(of_parameter).mean, all.spread ? all.spread->deviation : unknown});
    }
    return out;
}

std::optional<CurveSensitivity> curve_sensitivity(const std::vector<Point>& points, const std::vector<SampledCurve>& curves,
                                                  bool trajectories, std::size_t samples) {
    CurveSensitivity out;
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
    for (const auto& c : curves) {
        if (!c.x.empty()) {
            first = std::max(first, *std::min_element(c.x.begin(), c.x.end()));
            last = std::min(last, *std::max_element(c.x.begin(), c.x.end()));
            ++out.n;
        }
    }
    if (out.n < 3 || !(last > first)) {
        return std::nullopt;
    }
    const std::size_t parameters = points.front().size();
    out.s.resize(parameters);
    double largest = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double x = i + 1 == samples ? last : first + (last - first) * static_cast<double>(i) / static_cast<double>(samples - 1);
        std::vector<double> y;
        std::vector<double> found;
        for (const auto& c : curves) {
            y.push_back(c.x.empty() ? unknown : y_at(c.x, c.y, x).value_or(unknown));
            if (std::isfinite(y.back())) {
                found.push_back(y.back());
            }
        }
        out.x.push_back(x);
        out.mean.push_back(sample_of(found).mean);
        const auto effects = trajectories ? elementary_effects(points, y) : std::vector<Effects>(parameters);
        for (std::size_t k = 0; k < parameters; ++k) {
            const double s = !trajectories       ? rank_correlation(coordinates(points, k), y).value_or(unknown)
                             : effects[k].n == 0 ? unknown
                                                 : effects[k].mu_star;
            out.s[k].push_back(s);
            largest = std::max(largest, std::isfinite(s) ? s : 0.0);
        }
    }
    for (auto& of_parameter : out.s) {
        for (double& s : of_parameter) {
            s = trajectories && largest > 0.0 ? s / largest : s;
        }
    }
    return out;
}

} // namespace proveta
