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

Scalar readable(Scalar s) {
    if (s.unit == "Pa" && s.value) {
        const bool giga = std::fabs(*s.value) >= 1e9;
        s.value = *s.value / (giga ? 1e9 : 1e6);
        s.unit = giga ? "GPa" : "MPa";
    } else if (s.value && s.name.find("strain") != std::string::npos) {
        s.value = *s.value * 100.0;
        s.unit = "%";
    }
    return s;
}

KeyFigure key_figure(const Scalar& scalar) {
    const Scalar r = readable(scalar);
    if (!r.value) {
        return {r.title, "not determined", "", ""};
    }
    const bool count = r.unit.empty() && std::fabs(*r.value) < 1e9 && *r.value == std::floor(*r.value); // all its digits, then
    return {r.title, fmt::format("{:.{}g}", *r.value, count ? 9 : 3), r.unit, ""};
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
