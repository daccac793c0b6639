#include "reports/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace proveta::report {

namespace {

constexpr std::size_t most_told = 10; // curves: who hears them one after the other keeps no more apart

// Where a curve begins, ends and is farthest from zero.
std::string course(const Curve& c) {
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (std::isfinite(c.x[k]) && std::isfinite(c.y[k])) {
            known.push_back(k);
        }
    }
    const std::string name = c.name.empty() ? "" : c.name + ": ";
    if (known.empty()) {
        return name + "no points.";
    }
    const std::size_t top =
        *std::max_element(known.begin(), known.end(), [&](auto a, auto b) { return std::fabs(c.y[a]) < std::fabs(c.y[b]); });
    const auto at = [&](std::size_t k) { return fmt::format("{:.4g} at {:.4g}", c.y[k], c.x[k]); };
    if (known.size() == 1) {
        return name + at(top) + ".";
    }
    const bool line = c.style == CurveStyle::solid || c.style == CurveStyle::dashed;
    return line ? fmt::format("{}from {} to {}, farthest from zero {}.", name, at(known.front()), at(known.back()), at(top))
                : fmt::format("{}{} {}, the largest {}.", name, known.size(), c.style == CurveStyle::bars ? "bars" : "points", at(top));
}

} // namespace

std::string describe(const Plot& plot) {
    std::string out = plot.rows.empty() ? fmt::format("{} (first figure) over {} (second).", plot.y_title, plot.x_title)
                                        : fmt::format("{} of {}.", plot.x_title, fmt::join(plot.rows, ", "));
    if (!plot.rows.empty()) { // each bar is a curve from 0 to its value
        for (const auto& c : plot.curves) {
            if (!c.x.empty() && std::isfinite(c.y.back()) && c.y.back() < 0.0) {
                const auto row = std::min(plot.rows.size(), static_cast<std::size_t>(std::lround(std::max(1.0, -c.y.back())))) - 1;
                out += fmt::format(" {}: {:.3g}.", plot.rows[row], c.x.back());
            }
        }
        return out;
    }
    for (std::size_t k = 0; k < std::min(plot.curves.size(), most_told); ++k) {
        out += " " + course(plot.curves[k]);
    }
    if (plot.curves.size() > most_told) {
        out += fmt::format(" And {} more curves.", plot.curves.size() - most_told);
    }
    return out;
}

std::string describe(const Rose& rose) {
    std::string out = rose.about;
    for (const auto& part : rose.parts) {
        const double total = std::accumulate(part.weight.begin(), part.weight.end(), 0.0);
        if (part.weight.empty() || total <= 0.0) {
            continue;
        }
        const auto most = std::max_element(part.weight.begin(), part.weight.end());
        const double wide = rose.turn / static_cast<double>(part.weight.size());
        const auto from = static_cast<double>(most - part.weight.begin()) * wide;
        out += fmt::format(" {}: most between {:.3g} and {:.3g} degrees, {:.3g} % of it.", part.name, from, from + wide,
                           100.0 * *most / total);
    }
    return out;
}

std::string describe(const Picture& p) {
    return fmt::format("{} {:.4g} mm wide and {:.4g} mm high.", p.caption, 1e3 * p.width, 1e3 * p.height);
}

} // namespace proveta::report
