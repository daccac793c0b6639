// Envelopes through points that lie on known ones.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/series/strength_envelope.hpp"

using namespace proveta;

namespace {

constexpr double mpa = 1e6;
constexpr double degree = std::numbers::pi / 180.0;
const std::vector<double> pressures{0.0, 1.5 * mpa, 4.5 * mpa, 9.0 * mpa, 30.0 * mpa, 60.0 * mpa};

// sigma_1 = 2 c cos(phi) / (1 - sin(phi)) + sigma_3 (1 + sin(phi)) / (1 - sin(phi)): the textbook's form, not the fit's.
double mohr_coulomb(double c, double phi, double sigma_3) {
    return (2.0 * c * std::cos(phi) + sigma_3 * (1.0 + std::sin(phi))) / (1.0 - std::sin(phi));
}

double hoek_brown(double sigma_ci, double m, double sigma_3) {
    return sigma_3 + sigma_ci * std::sqrt(std::max(0.0, m * sigma_3 / sigma_ci + 1.0));
}

template <class Law> std::vector<StrengthPoint> points_of(const Law& law) {
    std::vector<StrengthPoint> points;
    for (const double p : pressures) {
        points.push_back({p, law(p)});
    }
    return points;
}

} // namespace

TEST_CASE("Mohr-Coulomb: points on a line give its cohesion and friction angle") {
    for (const double phi : {0.5 * degree, 30.0 * degree, 42.0 * degree, 60.0 * degree}) {
        const auto found = fit_mohr_coulomb(points_of([&](double p) { return mohr_coulomb(8.0 * mpa, phi, p); }));
        REQUIRE(found);
        CHECK(found->line.cohesion() == Approx(8.0 * mpa).epsilon(1e-10));
        CHECK(found->line.friction_angle() == Approx(phi).epsilon(1e-10));
        CHECK(found->r2 == Approx(1.0).epsilon(1e-12));
        CHECK(*found->cohesion_error < 1e-8 * mpa);
        CHECK(*found->friction_angle_error < 1e-10);
    }
}

TEST_CASE("Mohr-Coulomb: two points make a line without errors, tension is not its business") {
    const auto found = fit_mohr_coulomb({{-3.0 * mpa, 0.0}, {0.0, 30.0 * mpa}, {10.0 * mpa, 70.0 * mpa}});
    REQUIRE(found);
    CHECK(found->line.slope == Approx(4.0));
    CHECK(found->line.intercept == Approx(30.0 * mpa));
    CHECK_FALSE(found->cohesion_error);
    CHECK_FALSE(found->friction_angle_error);
    // A servo that holds no pressure a little below zero is not a tension test.
    const auto servo = fit_mohr_coulomb({{-1e-3 * mpa, 30.0 * mpa - 4e-3 * mpa}, {10.0 * mpa, 70.0 * mpa}});
    REQUIRE(servo);
    CHECK(servo->line.intercept == Approx(30.0 * mpa));
}

TEST_CASE("Mohr-Coulomb: standard errors of a sample worked by hand") {
    // sigma_3 = 0, 1, 2 and sigma_1 = 10, 14.3, 18 (MPa): K = 4, P = 10.1, residuals -0.1, 0.2, -0.1, s^2 = 0.06; S_xx = 2, so
    // var K = 0.03, var P = 0.06 (1/3 + 1/2) = 0.05, cov = -0.03.
    const auto found = fit_mohr_coulomb({{0.0, 10.0 * mpa}, {1.0 * mpa, 14.3 * mpa}, {2.0 * mpa, 18.0 * mpa}});
    REQUIRE(found);
    CHECK(found->line.slope == Approx(4.0));
    CHECK(found->line.intercept == Approx(10.1 * mpa));
    CHECK(found->r2 == Approx(1.0 - 0.06 / 32.06));
    // dphi/dK = 1 / (sqrt K (1 + K)) = 0.1; dc/dP = 1/4, dc/dK = -P / (4 K^1.5) = -10.1 / 32.
    CHECK(*found->friction_angle_error == Approx(0.1 * std::sqrt(0.03)));
    const double dk = -10.1 / 32.0;
    CHECK(*found->cohesion_error == Approx(mpa * std::sqrt(0.05 / 16.0 - 2.0 * 0.25 * dk * 0.03 + dk * dk * 0.03)));
}

