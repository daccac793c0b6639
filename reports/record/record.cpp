#include "reports/record/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace proveta::report {

std::size_t Table::column(const std::string& name) const {
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].name == name) {
            return k;
        }
    }
    throw std::out_of_range("no column " + name);
}

std::vector<double> Table::values(const std::string& name) const {
    const std::size_t k = column(name);
    std::vector<double> out;
    out.reserve(rows.size());
    for (const auto& row : rows) {
        out.push_back(row[k]);
    }
    return out;
}

namespace {

bool names(const Scalar& s, const char* part) { return s.name.find(part) != std::string::npos; }

// Of the units that results have.
std::string printed(const std::string& unit) {
    std::string out;
    for (std::size_t k = 0; k < unit.size(); ++k) {
        const bool power = k > 0 && unit[k - 1] == 'm';
        out += power && unit[k] == '2' ? "\u00b2" : power && unit[k] == '3' ? "\u00b3" : std::string(1, unit[k]);
    }
    return out == "deg" ? "\u00b0" : out;
}

} // namespace

Scalar readable(Scalar s) {
    if (s.unit == "Pa" && s.value) {
        const bool stiffness = names(s, "modulus") || names(s, "slope");
        const bool giga = std::fabs(*s.value) >= (stiffness ? 1e8 : s.name.empty() ? 1e9 : INFINITY);
        s.value = *s.value / (giga ? 1e9 : 1e6);
        s.unit = giga ? "GPa" : "MPa";
    } else if (s.value && s.unit.empty() &&
               ((names(s, "strain") && !names(s, "ratio")) || s.name.ends_with("_left") || s.name.ends_with("_change"))) {
        s.value = *s.value * 100.0;
        s.unit = "%";
    } else {
        s.unit = printed(s.unit);
    }
    return s;
}

std::string three_digits(double v) {
    if (!std::isfinite(v)) {
        return "";
    }
    if (v == std::floor(v) && std::fabs(v) < 1e9) {
        return fmt::format("{:.0f}", v == 0.0 ? 0.0 : v);
    }
    const auto power = static_cast<int>(std::floor(std::log10(std::fabs(v))));
    if (power < -4 || power > 6) {
        return fmt::format("{:.2e}", v);
    }
    const double unit = std::pow(10.0, power - 2);
    return fmt::format("{:.{}f}", power > 2 ? std::round(v / unit) * unit : v, std::max(0, 2 - power));
}

std::string relative_change(double change) {
    return change > 9.0 ? fmt::format("\u00d7{:.3g}", 1.0 + change)
                        : fmt::format("{:+.{}f} %", 100.0 * change, std::fabs(change) < 0.1 ? 2 : 1);
}

bool has_ratios(const std::string& name) {
    for (const char* part : {"magnitude", "toe", "dilatancy", "_error", "imbalance"}) {
        if (name.find(part) != std::string::npos) {
            return false;
        }
    }
    return true;
}

InUnit::InUnit(const Scalar& scalar, const std::vector<double>& values) {
    Scalar largest = scalar;
    largest.value = 0.0;
    for (const double v : values) {
        largest.value = std::isfinite(v) ? std::max(*largest.value, std::fabs(v)) : *largest.value;
    }
    const Scalar read = readable(largest);
    unit = read.unit;
    factor = *largest.value > 0.0 ? *read.value / *largest.value : 1.0;
}

KeyFigure key_figure(const Scalar& scalar) {
    const Scalar r = readable(scalar);
    if (!r.value) {
        return {r.title, "not determined", "", ""};
    }
    return {r.title, three_digits(*r.value), r.unit, ""};
}

std::vector<KeyFigure> key_figures(const std::vector<Scalar>& results, const std::vector<std::string>& names, std::size_t most) {
    std::vector<KeyFigure> out;
    for (const auto& name : names) {
        const auto at = std::find_if(results.begin(), results.end(), [&](const Scalar& s) { return s.name == name && s.value; });
        if (at != results.end() && out.size() < most) {
            out.push_back(key_figure(*at));
        }
    }
    return out;
}

void tell_apart(Curve& curve, std::size_t k) {
    static constexpr const char* palette[] = {"#1f4e79", "#c0392b", "#1e7b46", "#b9770e", "#7d3c98",
                                              "#0e8a93", "#111111", "#d35f9e", "#7f8c8d", "#6e5a1e"};
    curve.colour = palette[k % std::size(palette)];
    curve.style = k / std::size(palette) % 2 == 0 ? CurveStyle::solid : CurveStyle::dashed;
}

} // namespace proveta::report
