#include "lab/derived.hpp"

#include <algorithm>

namespace proveta {

std::optional<Line> fit(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last) {
    if (last >= x.size() || first >= last) {
        return std::nullopt;
    }
    const auto n = static_cast<double>(last - first + 1);
    double mx = 0.0;
    double my = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
        mx += x[k] / n;
        my += y[k] / n;
    }
    double xx = 0.0;
    double xy = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
        xx += (x[k] - mx) * (x[k] - mx);
        xy += (x[k] - mx) * (y[k] - my);
    }
    if (xx <= 0.0) {
        return std::nullopt;
    }
    return Line{xy / xx, my - xy / xx * mx};
}

std::size_t peak_index(const std::vector<double>& y) {
    return y.empty() ? 0 : static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
}

std::optional<std::size_t> first_reaching(const std::vector<double>& y, double level, std::size_t last) {
    for (std::size_t k = 0; k <= last && k < y.size(); ++k) {
        if (y[k] >= level) {
            return k;
        }
    }
    return std::nullopt;
}

std::optional<double> slope_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share) {
    if (y.empty()) {
        return std::nullopt;
    }
    const std::size_t peak = peak_index(y);
    const auto first = first_reaching(y, from_share * y[peak], peak);
    const auto last = first_reaching(y, to_share * y[peak], peak);
    if (!first || !last) {
        return std::nullopt;
    }
    const auto line = fit(x, y, *first, *last);
    return line ? std::optional(line->slope) : std::nullopt;
}

std::optional<double> x_at_share(const std::vector<double>& x, const std::vector<double>& y, double share) {
    if (y.empty()) {
        return std::nullopt;
    }
    const std::size_t peak = peak_index(y);
    const double level = share * y[peak];
    const auto k = first_reaching(y, level, peak);
    if (!k || *k == 0) {
        return std::nullopt;
    }
    const double t = (level - y[*k - 1]) / (y[*k] - y[*k - 1]);
    return x[*k - 1] + t * (x[*k] - x[*k - 1]);
}

} // namespace proveta
