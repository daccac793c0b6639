// Cuts and views of specimens.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/describe.hpp"
#include "reports/svg.hpp"

namespace proveta::report {

namespace {

// White to blue to dark, readable in print.
std::string shade(double t) {
    t = std::clamp(t, 0.0, 1.0);
    const auto mix = [t](double a, double b) { return static_cast<int>(std::lround(a + (b - a) * t)); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(236, 30), mix(240, 78), mix(244, 121));
}

// Grey to red with the value, darker away from the light.
std::string lit(double value, double light) {
    value = std::clamp(value, 0.0, 1.0);
    const double bright = 0.55 + 0.45 * std::clamp(light, 0.0, 1.0);
    const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(bright * (a + (b - a) * value))); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(222, 196), mix(226, 64), mix(230, 48));
}

} // namespace

std::string to_svg(const Picture& p) {
    const double scale = 1000.0; // mm
    const double margin = 0.06 * p.width;
    std::string out = fmt::format("<svg viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" role=\"img\" "
                                  "xmlns=\"http://www.w3.org/2000/svg\">\n<title>{}</title><desc>{}</desc>\n",
                                  -scale * (0.5 * p.width + margin), -scale * (p.height + margin), scale * (p.width + 2 * margin),
                                  scale * (p.height + 2 * margin), escape(p.title), escape(describe(p)));
    for (const auto& f : p.facets) {
        std::string points;
        for (const auto& [x, z] : f.corner) {
            points += fmt::format("{:.2f},{:.2f} ", scale * x, -scale * z);
        }
        const std::string fill = lit(f.value, f.light);
        out += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\".3\"/>\n", points, fill, fill);
    }
    for (const auto& d : p.dots) {
        out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"#9aa5b1\" stroke-width=\".15\"/>\n",
                           scale * d.x, -scale * d.z, scale * d.radius, shade(d.value));
    }
    for (const auto& l : p.lines) {
        const double w = std::clamp(l.weight, 0.0, 1.0);
        out += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
                           "stroke-opacity=\"{:.2f}\" stroke-linecap=\"round\"/>\n",
                           scale * l.x0, -scale * l.z0, scale * l.x1, -scale * l.z1,
                           l.mode == 0   ? "#333333"
                           : l.mode == 1 ? "#c0392b"
                                         : "#d68910",
                           0.3 + 1.3 * w, 0.25 + 0.75 * w);
    }
    return out + "</svg>\n";
}

} // namespace proveta::report
