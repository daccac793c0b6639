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

TEST_CASE("svg: every figure says in words what it shows") {
    report::Plot plot{"a <title>", "strain [%]", "stress [MPa]", {{"platens", {0, 1, 2}, {0, 30, 10}}}, {}};
    const auto svg = to_svg(plot);
    CHECK(svg.find("<title>a &lt;title&gt;</title>") != std::string::npos);
    CHECK(svg.find("platens: from 0 at 0 to 10 at 2, farthest from zero 30 at 1.") != std::string::npos);
    const report::Rose rose{"r", "about.", 90.0, {{"failed", "#111", {1.0, 3.0}}}, {1.0, 1.0}, "all"};
    CHECK(to_svg(rose).find("failed: most between 45 and 90 degrees, 75 % of it.") != std::string::npos);
    CHECK(to_svg(report::Picture{"p", "A cut.", 0.05, 0.1, {}, {}}).find("A cut. 50 mm wide and 100 mm high.") != std::string::npos);
}

TEST_CASE("svg: curves of one style are told apart by more than their colour") {
    report::Plot plot{
        "t", "x", "y", {{"a", {0, 1}, {0, 1}}, {"b", {0, 1}, {0, 2}}, {"c", {0}, {0}, "#111", report::CurveStyle::points}}, {}};
    CHECK(report::markers_of(plot) == std::vector<int>{0, 1, 0});
    plot.curves[1].name = "";
    CHECK(report::markers_of(plot) == std::vector<int>{-1, -1, 0});
}

TEST_CASE("svg: bars stand on zero, those of two curves side by side") {
    using report::CurveStyle;
    report::Plot plot{
        "t", "x", "y", {{"a", {1, 2}, {3, 4}, "#111", CurveStyle::bars}, {"b", {1, 2}, {1, 0}, "#222", CurveStyle::bars}}, {}};
    CHECK(count(to_svg(plot, {480, 320, 13, false}), "<rect") == 4);
}

TEST_CASE("svg: a rose has sectors for its weights, on both sides where a direction has no sense") {
    report::Rose rose{"r", "", 90.0, {{"a", "#abcdef", {1.0, 0.0, 3.0}}, {"b", "#fedcba", {0.0, 0.0, 1.0}}}, {}};
    CHECK(count(to_svg(rose), "fill=\"#abcdef\"") == 2);
    CHECK(count(to_svg(rose), "fill=\"#fedcba\"") == 1);
    rose.turn = 180.0;
    CHECK(count(to_svg(rose), "fill=\"#abcdef\"") == 4);
    rose.parts = {{"a", "#abcdef", {0.0}}};
    CHECK(to_svg(rose).find("nan") == std::string::npos);
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
