#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "lab/controls/closing.hpp"
#include "lab/crack_report.hpp"
#include "lab/derived.hpp"
#include "lab/mohr_report.hpp"
#include "lab/quasi_static.hpp"
#include "lab/specimen_report.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "reports/svg.hpp"

using namespace proveta;

TEST_CASE("slopes, peaks and crossings of a known curve") {
    std::vector<double> x;
    std::vector<double> y;
    for (int k = 0; k <= 200; ++k) {
        x.push_back(1e-5 * k);
        y.push_back(k <= 100 ? 2e9 * 1e-5 * k : 2e6 - 1e9 * 1e-5 * (k - 100));
    }
    CHECK(peak_index(y) == 100);
    CHECK(*slope_between(x, y, 0.1, 0.6) == Approx(2e9));
    CHECK(*x_at_share(x, y, 0.5) == Approx(5e-4));
    CHECK_FALSE(slope_between({}, {}, 0.1, 0.5));
    CHECK_FALSE(fit({1, 1, 1}, {1, 2, 3}, 0, 2));
}

TEST_CASE("a start is smooth and ends at full speed") {
    CHECK(smooth_start(0.0, 1.0) == 0.0);
    CHECK(smooth_start(0.5, 1.0) == Approx(0.5));
    CHECK(smooth_start(1.0, 1.0) == 1.0);
    CHECK(smooth_start(0.0, 0.0) == 1.0);
    CHECK((smooth_start(1e-3, 1.0) - smooth_start(0.0, 1.0)) / 1e-3 < 0.01);
}

TEST_CASE("CSV has notes, meanings, one heading and 17 digits") {
    report::Table t;
    t.notes = {"compression positive"};
    t.columns = {{"stress", "Pa", "mean"}, {"strain", "", "nominal"}};
    t.rows = {{1.0 / 3.0, 2.0}};
    CHECK(report::to_csv(t) == "# compression positive\n# stress_Pa: mean\n# strain: nominal\nstress_Pa,strain\n0.33333333333333331,2\n");
    CHECK_THROWS_AS(t.column("none"), std::out_of_range);
}

TEST_CASE("no text of a user reaches the page unescaped") {
    report::Record r;
    r.title = "<script>alert('x')</script>";
    r.warnings = {"\"&<>"};
    r.plots = {{"</script><b>", "x </script>", "\"y\"", {{"<!--", {0, 1}, {0, 1}, "#111"}, {"b", {0, 1}, {0, 2}}}, {}}};
    r.sections = {
        {"<i>s", "<i>a", {}, {{"<i>r", "<i>", 90.0, {{"<i>p", "#111", {1.0}}}, {}}}, {{"<i>t", {{"<i>h"}, {"<i>c"}}, {"\"><i>"}}}}};
    r.key_figures = {{"<i>k", "<i>1", "<i>u", "<i>n"}};
    r.citation = "<i>";
    const auto html = report::to_html(r);
    CHECK(html.find("alert('x')") == std::string::npos);
    CHECK(html.find("&quot;&amp;&lt;&gt;") != std::string::npos);
    CHECK(html.find("<i>") == std::string::npos);
    CHECK(html.find("<b>\"") == std::string::npos);
    CHECK(html.find("<!--") == std::string::npos);
    const auto count = [&](const std::string& what) {
        std::size_t n = 0;
        for (auto at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) {
            ++n;
        }
        return n;
    };
    CHECK(count("<script") == 2); // the plot's data and the page's own
    CHECK(count("</script") == 2);
    CHECK(count("http://") == count("http://www.w3.org/2000/svg"));
    CHECK(html.find("https://") == std::string::npos);
    CHECK(html.find("default-src 'none'") != std::string::npos);
}

