#include "specimens/grading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "specimens/random.hpp"

namespace proveta {

namespace {

double normal_density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }
double cumulative(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Mean and deviation of a normal variable (m, s) cut to [a, b].
std::pair<double, double> cut_moments(double m, double s, double a, double b) {
    const double al = (a - m) / s;
    const double be = (b - m) / s;
    const double z = cumulative(be) - cumulative(al);
    const double shift = (normal_density(al) - normal_density(be)) / z;
    const double mean = m + s * shift;
    const double variance = s * s * (1.0 + (al * normal_density(al) - be * normal_density(be)) / z - shift * shift);
    return {mean, std::sqrt(std::max(variance, 0.0))};
}

// Quantile of the cut normal by bisection: monotone, so it cannot fail.
double cut_quantile(double p, double m, double s, double a, double b) {
    const double low = cumulative((a - m) / s);
    const double target = low + p * (cumulative((b - m) / s) - low);
    double from = a;
    double to = b;
    for (int k = 0; k < 60; ++k) {
        const double mid = 0.5 * (from + to);
        (cumulative((mid - m) / s) < target ? from : to) = mid;
    }
    return 0.5 * (from + to);
}

} // namespace

void declare(input::Visitor& v, GradingPoint& p) {
    v.number("diameter", p.diameter, input::Unit::length, input::above(0), "sieve opening");
    v.number("passing", p.passing, input::Unit::none, input::between(0, 1), "share of the mass that is finer");
}

bool check_grading(const std::vector<GradingPoint>& curve, const std::string& source, const std::string& path, input::Problems& problems) {
    for (std::size_t k = 0; k < curve.size(); ++k) {
        const bool first = k == 0;
        const bool last = k + 1 == curve.size();
        const auto& p = curve[k];
        const bool ascends = first || (p.diameter > curve[k - 1].diameter && p.passing > curve[k - 1].passing);
        if (!ascends || (first && p.passing != 0.0) || (last && p.passing != 1.0) || curve.size() < 2) {
            problems.push_back({source, fmt::format("{}/{}", path, k), fmt::format("passing {:.4g} at {:.4g} m", p.passing, p.diameter),
                                "at least two points, ascending, from passing 0 to passing 1", ""});
            return false;
        }
    }
    return true;
}

std::vector<SievePoint> sieve_curve(const std::vector<GradingPoint>& curve) {
    std::vector<SievePoint> out;
    out.reserve(curve.size());
    for (const auto& p : curve) {
        out.push_back({p.diameter, p.passing});
    }
    return out;
}

std::vector<double> normal_radii(std::size_t n, double deviation, double lowest, double highest, std::uint64_t seed) {
    if (deviation <= 0.0) {
        return std::vector<double>(n, 1.0);
    }
    // Find the parent distribution whose cut version has mean 1 and the wished deviation.
    double m = 1.0;
    double s = deviation;
    bool found = false;
    for (int k = 0; k < 500 && !found; ++k) {
        const auto [mean, spread] = cut_moments(m, s, lowest, highest);
        found = std::fabs(mean - 1.0) < 1e-10 && std::fabs(spread / deviation - 1.0) < 1e-10;
        m += 0.5 * (1.0 - mean);
        s *= std::sqrt(deviation / spread);
        if (!(s < 1e3) || !std::isfinite(m)) {
            break;
        }
    }
    if (!found) {
        throw std::invalid_argument("the bounds on the radii leave no room for the wished deviation");
    }
    Random random(seed, Stream::radii);
    std::vector<double> radii(n);
    for (std::size_t k = 0; k < n; ++k) {
        radii[k] = cut_quantile((static_cast<double>(k) + 0.5) / static_cast<double>(n), m, s, lowest, highest);
    }
    random.shuffle(radii);
    return radii;
}

std::vector<double> graded_radii(std::size_t n, const std::vector<SievePoint>& curve, std::uint64_t seed) {
    // Number fraction of a piece: its mass over the mass of one sphere, integrated over d^-3 within the piece.
    std::vector<double> number(curve.size(), 0.0);
    for (std::size_t k = 1; k < curve.size(); ++k) {
        const double a = curve[k - 1].diameter;
        const double b = curve[k].diameter;
        const double slope = (curve[k].passing - curve[k - 1].passing) / (b - a);
        number[k] = number[k - 1] + slope * 0.5 * (1.0 / (a * a) - 1.0 / (b * b));
    }
    Random random(seed, Stream::radii);
    std::vector<double> radii(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double target = (static_cast<double>(k) + 0.5) / static_cast<double>(n) * number.back();
        const auto piece = static_cast<std::size_t>(std::upper_bound(number.begin(), number.end() - 1, target) - number.begin());
        const double a = curve[piece - 1].diameter;
        const double b = curve[piece].diameter;
        const double slope = (curve[piece].passing - curve[piece - 1].passing) / (b - a);
        const double inverse_square = 1.0 / (a * a) - 2.0 * (target - number[piece - 1]) / slope;
        radii[k] = 0.5 / std::sqrt(inverse_square);
    }
    random.shuffle(radii);
    return radii;
}

} // namespace proveta