TEST_CASE("Mohr-Coulomb: refuses what is no envelope, and says why") {
    CHECK(fit_mohr_coulomb({}).reason.find("two distinct") != std::string::npos);
    CHECK(fit_mohr_coulomb({{0.0, 30.0 * mpa}}).reason.find("two distinct") != std::string::npos);
    const auto same = fit_mohr_coulomb({{4.5 * mpa, 50.0 * mpa}, {4.5001 * mpa, 55.0 * mpa}, {4.5 * mpa, 52.0 * mpa}});
    CHECK(same.reason.find("two distinct") != std::string::npos);
    const auto flat = fit_mohr_coulomb({{0.0, 30.0 * mpa}, {10.0 * mpa, 40.0 * mpa}});
    CHECK_FALSE(flat);
    CHECK(flat.reason.find("K <= 1") != std::string::npos);
}

TEST_CASE("Hoek-Brown: points on the curve give its numbers, tension included") {
    for (const double m : {1.5, 7.0, 30.0}) {
        const double ci = 33.0 * mpa;
        auto points = points_of([&](double p) { return hoek_brown(ci, m, p); });
        for (const bool tension : {false, true}) {
            if (tension) {
                points.push_back({-0.5 * ci * (std::sqrt(m * m + 4.0) - m), 0.0});
            }
            const auto found = fit_hoek_brown(points);
            REQUIRE(found);
            CHECK(found->sigma_ci == Approx(ci).epsilon(1e-9));
            CHECK(found->m_i == Approx(m).epsilon(1e-9));
            CHECK(found->r2 == Approx(1.0).epsilon(1e-12));
            CHECK(found->tensile_strength() == Approx(0.5 * ci * (std::sqrt(m * m + 4.0) - m)).epsilon(1e-9));
            CHECK(std::fabs(found->sigma_1(-found->tensile_strength())) < 1e-6 * mpa);
        }
    }
}

TEST_CASE("Hoek-Brown: scattered points end at the least squares of sigma_1") {
    std::vector<StrengthPoint> points{{-3.0 * mpa, 0.0},       {0.0, 31.0 * mpa},         {1.5 * mpa, 45.0 * mpa},
                                      {9.0 * mpa, 70.0 * mpa}, {30.0 * mpa, 140.0 * mpa}, {60.0 * mpa, 195.0 * mpa}};
    const auto found = fit_hoek_brown(points);
    REQUIRE(found);
    const auto sum = [&](double ci, double m) {
        double s = 0.0;
        for (const auto& p : points) {
            const double r = (p.sigma_1 - hoek_brown(ci, m, p.sigma_3)) / mpa;
            s += r * r;
        }
        return s;
    };
    const double least = sum(found->sigma_ci, found->m_i);
    for (const double step : {1e-2, 1e-3, 1e-4}) {
        for (int k = 0; k < 16; ++k) {
            const double angle = std::numbers::pi * k / 8.0;
            CHECK(sum(found->sigma_ci * (1.0 + step * std::cos(angle)), found->m_i * (1.0 + step * std::sin(angle))) > least);
        }
    }
    CHECK(found->r2 > 0.95);
    CHECK(found->r2 < 1.0);
}

TEST_CASE("Hoek-Brown: refuses what it cannot describe") {
    CHECK(fit_hoek_brown({{0.0, 30.0 * mpa}}).reason.find("two distinct") != std::string::npos);
    CHECK(fit_hoek_brown({{0.0, 30.0 * mpa}, {10.0 * mpa, 40.0 * mpa}, {20.0 * mpa, 48.0 * mpa}}).reason.find("m_i <= 0") !=
          std::string::npos);
    CHECK(fit_hoek_brown({{10.0 * mpa, 20.0 * mpa}, {20.0 * mpa, 80.0 * mpa}}).reason.find("sigma_ci^2") != std::string::npos);
}

