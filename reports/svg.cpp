#include "reports/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/axis.hpp"
#include "reports/describe.hpp"

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

using At = std::pair<double, double>;

// Frame of the curves in the picture.
struct Frame {
    double left, top, right, bottom;
};

// Axes and frame: from values to the picture.
struct Chart {
    Axis ax, ay;
    Frame frame;
    double height;

    [[nodiscard]] double px(double v) const { return frame.left + ax.at(v) * (frame.right - frame.left); }
    [[nodiscard]] double py(double v) const { return frame.bottom - ay.at(v) * (frame.bottom - frame.top); }
};

Chart chart_of(const Plot& plot, const PlotLook& look) {
    constexpr double none = std::numeric_limits<double>::infinity();
    double x0 = plot.x_from_zero ? 0.0 : none;
    double x1 = plot.x_from_zero ? 0.0 : -none;
    double y0 = plot.y_from_zero ? 0.0 : none;
    double y1 = plot.y_from_zero ? 0.0 : -none;
    for (const auto& c : plot.curves) {
        for (std::size_t k = 0; k < c.x.size(); ++k) {
            if (std::isfinite(c.x[k]) && std::isfinite(c.y[k])) {
                x0 = std::min(x0, c.x[k]);
                x1 = std::max(x1, c.x[k]);
                y0 = std::min(y0, c.y[k]);
                y1 = std::max(y1, c.y[k]);
            }
        }
    }
    const double wide = look.letters * 0.55; // of a letter, about
    const double rows = static_cast<double>(plot.rows.size());
    Chart out{x0 <= x1 ? Axis(x0, x1) : Axis(0.0, 1.0),
              y0 <= y1 ? Axis(y0, y1) : Axis(0.0, 1.0),
              {},
              plot.rows.empty() ? look.height : 110 + 36 * rows};
    double left = 66;
    for (const auto& row : plot.rows) {
        left = std::max(left, 24 + wide * static_cast<double>(row.size()));
    }
    if (!plot.rows.empty()) {
        out.ay.high = -0.3;
        out.ay.low = -0.7 - rows;
    }
    Frame& frame = out.frame;
    frame = {left, 14, look.width - 16, out.height - 24 - 2 * look.letters};
    if (plot.equal_scale) {
        // The axis that needs less room gives up the rest of it.
        const double across = (out.ax.high - out.ax.low) / (frame.right - frame.left);
        const double up = (out.ay.high - out.ay.low) / (frame.bottom - frame.top);
        if (across > up) {
            const double spare = (frame.bottom - frame.top) * (1.0 - up / across);
            frame.bottom -= spare;
            out.height -= spare;
        } else {
            frame.right = frame.left + (out.ax.high - out.ax.low) / up;
        }
    }
    return out;
}

// Where the key stands: the first of the four corners that the fewest points of the curves run through. Left end and first baseline.
At key_place(const Plot& plot, const Chart& chart) {
    const Frame& f = chart.frame;
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
                    const double x = chart.px(c.x[k - 1] + t * (c.x[k] - c.x[k - 1]));
                    const double y = chart.py(c.y[k - 1] + t * (c.y[k] - c.y[k - 1]));
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

// A small sign about (x, y); like the script's of the same number.
std::string marker_at(int marker, double x, double y, const std::string& colour) {
    switch (marker % 6) {
    case 1: return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"{}\"/>", x - 3, y - 3, colour);
    case 2: return fmt::format("<path d=\"M{:.1f} {:.1f}l4 7h-8z\" fill=\"{}\"/>", x, y - 4, colour);
    case 3: return fmt::format("<path d=\"M{:.1f} {:.1f}l4 4-4 4-4-4z\" fill=\"{}\"/>", x, y - 4, colour);
    case 4: return fmt::format("<path d=\"M{:.1f} {:.1f}l6 6m0-6l-6 6\" stroke=\"{}\" stroke-width=\"2\"/>", x - 3, y - 3, colour);
    case 5:
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.6\"/>", x, y,
                           colour);
    default: return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"{}\"/>", x, y, colour);
    }
}

