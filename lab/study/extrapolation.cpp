#include "lab/study/extrapolation.hpp"

#include <cmath>
#include <set>

#include "lab/series/statistics.hpp"

namespace proveta {

namespace {

struct Fit {
    Extrapolation line;
    double squares; // of what the line leaves
};

Fit fit_power(const std::vector<double>& x, const std::vector<double>& y, double power) {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        mean_x += std::pow(x[k], power) / n;
        mean_y += y[k] / n;
    }
    double xx = 0.0;
    double xy = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double dx = std::pow(x[k], power) - mean_x;
        xx += dx * dx;
        xy += dx * (y[k] - mean_y);
    }
    Fit out{{0.0, xy / xx, power, std::nullopt}, 0.0};
    out.line.limit = mean_y - out.line.slope * mean_x;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double left = y[k] - out.line.limit - out.line.slope * std::pow(x[k], power);
        out.squares += left * left;
    }
    if (x.size() > 2) {
        const double variance = out.squares / (n - 2.0);
        out.line.half_width = student_t95(x.size() - 2) * std::sqrt(variance * (1.0 / n + mean_x * mean_x / xx));
    }
    return out;
}

} // namespace

std::optional<Extrapolation> extrapolate(const std::vector<double>& x, const std::vector<double>& y) {
    const std::set<double> different(x.begin(), x.end());
    if (different.size() < 2) {
        return std::nullopt;
    }
    Fit best = fit_power(x, y, 1.0);
    if (different.size() >= 4) {
        for (const double power : {0.5, 2.0}) {
            const Fit other = fit_power(x, y, power);
            if (other.squares < best.squares) {
                best = other;
            }
        }
    }
    return best.line;
}

} // namespace proveta
