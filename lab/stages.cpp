#include "lab/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace proveta {

double smooth_start(double time, double ramp) {
    return time >= ramp ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * std::max(time, 0.0) / ramp));
}

void declare(input::Visitor& v, StopRules& r) {
    v.number("axial_strain", r.axial_strain, input::Unit::none, {0.0, 0.5, true, false}, "nominal axial strain at which the test ends");
    v.number("post_peak_drop", r.post_peak_drop, input::Unit::none, {0.0, 1.0, true, false},
             "share of the peak stress whose loss ends the test; 1: never");
}

std::optional<std::string> stopped_by(const StopRules& rules, const report::Table& curve) {
    if (curve.rows.empty()) {
        return std::nullopt;
    }
    const auto strain = curve.rows.back()[curve.column("axial_strain")];
    if (strain >= rules.axial_strain) {
        return fmt::format("axial strain of {:.4g} reached", rules.axial_strain);
    }
    const std::size_t stress = curve.column("axial_stress");
    const auto higher = [&](const auto& a, const auto& b) { return a[stress] < b[stress]; };
    const auto peak = std::max_element(curve.rows.begin(), curve.rows.end(), higher);
    const bool stands_out = curve.rows.end() - peak > 5 && curve.rows.back()[curve.column("broken_bonds")] > 0.0;
    if (stands_out && curve.rows.back()[stress] < (1.0 - rules.post_peak_drop) * (*peak)[stress]) {
        return fmt::format("stress fell by {:.0f} % from its peak", 100.0 * rules.post_peak_drop);
    }
    return std::nullopt;
}

void declare_friction(input::Visitor& v, input::NumberOrWord& friction) {
    v.number_or_word("platen_friction", friction, {{"lubricated", "no friction"}, {"glued", "no lateral slip"}}, input::Unit::none,
                     input::between(0, 10), "Coulomb friction between specimen and platens");
}

double friction_value(const input::NumberOrWord& friction) {
    if (friction.word == "glued") {
        return glued;
    }
    return friction.word == "lubricated" ? 0.0 : friction.number;
}

} // namespace proveta