// Markers along a line, a hundred or so apart, those of different curves at different places.
std::string markers_along(const std::vector<At>& at, int marker, const std::string& colour) {
    constexpr double apart = 110.0;
    std::string out;
    double way = apart - 20.0 - 17.0 * marker;
    for (std::size_t k = 1; k < at.size(); ++k) {
        way += std::hypot(at[k].first - at[k - 1].first, at[k].second - at[k - 1].second);
        if (way >= apart) {
            out += marker_at(marker, at[k].first, at[k].second, colour);
            way = 0.0;
        }
    }
    return out;
}

std::string drawn_bars(const Plot& plot, std::size_t which, const Chart& chart) {
    const Curve& c = plot.curves[which];
    double apart = (chart.ax.high - chart.ax.low) / 8.0;
    for (std::size_t k = 1; k < c.x.size(); ++k) {
        apart = std::min(apart, std::fabs(c.x[k] - c.x[k - 1]));
    }
    double number = 0.0;
    double place = 0.0;
    for (std::size_t k = 0; k < plot.curves.size(); ++k) {
        place = k == which ? number : place;
        number += plot.curves[k].style == CurveStyle::bars ? 1.0 : 0.0;
    }
    const double wide = 0.86 * apart / number;
    std::string out;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        const double left = chart.px(c.x[k] - 0.43 * apart + place * wide);
        const double right = chart.px(c.x[k] - 0.43 * apart + (place + 1.0) * wide);
        const double top = chart.py(std::max(0.0, c.y[k]));
        const double bottom = chart.py(std::min(0.0, c.y[k]));
        out += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" fill-opacity=\"{}\" stroke=\"{}\"/>\n", left,
            top, std::max(0.5, right - left), bottom - top, c.colour, place > 0.0 ? "0.2" : "0.85", c.colour);
    }
    return out;
}

std::string drawn(const Plot& plot, std::size_t which, int marker, const Chart& chart) {
    const Curve& c = plot.curves[which];
    if (c.style == CurveStyle::bars) {
        return drawn_bars(plot, which, chart);
    }
    std::vector<At> at;
    std::string points;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (std::isfinite(c.x[k]) && std::isfinite(c.y[k])) {
            at.emplace_back(chart.px(c.x[k]), chart.py(c.y[k]));
            points += fmt::format("{:.2f},{:.2f} ", at.back().first, at.back().second);
        }
    }
    if (c.style == CurveStyle::points) {
        std::string out;
        for (const auto& [x, y] : at) {
            out += marker_at(marker, x, y, c.colour) + "\n";
        }
        return out;
    }
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n", points,
                       c.colour, c.width, c.style == CurveStyle::dashed ? dashes : "") +
           (marker < 0 ? "" : markers_along(at, marker, c.colour));
}

std::string drawn_axes(const Plot& plot, const Chart& chart, const PlotLook& look) {
    const Axis& ax = chart.ax;
    const Axis& ay = chart.ay;
    const Frame& frame = chart.frame;
    std::string out;
    for (double v = ax.low; v <= ax.high + 0.5 * ax.tick; v += ax.tick) {
        out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>"
                           "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\" fill=\"#333\">{4}</text>\n",
                           chart.px(v), frame.bottom, frame.top, frame.bottom + 4 + look.letters, ax.label(v));
    }
    const auto row = [&](double at, const std::string& name) {
        out += fmt::format("<line x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>"
                           "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\" fill=\"#333\">{5}</text>\n",
                           chart.py(at), frame.left, frame.right, frame.left - 6, chart.py(at) + 4, escape(name));
    };
    for (std::size_t k = 0; k < plot.rows.size(); ++k) {
        row(-1.0 - static_cast<double>(k), plot.rows[k]);
    }
    for (double v = ay.low; plot.rows.empty() && v <= ay.high + 0.5 * ay.tick; v += ay.tick) {
        row(v, ay.label(v));
    }
    // The axes themselves, where zero is.
    for (const bool upright : {false, true}) {
        const Axis& other = upright ? ax : ay;
        if (other.low <= 0.0 && other.high >= 0.0) {
            const double at = upright ? chart.px(0.0) : chart.py(0.0);
            out +=
                fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#8a949e\"/>\n",
                            upright ? at : frame.left, upright ? frame.top : at, upright ? at : frame.right, upright ? frame.bottom : at);
        }
    }
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" fill=\"#111\">{}</text>\n", 0.5 * (frame.left + frame.right),
                       chart.height - 10, escape(plot.x_title));
    return out + fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\" fill=\"#111\">{}</text>\n",
                             0.5 * (frame.top + frame.bottom), escape(plot.y_title));
}

} // namespace

