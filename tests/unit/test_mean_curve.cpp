// Means of curves and of numbers, against closed forms.
#include <catch2/catch.hpp>

#include <cmath>

#include "lab/series/mean_curve.hpp"
#include "lab/series/statistics.hpp"
#include "reports/files.hpp"

using namespace proveta;

namespace {

// y = slope x from 0 to end with n samples.
SampledCurve straight(double slope, double end, int n) {
    SampledCurve c;
    for (int k = 0; k <= n; ++k) {
        c.x.push_back(end * k / n);
        c.y.push_back(slope * c.x.back());
    }
    return c;
}

} // namespace

TEST_CASE("Student's t at 95 %, two-sided, as printed tables have it") {
    CHECK(student_t95(1) == Approx(12.7062).margin(5.1e-5));
    CHECK(student_t95(2) == Approx(4.30265).margin(5.1e-6));
    CHECK(student_t95(5) == Approx(2.57058).margin(5.1e-6));
    CHECK(student_t95(10) == Approx(2.22814).margin(5.1e-6));
    CHECK(student_t95(30) == Approx(2.04227).margin(5.1e-6));
    // closed forms: tan(pi p / 2) for one degree of freedom, p sqrt(2 / (1 - p^2)) for two
    CHECK(student_t95(1) == Approx(std::tan(0.475 * 3.14159265358979323846)).epsilon(1e-13));
    CHECK(student_t95(2) == Approx(0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95))).epsilon(1e-13));
    // beyond the table
    CHECK(student_t95(31) == Approx(2.039513446).epsilon(5e-5));
    CHECK(student_t95(40) == Approx(2.021075390).epsilon(2.5e-5));
    CHECK(student_t95(120) == Approx(1.979930405).epsilon(1e-6));
    CHECK(student_t95(1000000) == Approx(1.959966356).epsilon(1e-7));
    CHECK(std::isinf(student_t95(0)));
    for (std::size_t nu = 2; nu < 200; ++nu) {
        REQUIRE(student_t95(nu) < student_t95(nu - 1));
    }
}

TEST_CASE("a sample's mean, deviation and confidence interval") {
    const auto s = sample_of({31.0, 33.0, 35.0, 33.0});
    CHECK(s.n == 4);
    CHECK(s.mean == Approx(33.0));
    REQUIRE(s.spread);
    CHECK(s.spread->deviation == Approx(std::sqrt(8.0 / 3.0)));
    CHECK(*s.spread->variation == Approx(std::sqrt(8.0 / 3.0) / 33.0));
    CHECK(s.spread->half_width == Approx(3.182446305 * std::sqrt(8.0 / 3.0) / 2.0));
    CHECK(s.spread->least == 31.0);
    CHECK(s.spread->most == 35.0);
    CHECK(sample_of({5.0}).mean == 5.0);
    CHECK_FALSE(sample_of({5.0}).spread);
    CHECK(sample_of({}).n == 0);
    CHECK_FALSE(sample_of({-1.0, 1.0}).spread->variation);
    CHECK(sample_of({1e9, 1e9 + 1.0}).spread->deviation == Approx(std::sqrt(0.5)));
}

TEST_CASE("mean curve: straight lines of different sampling and length") {
    const std::vector<SampledCurve> members{straight(1.0, 2.0, 7), straight(2.0, 1.0, 13), straight(3.0, 3.0, 5)};
    const auto mean = mean_curve(members, 90);
    REQUIRE(mean);
    CHECK(mean->x.front() == 0.0);
    CHECK(mean->x[mean->common] == 1.0);
    CHECK(mean->x.back() == 3.0);
    CHECK(mean->x.size() == 91);
    for (std::size_t k = 0; k < mean->x.size(); ++k) {
        const double x = mean->x[k];
        const std::size_t left = x <= 1.0 ? 3 : x <= 2.0 ? 2 : 1;
        REQUIRE(mean->curves[k] == left);
        REQUIRE((k <= mean->common) == (left == 3));
        REQUIRE(mean->mean[k] == Approx((left == 1 ? 3.0 : 2.0) * x).margin(1e-12));
        if (left == 3) { // slopes 1, 2, 3
            REQUIRE(mean->deviation[k] == Approx(x).margin(1e-12));
            REQUIRE(mean->half_width[k] == Approx(4.302652730 * x / std::sqrt(3.0)).margin(1e-9));
        } else if (left == 2) { // slopes 1, 3
            REQUIRE(mean->deviation[k] == Approx(std::sqrt(2.0) * x));
            REQUIRE(mean->half_width[k] == Approx(12.70620474 * x));
        } else {
            REQUIRE(std::isnan(mean->deviation[k]));
            REQUIRE(std::isnan(mean->half_width[k]));
        }
    }
}

