#include <catch2/catch.hpp>

#include "lab/controls/closing.hpp"
#include "lab/derived.hpp"
#include "lab/quasi_static.hpp"
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
    const auto html = report::to_html(r);
    CHECK(html.find("<script>") == std::string::npos);
    CHECK(html.find("&quot;&amp;&lt;&gt;") != std::string::npos);
    CHECK(html.find("http") == std::string::npos);
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
