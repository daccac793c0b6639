#include "reports/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace proveta::report {

std::string escape(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        case '\'': out += "&#39;"; break;
        default: out += c;
        }
    }
    return out;
}

namespace {

// An axis with round ticks.
struct Axis {
    double low, high, tick;

    Axis(double from, double to) : low(from), high(to), tick(1.0) {
        if (!(high > low)) {
            high = low + 1.0;
        }
        const double raw = (high - low) / 6.0;
        const double power = std::pow(10.0, std::floor(std::log10(raw)));
        const double lead = raw / power;
        tick = power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
        low = std::floor(low / tick + 1e-9) * tick;
        high = std::ceil(high / tick - 1e-9) * tick;
    }
    [[nodiscard]] double at(double v) const { return (v - low) / (high - low); }
};

// Frame of the curves in the picture.
struct Frame {
    double left, top, right, bottom;
};

// Where the key stands: the first of the four corners that the fewest points of the curves run through. Left end and first baseline.
template <class X, class Y> std::pair<double, double> key_place(const Plot& plot, const X& px, const Y& py, const Frame& f) {
    std::size_t longest = 0;
    std::size_t named = 0;
    for (const auto& c : plot.curves) {
        longest = std::max(longest, c.name.size());
        named += c.name.empty() ? 0 : 1;
    }
    const double wide = 40.0 + 6.6 * static_cast<double>(longest);
    const double high = 17.0 * static_cast<double>(named) + 8.0;
    const Frame corners[] = {{f.left + 6, f.top, f.left + 6 + wide, f.top + high},
                             {f.right - wide, f.top, f.right, f.top + high},
                             {f.right - wide, f.bottom - high, f.right, f.bottom},
                             {f.left + 6, f.bottom - high, f.left + 6 + wide, f.bottom}};
    const Frame* best = corners;
    std::size_t fewest = static_cast<std::size_t>(-1);
    for (const auto& corner : corners) {
        std::size_t inside = 0;
        for (const auto& c : plot.curves) {
            for (std::size_t k = 1; k < c.x.size(); ++k) {
                const int parts = c.style == CurveStyle::points ? 1 : 8;
                for (int part = 0; part < parts; ++part) { // along the line, not only at its ends
                    const double t = part / 8.0;
                    const double x = px(c.x[k - 1] + t * (c.x[k] - c.x[k - 1]));
                    const double y = py(c.y[k - 1] + t * (c.y[k] - c.y[k - 1]));
                    inside += x > corner.left && x < corner.right && y > corner.top && y < corner.bottom ? 1 : 0;
                }
            }
        }
        if (inside < fewest) {
            fewest = inside;
            best = &corner;
        }
    }
    return {best->left + 6, best->top + 14};
}

constexpr const char* dashes = " stroke-dasharray=\"7 4\"";

std::string drawn(const Curve& c, const std::vector<std::pair<double, double>>& at) {
    std::string out;
    if (c.style == CurveStyle::points) {
        for (const auto& [x, y] : at) {
            out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, c.colour);
        }
        return out;
    }
    for (const auto& [x, y] : at) {
        out += fmt::format("{:.2f},{:.2f} ", x, y);
    }
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n", out,
                       c.colour, c.width, c.style == CurveStyle::dashed ? dashes : "");
}

// A line of the key, its sign beginning at x.
std::string key_line(const Curve& c, double x, double y) {
    const std::string sign = c.style == CurveStyle::points
                                 ? fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3.5\" fill=\"{}\"/>", x + 11, y, c.colour)
                                 : fmt::format("<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke=\"{3}\" stroke-width=\"3\"{4}/>",
                                               x, y, x + 22, c.colour, c.style == CurveStyle::dashed ? dashes : "");
    return sign + fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#111\">{}</text>\n", x + 28, y + 4, escape(c.name));
}

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