TEST_CASE("a page has one main part, headings in order, captions and scopes") {
    report::Record r;
    r.title = "t";
    r.results = {{"strength", "Strength", 3e7, "Pa", "the largest"}, {"none", "Nothing", {}, "Pa", "never"}};
    r.key_figures = report::key_figures(r.results, {"none", "strength"});
    r.tables = {{"A table", {{"what", "how much"}, {"mass", "3"}}}};
    REQUIRE(r.key_figures.size() == 1);
    CHECK(r.key_figures[0].value == "30");
    CHECK(r.key_figures[0].unit == "MPa");
    const auto counts = report::key_figures({{"n", "Particles", 18494.0, "", ""}, {"m", "Mass", 18494.3, "kg", ""}}, {"n", "m"});
    CHECK(counts[0].value == "18494");
    CHECK(counts[1].value == "18500");
    CHECK(report::key_figure(r.results[1]).value == "not determined");
    const auto html = report::to_html(r);
    CHECK(html.find("<html lang=\"en\">") != std::string::npos);
    CHECK(html.find("<main id=\"main\">") == html.rfind("<main"));
    CHECK(html.find("<h1>") < html.find("<h2"));
    CHECK(html.find("<caption><span>A table</span></caption>") != std::string::npos);
    CHECK(html.find("<th scope=\"col\" class=\"num\">how much</th>") != std::string::npos);
    CHECK(html.find("<th scope=\"row\">mass</th><td class=\"num\">3</td>") != std::string::npos);
    CHECK(html.find("not determined</td>") != std::string::npos);
}

TEST_CASE("numbers to be read have three digits and suit their unit") {
    for (const auto& [value, text] : {std::pair{32.5412, "32.5"},
                                      {0.2126, "0.213"},
                                      {12345.6, "12300"},
                                      {12345.0, "12345"},
                                      {-0.00147, "-0.00147"},
                                      {0.0, "0"},
                                      {-0.0, "0"},
                                      {1.234e-7, "1.23e-07"},
                                      {0.2, "0.200"}}) {
        CHECK(report::three_digits(value) == text);
    }
    CHECK(report::three_digits(std::nan("")).empty());
    const auto unit_of = [](const char* name, double value, const char* unit) {
        return report::readable({name, "", value, unit, ""}).unit;
    };
    CHECK(unit_of("post_peak_slope", -0.5e9, "Pa") == "GPa"); // as the moduli beside it
    CHECK(unit_of("young_modulus", 28e9, "Pa") == "GPa");
    CHECK(unit_of("strength", 1.2e9, "Pa") == "MPa"); // as every stress
    CHECK(unit_of("strain_at_peak", 0.002, "") == "%");
    CHECK(unit_of("strain_ratio", 1.0, "").empty());
    CHECK(unit_of("crack_energy", 80.0, "J/m2") == "J/m\u00b2");
    CHECK(unit_of("bulk_density_box", 1500.0, "kg/m3") == "kg/m\u00b3");
    CHECK(unit_of("friction_angle", 42.0, "deg") == "\u00b0");
    const report::InUnit shown({"strength", "", std::nullopt, "Pa", ""}, {30e6, std::nan(""), 31e6});
    CHECK(shown.text(30.123e6) == "30.1");
    CHECK(report::relative_change(-0.0123) == "-1.23 %");
    CHECK(report::relative_change(0.256) == "+25.6 %");
    CHECK(report::relative_change(16.2) == "\u00d717.2");
    CHECK(report::has_ratios("strength"));
    CHECK_FALSE(report::has_ratios("largest_magnitude"));
    CHECK_FALSE(report::has_ratios("toe_strain"));
}

TEST_CASE("failures are counted by strain, each in one bar") {
    std::vector<FailureEvent> events;
    for (int k = 0; k < 48; ++k) {
        events.push_back({0.0, -1e-4 * (k + 1), Vec3::Zero(), k % 3 == 0 ? FailureMode::shear : FailureMode::tension, 0.0, 1.0});
    }
    const auto plot = failure_histogram(events, -100.0); // a test in tension: its strains are negative
    REQUIRE(plot.curves.size() == 2);
    double sums[2] = {};
    for (std::size_t c = 0; c < 2; ++c) {
        CHECK(plot.curves[c].style == report::CurveStyle::bars);
        for (const double n : plot.curves[c].y) {
            sums[c] += n;
        }
    }
    CHECK(sums[0] == 32);
    CHECK(sums[1] == 16);
    CHECK(plot.curves[0].x.back() < 0.48);
    CHECK(failure_histogram({}, 100.0).curves[0].x.empty());
}