TEST_CASE("mean curve: equal curves, whatever their sampling, are their own mean") {
    SampledCurve coarse{{0.0, 1.0, 2.0}, {0.0, 5.0, 3.0}};
    SampledCurve fine{{0.0, 0.25, 1.0, 1.5, 2.0}, {0.0, 1.25, 5.0, 4.0, 3.0}};
    const auto mean = mean_curve({coarse, fine}, 8);
    REQUIRE(mean);
    CHECK(mean->common + 1 == mean->x.size());
    for (std::size_t k = 0; k < mean->x.size(); ++k) {
        const double x = mean->x[k];
        CHECK(mean->mean[k] == Approx(x <= 1.0 ? 5.0 * x : 7.0 - 2.0 * x).margin(1e-12));
        CHECK(mean->deviation[k] == Approx(0.0).margin(1e-12));
    }
}

TEST_CASE("mean curve: a cycle of unloading and reloading is bridged, noise and holes as well") {
    const SampledCurve cycle{{0.0, 1.0, 2.0, 1.5, 1.2, 1.6, 2.0, 3.0, NAN, 4.0}, {0.0, 10.0, 20.0, 4.0, 1.0, 5.0, 19.0, 30.0, 31.0, 40.0}};
    const auto kept = advancing(cycle);
    CHECK(kept.x == std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0});
    CHECK(kept.y == std::vector<double>{0.0, 10.0, 20.0, 30.0, 40.0});
    const auto mean = mean_curve({cycle, straight(10.0, 4.0, 3)}, 16);
    REQUIRE(mean);
    for (std::size_t k = 0; k < mean->x.size(); ++k) {
        CHECK(mean->mean[k] == Approx(10.0 * mean->x[k]).margin(1e-12));
    }
}

TEST_CASE("mean curve: begins where the last begins, and refuses what has no mean") {
    SampledCurve late{{0.5, 2.0}, {1.0, 4.0}};
    const auto mean = mean_curve({straight(2.0, 2.0, 4), late});
    REQUIRE(mean);
    CHECK(mean->x.front() == 0.5);
    CHECK(mean->mean.front() == Approx(1.0));
    CHECK_FALSE(mean_curve({}));
    CHECK(mean_curve({late, {{1.0}, {1.0}}}).reason.find("curve 2") != std::string::npos);
    CHECK(mean_curve({late, straight(1.0, 0.4, 2)}).reason.find("in common") != std::string::npos);
    CHECK_THROWS_AS(mean_curve({{{1.0, 2.0}, {1.0}}}), std::invalid_argument);
}

TEST_CASE("mean curve: table and plot") {
    const std::vector<SampledCurve> members{straight(1.0, 1.0, 4), straight(3.0, 2.0, 4)};
    const auto mean = mean_curve(members, 4);
    REQUIRE(mean);
    const auto table = mean_curve_table(*mean, {"axial_strain", "", "nominal"}, {"axial_stress", "Pa", "mean of both platens"});
    CHECK(report::to_csv(table).find("axial_strain,curves,mean_axial_stress_Pa,deviation_axial_stress_Pa,low_axial_stress_Pa,"
                                     "high_axial_stress_Pa\n") != std::string::npos);
    REQUIRE(table.rows.size() == 5);
    CHECK(table.rows[2][1] == 2.0);
    CHECK(table.rows[2][2] == Approx(2.0));
    CHECK(0.5 * (table.rows[2][4] + table.rows[2][5]) == Approx(2.0));
    CHECK(table.rows[4][1] == 1.0);
    const auto plot = mean_curve_plot(*mean, members, {"Mean", "strain [%]", "stress [MPa]", 100.0, 1e-6});
    REQUIRE(plot.curves.size() == 5);
    CHECK(plot.curves[0].width < plot.curves[2].width);
    CHECK(plot.curves[1].name.empty());
    CHECK(plot.curves[2].x.back() == Approx(100.0));
    CHECK(plot.curves[2].y.back() == Approx(2e-6));
    CHECK(plot.curves[3].style == report::CurveStyle::dashed);
}