std::string to_svg(const Plot& plot) {
    constexpr double width = 640;
    double height = plot.rows.empty() ? 380 : 110 + 36 * static_cast<double>(plot.rows.size());
    double left = 66;
    for (const auto& row : plot.rows) {
        left = std::max(left, 24 + 6.6 * static_cast<double>(row.size()));
    }
    Frame frame{left, 14, width - 16, height - 48};
    constexpr double none = std::numeric_limits<double>::infinity();
    double x0 = plot.x_from_zero ? 0.0 : none;
    double x1 = plot.x_from_zero ? 0.0 : -none;
    double y0 = 0.0;
    double y1 = 0.0;
    for (const auto& c : plot.curves) {
        for (std::size_t k = 0; k < c.x.size(); ++k) {
            x0 = std::min(x0, c.x[k]);
            x1 = std::max(x1, c.x[k]);
            y0 = std::min(y0, c.y[k]);
            y1 = std::max(y1, c.y[k]);
        }
    }
    const Axis ax = x0 <= x1 ? Axis(x0, x1) : Axis(0.0, 1.0);
    Axis ay(y0, y1);
    if (!plot.rows.empty()) {
        ay.high = -0.3;
        ay.low = -0.7 - static_cast<double>(plot.rows.size());
    }
    if (plot.equal_scale) {
        // The axis that needs less room gives up the rest of it.
        const double across = (ax.high - ax.low) / (frame.right - frame.left);
        const double up = (ay.high - ay.low) / (frame.bottom - frame.top);
        if (across > up) {
            const double spare = (frame.bottom - frame.top) * (1.0 - up / across);
            frame.bottom -= spare;
            height -= spare;
        } else {
            frame.right = frame.left + (ax.high - ax.low) / up;
        }
    }
    const auto px = [&](double v) { return frame.left + ax.at(v) * (frame.right - frame.left); };
    const auto py = [&](double v) { return frame.bottom - ay.at(v) * (frame.bottom - frame.top); };
    std::string out = fmt::format("<svg viewBox=\"0 0 {} {:.6g}\" role=\"img\" aria-label=\"{}\" xmlns=\"http://www.w3.org/2000/svg\" "
                                  "font-family=\"sans-serif\" font-size=\"12\">\n",
                                  width, height, escape(plot.title));
    for (double v = ax.low; v <= ax.high + 0.5 * ax.tick; v += ax.tick) {
        out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>"
                           "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\" fill=\"#333\">{4:.6g}</text>\n",
                           px(v), py(ay.low), py(ay.high), py(ay.low) + 16, std::fabs(v) < 1e-9 * ax.tick ? 0.0 : v);
    }
    for (std::size_t k = 0; k < plot.rows.size(); ++k) {
        const double y = py(-1.0 - static_cast<double>(k));
        out += fmt::format("<line x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>"
                           "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#333\">{5}</text>\n",
                           y, px(ax.low), px(ax.high), px(ax.low) - 6, y + 4, escape(plot.rows[k]));
    }
    for (double v = ay.low; plot.rows.empty() && v <= ay.high + 0.5 * ay.tick; v += ay.tick) {
        out += fmt::format("<line x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>"
                           "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#333\">{5:.6g}</text>\n",
                           py(v), px(ax.low), px(ax.high), px(ax.low) - 6, py(v) + 4, std::fabs(v) < 1e-9 * ay.tick ? 0.0 : v);
    }
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#111\">{}</text>\n", 0.5 * (frame.left + frame.right),
                       height - 10, escape(plot.x_title));
    out += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\" fill=\"#111\">{}</text>\n",
                       0.5 * (frame.top + frame.bottom), escape(plot.y_title));
    const auto [key_left, key_top] = key_place(plot, px, py, frame);
    double key = key_top;
    for (const auto& c : plot.curves) {
        std::vector<std::pair<double, double>> at;
        for (std::size_t k = 0; k < c.x.size(); ++k) {
            at.emplace_back(px(c.x[k]), py(c.y[k]));
        }
        out += drawn(c, at);
        if (plot.curves.size() > 1 && !c.name.empty()) {
            out += key_line(c, key_left, key);
            key += 17;
        }
    }
    for (const auto& [x, y] : plot.marks) {
        out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"none\" stroke=\"#b03a2e\" stroke-width=\"2\"/>\n", px(x),
                           py(y));
    }
    return out + "</svg>\n";
}

std::string to_svg(const Picture& p) {
    const double scale = 1000.0; // mm
    const double margin = 0.06 * p.width;
    std::string out = fmt::format("<svg viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" role=\"img\" aria-label=\"{}\" "
                                  "xmlns=\"http://www.w3.org/2000/svg\">\n",
                                  -scale * (0.5 * p.width + margin), -scale * (p.height + margin), scale * (p.width + 2 * margin),
                                  scale * (p.height + 2 * margin), escape(p.title + ". " + p.caption));
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
