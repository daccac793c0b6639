// Results and plots of a strength envelope.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/series/strength_envelope.hpp"

namespace proveta {

namespace {

constexpr double mega = 1e6;
constexpr double degree = std::numbers::pi / 180.0;
constexpr int pieces = 90; // of a drawn curve
constexpr const char* line_colour = "#c0392b";
constexpr const char* curve_colour = "#1e7b46";

double largest_pressure(const std::vector<StrengthPoint>& points) {
    double most = 0.0;
    for (const auto& p : points) {
        most = std::max(most, p.sigma_3);
    }
    return most;
}

// Envelope of the circles of sigma_1(sigma_3) with slope d sigma_1 / d sigma_3 (G. Balmer, Proc. ASTM 52 (1952) 1260).
void add_by_balmer(report::Curve& c, double sigma_3, double deviator, double slope) {
    c.x.push_back((sigma_3 + deviator / (1.0 + slope)) / mega);
    c.y.push_back(deviator * std::sqrt(slope) / (1.0 + slope) / mega);
}

// From no normal stress (tension is not the line's business) to a little past where it touches the largest circle.
report::Curve envelope_of(const StrengthLine& line, double largest) {
    report::Curve c{"Mohr-Coulomb", {}, {}, line_colour};
    c.x.push_back(0.0);
    c.y.push_back(line.cohesion() / mega);
    add_by_balmer(c, 1.1 * largest, line.sigma_1(1.1 * largest) - 1.1 * largest, line.slope);
    return c;
}

// From the apex, where the deviator is zero, on. Steps in the deviator: the envelope leaves the apex upright.
report::Curve envelope_of(const HoekBrown& law, double largest) {
    report::Curve c{"Hoek-Brown", {}, {}, curve_colour};
    const double b = law.m_i * law.sigma_ci;
    const double highest = law.sigma_1(1.1 * largest) - 1.1 * largest;
    c.x.push_back(-law.sigma_ci / law.m_i / mega);
    c.y.push_back(0.0);
    for (int k = 1; k <= pieces; ++k) {
        const double deviator = highest * k / pieces;
        add_by_balmer(c, (deviator * deviator - law.sigma_ci * law.sigma_ci) / b, deviator, 1.0 + 0.5 * b / deviator);
    }
    return c;
}

template <class Strength>
report::Curve strength_curve(const std::string& name, const char* colour, report::CurveStyle style, double from, double to,
                             const Strength& sigma_1) {
    report::Curve c{name, {}, {}, colour, style};
    for (int k = 0; k <= pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        const double sigma_3 = from + (to - from) * t * t; // closer where the curves bend most
        c.x.push_back(sigma_3 / mega);
        c.y.push_back(sigma_1(sigma_3) / mega);
    }
    return c;
}

} // namespace

report::Curve mohr_circle(const StrengthPoint& p) {
    report::Curve c{"", {}, {}, "#8593a1", report::CurveStyle::solid, 1.2};
    const double centre = 0.5 * (p.sigma_1 + p.sigma_3) / mega;
    const double radius = 0.5 * std::fabs(p.sigma_1 - p.sigma_3) / mega;
    for (int k = 0; k <= pieces; ++k) {
        const double angle = std::numbers::pi * k / pieces;
        c.x.push_back(centre - radius * std::cos(angle));
        c.y.push_back(radius * std::sin(angle));
    }
    return c;
}

std::vector<report::Scalar> envelope_results(const StrengthEnvelope& e) {
    const auto& mc = e.mohr_coulomb;
    const auto& hb = e.hoek_brown;
    const auto of_line = [&](const std::string& formula) { return mc ? formula : "not found: " + mc.reason; };
    const auto of_curve = [&](const std::string& formula) { return hb ? formula : "not found: " + hb.reason; };
    const auto in_degrees = [](std::optional<double> angle) { return angle ? std::optional(*angle / degree) : std::nullopt; };
    std::optional<double> none;
    return {{"cohesion", "Cohesion", mc ? std::optional(mc->line.cohesion()) : none, "Pa",
             of_line("c = P / (2 sqrt K), line sigma_1 = P + K sigma_3 through the peaks by least squares")},
            {"cohesion_error", "Its standard error", mc ? mc->cohesion_error : none, "Pa",
             of_line("from the scatter about the line; needs three tests")},
            {"friction_angle", "Friction angle", in_degrees(mc ? std::optional(mc->line.friction_angle()) : none), "deg",
             of_line("phi = 2 atan(sqrt K) - 90 deg")},
            {"friction_angle_error", "Its standard error", in_degrees(mc ? mc->friction_angle_error : none), "deg",
             of_line("from the scatter about the line; needs three tests")},
            {"mohr_coulomb_r2", "Mohr-Coulomb: r\u00b2", mc ? std::optional(mc->r2) : none, "",
             of_line("1 - squared residuals of sigma_1 over its squared deviations from the mean")},
            {"sigma_ci", "Hoek-Brown: sigma_ci", hb ? std::optional(hb->sigma_ci) : none, "Pa",
             of_curve("sigma_1 = sigma_3 + sigma_ci sqrt(m_i sigma_3 / sigma_ci + 1) by least squares")},
            {"m_i", "Hoek-Brown: m_i", hb ? std::optional(hb->m_i) : none, "", of_curve("the same fit")},
            {"hoek_brown_tensile_strength", "Hoek-Brown: tensile strength", hb ? std::optional(hb->tensile_strength()) : none, "Pa",
             of_curve("sigma_ci (sqrt(m_i^2 + 4) - m_i) / 2, where the fit has sigma_1 = 0; extrapolated unless tension was tested")},
            {"hoek_brown_r2", "Hoek-Brown: r\u00b2", hb ? std::optional(hb->r2) : none, "",
             of_curve("1 - squared residuals of sigma_1 over its squared deviations from the mean")}};
}

report::Plot mohr_plot(const StrengthEnvelope& e) {
    report::Plot plot{"Mohr circles at peak stress.", "normal stress [MPa]", "shear stress [MPa]", {}, {}, true};
    for (const auto& p : e.points) {
        plot.curves.push_back(mohr_circle(p));
    }
    if (!plot.curves.empty()) {
        plot.curves.front().name = "circles at peak";
    }
    const double largest = largest_pressure(e.points);
    if (e.mohr_coulomb) {
        const StrengthLine& line = e.mohr_coulomb->line;
        plot.curves.push_back(envelope_of(line, largest));
        plot.title +=
            fmt::format(" Mohr-Coulomb: c = {:.3g} MPa, \u03c6 = {:.3g}\u00b0.", line.cohesion() / mega, line.friction_angle() / degree);
    }
    if (e.hoek_brown) {
        plot.curves.push_back(envelope_of(*e.hoek_brown, largest));
        plot.title += fmt::format(" Hoek-Brown: sigma_ci = {:.3g} MPa, m_i = {:.3g}.", e.hoek_brown->sigma_ci / mega, e.hoek_brown->m_i);
    }
    return plot;
}

report::Plot strength_plot(const StrengthEnvelope& e) {
    using report::CurveStyle;
    report::Plot plot{
        "Peak total axial stress over confining pressure.", "confining pressure [MPa]", "peak total axial stress [MPa]", {}, {}};
    const double largest = largest_pressure(e.points);
    double lowest = 0.0;
    for (const auto& p : e.points) {
        lowest = std::min(lowest, p.sigma_3);
    }
    if (e.mohr_coulomb) {
        plot.curves.push_back(strength_curve("Mohr-Coulomb", line_colour, CurveStyle::solid, 0.0, largest,
                                             [&](double s) { return e.mohr_coulomb->line.sigma_1(s); }));
    }
    if (e.hoek_brown) {
        const double from = lowest < 0.0 ? -e.hoek_brown->tensile_strength() : 0.0;
        plot.curves.push_back(strength_curve("Hoek-Brown", curve_colour, CurveStyle::solid, from, largest,
                                             [&](double s) { return e.hoek_brown->sigma_1(s); }));
    }
    if (e.thesis) {
        plot.curves.push_back(strength_curve("(5.22) from the card (estimate)", "#7d3c98", CurveStyle::dashed, 0.0, largest,
                                             [&](double s) { return e.thesis->sigma_1(s); }));
    }
    if (e.fc) {
        plot.curves.push_back(strength_curve("Attard and Setunge (estimate)", "#b9770e", CurveStyle::dashed, 0.0, largest,
                                             [&](double s) { return attard_setunge(*e.fc, s); }));
    }
    report::Curve points{"tests", {}, {}, "#1f4e79", CurveStyle::points};
    for (const auto& p : e.points) {
        points.x.push_back(p.sigma_3 / mega);
        points.y.push_back(p.sigma_1 / mega);
    }
    plot.curves.push_back(std::move(points));
    return plot;
}

} // namespace proveta
