// What plots look like as text.
#include <catch2/catch.hpp>

#include <array>
#include <regex>
#include <string>

#include "reports/svg.hpp"

using namespace proveta;

namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++n;
    }
    return n;
}

// Ends of the first polyline.
std::array<double, 4> ends_of_line(const std::string& svg) {
    std::smatch m;
    REQUIRE(std::regex_search(svg, m, std::regex("points=\"([\\d.]+),([\\d.]+) (?:.* )?([\\d.]+),([\\d.]+) \"")));
    return {std::stod(m[1]), std::stod(m[2]), std::stod(m[3]), std::stod(m[4])};
}

} // namespace

TEST_CASE("svg: a solid curve is a polyline of the usual width, dashed and points are not") {
    report::Plot plot{"t", "x", "y", {{"a", {0, 1}, {0, 1}}}, {}};
    const auto solid = to_svg(plot);
    CHECK(solid.find("stroke=\"#1f4e79\" stroke-width=\"1.8\" stroke-linejoin=\"round\"/>") != std::string::npos);
    CHECK(solid.find("viewBox=\"0 0 640 380\"") != std::string::npos);
    CHECK(solid.find("dasharray") == std::string::npos);
    CHECK(solid.find("circle") == std::string::npos);
    plot.curves[0].style = report::CurveStyle::dashed;
    CHECK(count(to_svg(plot), "dasharray") == 1);
    plot.curves[0].style = report::CurveStyle::points;
    CHECK(count(to_svg(plot), "<circle") == 2);
    CHECK(count(to_svg(plot), "<polyline") == 0);
}

TEST_CASE("svg: curves without a name have no line in the key") {
    report::Plot plot{"t", "x", "y", {{"first", {0, 1}, {0, 1}}, {"", {0, 1}, {0, 2}}, {"last", {0, 1}, {0, 3}}}, {}};
    const auto svg = to_svg(plot);
    CHECK(count(svg, "<polyline") == 3);
    CHECK(count(svg, "stroke-width=\"3\"") == 2);
    CHECK(svg.find(">first</text>") != std::string::npos);
    CHECK(svg.find(">last</text>") != std::string::npos);
}

TEST_CASE("svg: equal scales make a diagonal of 45 degrees, whichever axis is longer") {
    for (const double wide : {10.0, 200.0, 1.0}) {
        report::Plot plot{"t", "x", "y", {{"diagonal", {0, 1}, {0, 1}}, {"reach", {0, wide}, {0, 50.0 / wide}}}, {}, true};
        const auto [x0, y0, x1, y1] = ends_of_line(to_svg(plot));
        CHECK(x1 > x0);
        CHECK(x1 - x0 == Approx(y0 - y1).margin(0.021)); // two decimals are written
    }
}

TEST_CASE("svg: an axis that need not reach zero does not") {
    report::Plot plot{"t", "x", "y", {{"a", {-6, -4}, {0, 1}}}, {}};
    CHECK(to_svg(plot).find(">0</text>") != to_svg(plot).rfind(">0</text>")); // on both axes
    plot.x_from_zero = false;
    const auto [x0, y0, x1, y1] = ends_of_line(to_svg(plot));
    CHECK(x0 == Approx(66.0));
    CHECK(x1 == Approx(624.0));
    plot.curves.clear();
    CHECK(to_svg(plot).find("nan") == std::string::npos);
}
