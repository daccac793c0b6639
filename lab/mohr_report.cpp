#include "lab/mohr_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.hpp"
#include "lab/derived.hpp"
#include "lab/series/strength_envelope.hpp"

namespace proveta {

std::optional<report::Plot> circles_of_test(const report::Table& curve, bool loose) {
    if (curve.rows.empty()) {
        return std::nullopt;
    }
    const auto axial = curve.values("axial_stress");
    const auto lateral = curve.values("lateral_stress");
    std::vector<double> deviator;
    for (std::size_t k = 0; k < axial.size(); ++k) {
        deviator.push_back(axial[k] - lateral[k]);
    }
    const std::size_t peak = peak_index(deviator);
    const double most = deviator[peak];
    const double largest = std::fabs(axial[peak]);
    if (!(most > 0.02 * largest) || !(std::fabs(lateral[peak]) > 1e-3 * largest)) {
        return std::nullopt;
    }
    report::Plot plot{"Mohr circles of stress in the course of the test.", "normal stress [MPa]", "shear stress [MPa]", {}, {}, true};
    const auto add = [&](const std::string& name, std::size_t k, const char* colour, report::CurveStyle style) {
        auto circle = mohr_circle({lateral[k], axial[k]});
        circle.name = fmt::format("{}: {:.3g} and {:.3g} MPa", name, 1e-6 * axial[k], 1e-6 * lateral[k]);
        circle.colour = colour;
        circle.style = style;
        plot.curves.push_back(std::move(circle));
    };
    const auto half = static_cast<std::size_t>(std::find_if(deviator.begin(), deviator.end(), [&](double d) { return d >= 0.5 * most; }) -
                                               deviator.begin());
    add("half the largest deviator", half, "#7f8c8d", report::CurveStyle::solid);
    add("largest deviator", peak, "#1f4e79", report::CurveStyle::solid);
    plot.curves.back().width = 2.4;
    if (deviator.back() < 0.98 * most && deviator.back() > 0.0) {
        add("end of the test", deviator.size() - 1, "#b9770e", report::CurveStyle::dashed);
    }
    if (loose) {
        const double sine = most / (axial[peak] + lateral[peak]);
        const double phi = std::asin(std::clamp(sine, -1.0, 1.0));
        const double reach = 1e-6 * axial[peak];
        plot.curves.push_back(
            {fmt::format("\u03c6 = {:.3g}\u00b0, no cohesion", phi * degrees), {0.0, reach}, {0.0, reach * std::tan(phi)}, "#c0392b"});
    }
    return plot;
}

} // namespace proveta