TEST_CASE("(5.22) with table 5.5, and back to its own cohesion and angle") {
    const auto line = thesis_line(16.0 * mpa, 0.9);
    CHECK(line.intercept == Approx(71.9 * mpa).epsilon(1e-3));
    CHECK(line.slope == Approx(5.04).epsilon(1e-3));
    CHECK(line.slope == Approx(std::pow(std::tan(std::numbers::pi / 4.0 + std::atan(0.9) / 2.0), 2)).epsilon(1e-12));
    CHECK(line.cohesion() == Approx(16.0 * mpa).epsilon(1e-12));
    CHECK(std::tan(line.friction_angle()) == Approx(0.9).epsilon(1e-12));
}

TEST_CASE("Attard and Setunge's estimate for a strength of 32.8 MPa") {
    const std::vector<std::pair<double, double>> expected{{0.0, 32.8}, {1.5, 42.0}, {4.5, 57.0}, {9.0, 77.0}, {30.0, 151.0}, {60.0, 252.0}};
    for (const auto& [pressure, strength] : expected) {
        CHECK(attard_setunge(32.8 * mpa, pressure * mpa) == Approx(strength * mpa).margin(0.5 * mpa));
    }
}

TEST_CASE("both plotted envelopes touch every circle of exact points and cut none") {
    const double phi = 40.0 * degree;
    const auto line = strength_envelope(points_of([&](double p) { return mohr_coulomb(8.0 * mpa, phi, p); }));
    const auto curve = strength_envelope(points_of([](double p) { return hoek_brown(33.0 * mpa, 8.0, p); }));
    for (const auto* e : {&line, &curve}) {
        const auto plot = mohr_plot(*e);
        CHECK(plot.equal_scale);
        REQUIRE(plot.curves.size() == e->points.size() + 2);
        const auto& drawn = plot.curves[e->points.size() + (e == &line ? 0 : 1)];
        for (const auto& p : e->points) {
            const double centre = 0.5 * (p.sigma_1 + p.sigma_3) / mpa;
            const double radius = 0.5 * (p.sigma_1 - p.sigma_3) / mpa;
            double nearest = 1e300;
            for (std::size_t k = 1; k < drawn.x.size(); ++k) {
                for (int part = 0; part <= 100; ++part) {
                    const double t = part / 100.0;
                    nearest = std::min(nearest, std::hypot(drawn.x[k - 1] + t * (drawn.x[k] - drawn.x[k - 1]) - centre,
                                                           drawn.y[k - 1] + t * (drawn.y[k] - drawn.y[k - 1])));
                }
            }
            CHECK(nearest == Approx(radius).epsilon(1e-3)); // the curve is drawn in 90 straight pieces
        }
    }
}

TEST_CASE("the plot of strengths holds points, fits and dashed estimates; results give reasons") {
    auto e = strength_envelope(points_of([](double p) { return hoek_brown(33.0 * mpa, 8.0, p); }));
    e.thesis = thesis_line(16.0 * mpa, 0.9);
    e.fc = 33.0 * mpa;
    const auto plot = strength_plot(e);
    REQUIRE(plot.curves.size() == 5);
    CHECK(plot.curves[0].style == report::CurveStyle::solid);
    CHECK(plot.curves[2].style == report::CurveStyle::dashed);
    CHECK(plot.curves[3].name.find("estimate") != std::string::npos);
    CHECK(plot.curves[4].style == report::CurveStyle::points);
    CHECK(plot.curves[4].y.front() == Approx(33.0));

    const auto results = envelope_results(strength_envelope({{0.0, 30.0 * mpa}}));
    REQUIRE_FALSE(results.empty());
    for (const auto& r : results) {
        CHECK_FALSE(r.value);
        CHECK(r.formula.find("two distinct") != std::string::npos);
    }
}