TEST_CASE("cracks lie across their bonds") {
    const std::vector<CrackFacet> facets{{Vec3::UnitX(), 3.0, FailureMode::tension},
                                         {Vec3::UnitZ(), 1.0, FailureMode::shear},
                                         {Vec3(1, 0, 1).normalized(), 2.0, FailureMode::intact}};
    const auto dips = crack_dips(facets, Vec3::UnitZ());
    CHECK(dips.parts[0].weight.front() == 3.0); // splitting: along the axis
    CHECK(dips.parts[1].weight.back() == 1.0);
    CHECK(dips.even[4] == 2.0); // at 45 degrees
    const auto strikes = crack_strikes(facets, Vec3::UnitZ(), Vec3::UnitX());
    CHECK(strikes.parts[0].weight[6] == 3.0); // at 90 degrees to x
    CHECK(strikes.parts[1].weight[6] == Approx(0.0).margin(1e-12));
}

TEST_CASE("a single confined test has its circles, an unconfined or hydrostatic one none") {
    report::Table curve;
    curve.columns = {{"axial_stress", "Pa", ""}, {"lateral_stress", "Pa", ""}};
    for (const double deviator : {0.0, 5.0, 10.0, 20.0, 12.0}) {
        curve.rows.push_back({(4.0 + deviator) * 1e6, 4e6});
    }
    const auto plot = circles_of_test(curve, false);
    REQUIRE(plot);
    REQUIRE(plot->curves.size() == 3);
    CHECK(plot->equal_scale);
    const auto& peak = plot->curves[1];
    CHECK(peak.x.front() == Approx(4.0));
    CHECK(peak.x.back() == Approx(24.0));
    CHECK(*std::max_element(peak.y.begin(), peak.y.end()) == Approx(10.0));
    const auto loose = circles_of_test(curve, true);
    CHECK(loose->curves.back().y.back() / loose->curves.back().x.back() == Approx(std::tan(std::asin(20.0 / 28.0))));
    for (auto& row : curve.rows) {
        row[1] = row[0];
    }
    CHECK_FALSE(circles_of_test(curve, false));
    for (auto& row : curve.rows) {
        row[1] = 0.0;
    }
    CHECK_FALSE(circles_of_test(curve, false));
}

TEST_CASE("the grading of a made specimen is the one asked for, as far as a few hundred spheres can tell") {
    SpecimenRecipe recipe;
    recipe.spheres = 300;
    const auto plot = grading_plot(make_specimen(recipe));
    REQUIRE(plot.curves.size() == 2);
    for (const auto& c : plot.curves) {
        CHECK(c.y.back() == Approx(100.0));
        CHECK(std::is_sorted(c.x.begin(), c.x.end()));
    }
    const auto median = [](const report::Curve& c) {
        return c.x[static_cast<std::size_t>(std::lower_bound(c.y.begin(), c.y.end(), 50.0) - c.y.begin())];
    };
    CHECK(median(plot.curves[0]) == Approx(median(plot.curves[1])).epsilon(0.03));
}

TEST_CASE("the verdict on quasi-static loading follows its figures") {
    report::Table curve;
    for (const char* name : {"axial_stress", "force_bottom", "force_top", "unbalanced_ratio", "phase", "axial_strain", "gauge_axial_strain",
                             "circumferential_strain", "volumetric_strain", "deviatoric_stress"}) {
        curve.columns.push_back({name, "", ""});
    }
    report::Table energy;
    energy.columns = {{"kinetic", "", ""}, {"elastic", "", ""}};
    for (int k = 1; k <= 10; ++k) {
        curve.rows.push_back({1.0 * k, 100.0 * k, 101.0 * k, 0.005, phase_loading, 1e-3 * k, 1e-3 * k, 0.0, 0.0, 1.0 * k});
        energy.rows.push_back({0.001, 1.0});
    }
    CHECK(quasi_static_verdict(curve, 1.0, energy).good);
    auto uneven = curve;
    uneven.rows[5][1] *= 0.95;
    CHECK_FALSE(quasi_static_verdict(uneven, 1.0, energy).good);
    auto shaking = curve;
    shaking.rows[5][3] = 0.02;
    CHECK_FALSE(quasi_static_verdict(shaking, 1.0, energy).good);
    auto fast = energy;
    fast.rows[5][0] = 0.02;
    CHECK_FALSE(quasi_static_verdict(curve, 1.0, fast).good);
    CHECK_FALSE(quasi_static_verdict({curve.columns, {}, {}}, 1.0, {energy.columns, {}, {}}).good);
}
