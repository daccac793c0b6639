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

std::optional<Line> line_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share) {
    if (y.empty()) {
        return std::nullopt;
    }
    const std::size_t peak = peak_index(y);
    const auto first = first_reaching(y, from_share * y[peak], peak);
    const auto last = first_reaching(y, to_share * y[peak], peak);
    return first && last ? fit(x, y, *first, *last) : std::nullopt;
}

std::optional<double> slope_between(const std::vector<double>& x, const std::vector<double>& y, double from_share, double to_share) {
    const auto line = line_between(x, y, from_share, to_share);
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

std::optional<double> y_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto k = x.empty() ? std::nullopt : first_reaching(x, at, x.size() - 1);
    if (!k) {
        return std::nullopt;
    }
    if (*k == 0) {
        return y.front();
    }
    return y[*k - 1] + (y[*k] - y[*k - 1]) * (at - x[*k - 1]) / (x[*k] - x[*k - 1]);
}

std::optional<double> offset_yield(const std::vector<double>& x, const std::vector<double>& y, const Line& line, double offset) {
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (y[k] > 0.0 && y[k] < line.slope * (x[k] - offset) + line.intercept) {
            return y[k];
        }
    }
    return std::nullopt;
}

Loading loading_of(const report::Table& curve, double sense) {
    Loading out;
    const std::size_t phase = curve.column("phase");
    std::optional<std::size_t> before; // last row of what prepared the loading
    const auto add = [&](std::vector<double>& to, const char* name, std::size_t row, bool from_start) {
        const std::size_t c = curve.column(name);
        to.push_back(sense * (curve.rows[row][c] - (from_start && before ? curve.rows[*before][c] : 0.0)));
    };
    for (std::size_t k = 0; k < curve.rows.size(); ++k) {
        if (curve.rows[k][phase] == phase_preparing) {
            before = k;
        } else if (curve.rows[k][phase] == phase_loading) {
            out.row.push_back(k);
            add(out.strain, "axial_strain", k, true);
            add(out.gauge, "gauge_axial_strain", k, true);
            add(out.girth, "circumferential_strain", k, true);
            add(out.volume, "volumetric_strain", k, true);
            add(out.stress, "axial_stress", k, false);
            add(out.deviator, "deviatoric_stress", k, false);
        }
    }
    return out;
}

Loading first_samples(const Loading& loading, std::size_t n) {
    Loading out = loading;
    out.row.resize(std::min(n, out.row.size()));
    for (auto* of : {&out.strain, &out.gauge, &out.girth, &out.volume, &out.stress, &out.deviator}) {
        of->resize(std::min(n, of->size()));
    }
    return out;
}

} // namespace proveta