PlotRange range_of(const Plot& plot) {
    const Chart chart = chart_of(plot, {});
    return {chart.ax.low, chart.ax.high, chart.ay.low, chart.ay.high};
}

std::vector<int> markers_of(const Plot& plot) {
    constexpr std::size_t most = 12; // more are a bundle, which nobody follows one by one
    std::size_t named[4] = {};
    std::vector<int> out;
    int lines = 0;
    int points = 0;
    for (const auto& c : plot.curves) {
        named[static_cast<std::size_t>(c.style)] += c.name.empty() ? 0 : 1;
    }
    for (const auto& c : plot.curves) {
        const std::size_t alike = named[static_cast<std::size_t>(c.style)];
        const bool line = c.style == CurveStyle::solid || c.style == CurveStyle::dashed;
        const bool marked = line && !c.name.empty() && alike > 1 && alike <= most && plot.rows.empty();
        out.push_back(c.style == CurveStyle::points ? points++ : marked ? lines++ : -1);
    }
    return out;
}

std::string key_sign(const Curve& c, int marker, double x, double y) {
    if (c.style == CurveStyle::bars) {
        return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"10\" fill=\"{}\" fill-opacity=\"{}\" stroke=\"{}\"/>", x + 4,
                           y - 5, c.colour, marker > 0 ? "0.2" : "0.85", c.colour);
    }
    const std::string line = c.style == CurveStyle::points
                                 ? ""
                                 : fmt::format("<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke=\"{3}\" stroke-width=\"3\"{4}/>",
                                               x, y, x + 22, c.colour, c.style == CurveStyle::dashed ? dashes : "");
    return line + (marker < 0 ? "" : marker_at(marker, x + 11, y, c.colour));
}

std::string to_svg(const Plot& plot, const PlotLook& look) {
    const Chart chart = chart_of(plot, look);
    std::string out = fmt::format("<svg viewBox=\"0 0 {} {:.6g}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\" "
                                  "font-family=\"sans-serif\" font-size=\"{}\">\n<title>{}</title><desc>{}</desc>\n",
                                  look.width, chart.height, look.letters, escape(plot.title), escape(describe(plot)));
    out += drawn_axes(plot, chart, look);
    const auto markers = markers_of(plot);
    const auto [key_left, key_top] = look.key ? key_place(plot, chart) : At{};
    double key = key_top;
    for (std::size_t k = 0; k < plot.curves.size(); ++k) {
        const Curve& c = plot.curves[k];
        out += drawn(plot, k, markers[k], chart);
        if (look.key && plot.curves.size() > 1 && !c.name.empty()) {
            out += key_sign(c, markers[k], key_left, key) +
                   fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#111\">{}</text>\n", key_left + 28, key + 4, escape(c.name));
            key += 17;
        }
    }
    for (const auto& [x, y] : plot.marks) {
        out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" fill=\"none\" stroke=\"#b03a2e\" stroke-width=\"2\"/>\n",
                           chart.px(x), chart.py(y));
    }
    return out + "</svg>\n";
}

} // namespace proveta::report
