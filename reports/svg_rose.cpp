// Directions as sectors about a centre. Areas, not radii, are proportional to the weights, so that what looks twice as much is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "reports/describe.hpp"
#include "reports/svg.hpp"

namespace proveta::report {

namespace {

constexpr double reach = 116.0; // radius of the rose in the picture
constexpr double degree = std::numbers::pi / 180.0;

struct Point {
    double x, y;
};

// At an angle from upwards, clockwise, in degrees.
Point at(double angle, double radius) { return {radius * std::sin(angle * degree), -radius * std::cos(angle * degree)}; }

// Piece of a ring between two radii.
std::string sector(double from, double to, double inner, double outer, const std::string& colour, bool faint) {
    const Point a = at(from, outer);
    const Point b = at(to, outer);
    const Point c = at(to, inner);
    const Point d = at(from, inner);
    return fmt::format(
        "<path d=\"M{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 1 {:.2f} {:.2f}L{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 0 {:.2f} {:.2f}Z\" fill=\"{}\" "
        "fill-opacity=\"{}\" stroke=\"{}\" stroke-width=\"1\"/>\n",
        a.x, a.y, outer, outer, b.x, b.y, c.x, c.y, inner, inner, d.x, d.y, colour, faint ? "0.3" : "0.85", colour);
}

std::string text(Point p, const char* anchor, const std::string& what) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"#333\">{}</text>\n", p.x, p.y, anchor, escape(what));
}

std::vector<double> sums_of(const Rose& rose, std::size_t sectors) {
    std::vector<double> out(sectors, 0.0);
    for (const auto& part : rose.parts) {
        for (std::size_t k = 0; k < std::min(sectors, part.weight.size()); ++k) {
            out[k] += part.weight[k];
        }
    }
    return out;
}

} // namespace

std::string to_svg(const Rose& rose) {
    const std::size_t sectors = rose.parts.empty() ? 0 : rose.parts.front().weight.size();
    const auto sums = sums_of(rose, sectors);
    const double total = std::accumulate(sums.begin(), sums.end(), 0.0);
    const double even_total = std::accumulate(rose.even.begin(), rose.even.end(), 0.0);
    const bool even = even_total > 0.0 && rose.even.size() == sectors;
    double most = 0.0; // share of a sector
    for (std::size_t k = 0; k < sectors; ++k) {
        most = std::max({most, total > 0.0 ? sums[k] / total : 0.0, even ? rose.even[k] / even_total : 0.0});
    }
    const double quarter = rose.turn <= 90.0 ? 1.0 : 0.0;
    // A quarter has its centre in the lower left corner; half a turn is drawn on both sides, since a direction has no sense.
    const double left = quarter > 0.0 ? -24.0 : -reach - 34.0;
    const double high = quarter > 0.0 ? reach + 52.0 : 2.0 * reach + 52.0;
    std::string out =
        fmt::format("<svg viewBox=\"{} {} {} {}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\" "
                    "font-size=\"{}\">\n<title>{}</title><desc>{}</desc>\n",
                    left, -reach - 24.0, reach + 34.0 - left, high, quarter > 0.0 ? 9 : 14, escape(rose.title), escape(describe(rose)));
    if (most <= 0.0) {
        return out + text({0.0, 0.0}, "middle", "none") + "</svg>\n";
    }
    const auto radius = [&](double share) { return reach * std::sqrt(share / most); };
    const double wide = rose.turn / static_cast<double>(sectors);
    for (const double part : {0.5, 1.0}) {
        const double r = reach * std::sqrt(part);
        out += quarter > 0.0
                   ? fmt::format("<path d=\"M0 {0:.1f}A{1:.1f} {1:.1f} 0 0 1 {1:.1f} 0\" fill=\"none\" stroke=\"#ddd\"/>\n", -r, r)
                   : fmt::format("<circle r=\"{:.1f}\" fill=\"none\" stroke=\"#ddd\"/>\n", r);
    }
    const int turns = rose.turn > 90.0 && rose.turn <= 180.0 ? 2 : 1;
    for (std::size_t k = 0; k < sectors && total > 0.0; ++k) {
        for (int turn = 0; turn < turns; ++turn) {
            const double from = static_cast<double>(k) * wide + 180.0 * turn;
            double below = 0.0;
            for (std::size_t p = 0; p < rose.parts.size(); ++p) {
                const double share = rose.parts[p].weight[k] / total;
                if (share > 0.0) {
                    out +=
                        sector(from + 0.04 * wide, from + 0.96 * wide, radius(below), radius(below + share), rose.parts[p].colour, p > 0);
                }
                below += share;
            }
        }
    }
    for (int turn = 0; even && turn < turns; ++turn) {
        for (std::size_t k = 0; k < sectors; ++k) {
            const double r = radius(rose.even[k] / even_total);
            const double from = static_cast<double>(k) * wide + 180.0 * turn;
            const Point a = at(from, r);
            const Point b = at(from + wide, r);
            out += fmt::format("<path d=\"M{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 1 {:.2f} {:.2f}\" fill=\"none\" stroke=\"#111\" "
                               "stroke-width=\"1.4\" stroke-dasharray=\"5 3\"/>\n",
                               a.x, a.y, r, r, b.x, b.y);
        }
    }
    out += text({quarter > 0.0 ? -20.0 : 0.0, -reach - 8.0}, quarter > 0.0 ? "start" : "middle", "0\u00b0");
    if (quarter > 0.0) {
        out += fmt::format("<path d=\"M0 {:.1f}V0H{:.1f}\" fill=\"none\" stroke=\"#8a949e\"/>\n", -reach - 4.0, reach + 4.0);
        out += text({reach, 14.0}, "end", "90\u00b0") + text(at(45.0, reach + 8.0), "start", "45");
    } else {
        out += text({reach + 4.0, 4.0}, "start", "90") + text({0.0, reach + 18.0}, "middle", turns > 1 ? "0 = 180" : "180");
    }
    out += text({quarter > 0.0 ? 2.0 : 4.0, quarter > 0.0 ? 24.0 : -reach * std::sqrt(0.5) - 2.0}, "start",
                quarter > 0.0 ? fmt::format("outer ring: {:.2g} % a sector", 100.0 * most) : "");
    return out + "</svg>\n";
}

} // namespace proveta::report
