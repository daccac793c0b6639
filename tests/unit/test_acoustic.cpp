// Acoustic events from made-up failures.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "lab/acoustic.hpp"
#include "reports/files.hpp"

using namespace proveta;

namespace {

constexpr AcousticRule rule{4e-3, 4000.0}; // reach 10 mm, 10 us
constexpr double mm = 1e-3;
constexpr double us = 1e-6;

FailureEvent failure(double time, const Vec3& position, double energy = 1e-3, FailureMode mode = FailureMode::tension) {
    return {time, 100.0 * time, position, mode, energy};
}

// Independent of the platform, unlike the standard library's distributions. In (0, 1].
double uniform(std::mt19937_64& random) { return (static_cast<double>(random() >> 11) + 1.0) * 0x1p-53; }

// Clusters by comparing all pairs: the rule itself, word for word. Returns the number of each failure's cluster.
std::vector<std::size_t> all_pairs(const std::vector<FailureEvent>& f, const AcousticRule& r) {
    std::vector<std::size_t> label(f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
        label[k] = k;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < f.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if ((f[i].position - f[j].position).norm() <= r.distance() && std::fabs(f[i].time - f[j].time) <= r.duration() &&
                    label[i] != label[j]) {
                    label[i] = label[j] = std::min(label[i], label[j]);
                    changed = true;
                }
            }
        }
    }
    return label;
}

} // namespace

TEST_CASE("acoustic: the rule's lengths") {
    CHECK(rule.distance() == Approx(10 * mm));
    CHECK(rule.duration() == Approx(10 * us));
    CHECK_THROWS_AS(acoustic_events({}, {0.0, 4000.0}), std::invalid_argument);
    CHECK(acoustic_events({}, rule).empty());
}

TEST_CASE("acoustic: failures near in space and time are one event, with known numbers") {
    const auto events =
        acoustic_events({failure(1.0, {0, 0, 0}, 1e-3), failure(1.0 + 8 * us, {8 * mm, 0, 0}, 3e-3, FailureMode::shear)}, rule);
    REQUIRE(events.size() == 1);
    const auto& e = events.front();
    CHECK(e.start == 1.0);
    CHECK(e.duration == Approx(8 * us).epsilon(1e-6));
    CHECK(e.axial_strain == 100.0);
    CHECK(e.bonds == 2);
    CHECK(e.tension == 0.5);
    CHECK(e.energy == Approx(4e-3));
    CHECK(e.centre.x() == Approx(6 * mm));
    CHECK(e.radius == Approx(std::sqrt(0.25 * 36.0 + 0.75 * 4.0) * mm));
    CHECK(*e.magnitude == Approx(2.0 / 3.0 * (std::log10(4e-3) - 4.8)));
}

TEST_CASE("acoustic: far in space or in time they stay apart") {
    CHECK(acoustic_events({failure(1.0, {0, 0, 0}), failure(1.0, {10.01 * mm, 0, 0})}, rule).size() == 2);
    CHECK(acoustic_events({failure(1.0, {0, 0, 0}), failure(1.0, {9.99 * mm, 0, 0})}, rule).size() == 1);
    CHECK(acoustic_events({failure(1.0, {0, 0, 0}), failure(1.0 + 10.01 * us, {0, 0, 0})}, rule).size() == 2);
    CHECK(acoustic_events({failure(1.0, {0, 0, 0}), failure(1.0 + 9.99 * us, {0, 0, 0})}, rule).size() == 1);
    const auto single = acoustic_events({failure(1.0, {0, 0, 0}, 0.0)}, rule);
    REQUIRE(single.size() == 1);
    CHECK(single[0].radius == 0.0);
    CHECK(single[0].duration == 0.0);
    CHECK_FALSE(single[0].magnitude);
}

TEST_CASE("acoustic: a running crack is one event as long as it runs faster than the rule's speed") {
    std::vector<FailureEvent> fast;
    std::vector<FailureEvent> slow;
    for (int k = 0; k < 50; ++k) { // steps of 9 mm in 9.5 us (947 m/s) and in 10.5 us (857 m/s); the rule's is c/4 = 1000 m/s over 10 mm
        fast.push_back(failure(9.5 * us * k, {9 * mm * k, 0, 0}));
        slow.push_back(failure(10.5 * us * k, {9 * mm * k, 0, 0}));
    }
    const auto one = acoustic_events(fast, rule);
    REQUIRE(one.size() == 1);
    CHECK(one[0].duration == Approx(49 * 9.5 * us));
    CHECK(one[0].centre.x() == Approx(24.5 * 9 * mm));
    CHECK(one[0].radius == Approx(9 * mm * std::sqrt((50.0 * 50.0 - 1.0) / 12.0)));
    CHECK(acoustic_events(slow, rule).size() == 50);
}

TEST_CASE("acoustic: the sweep finds what comparing all pairs finds, in any order of the failures") {
    std::mt19937_64 random(7);
    for (const double box : {15 * mm, 40 * mm, 80 * mm}) {
        std::vector<FailureEvent> f;
        for (int k = 0; k < 400; ++k) {
            const Vec3 place{box * (uniform(random) - 0.5), box * (uniform(random) - 0.5), box * (uniform(random) - 0.5)};
            f.push_back(failure(400 * us * uniform(random), place, 1e-3 * uniform(random)));
        }
        auto label = all_pairs(f, rule);
        std::vector<std::size_t> sizes;
        for (std::size_t k = 0; k < f.size(); ++k) {
            const auto n = std::count(label.begin(), label.end(), k);
            if (n > 0) {
                sizes.push_back(static_cast<std::size_t>(n));
            }
        }
        std::sort(sizes.begin(), sizes.end());
        const auto events = acoustic_events(f, rule);
        std::vector<std::size_t> found;
        double energy = 0.0;
        for (const auto& e : events) {
            found.push_back(e.bonds);
            energy += e.energy;
        }
        CHECK(std::is_sorted(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.start < b.start; }));
        std::sort(found.begin(), found.end());
        CHECK(found == sizes);
        CHECK(energy == Approx(std::accumulate(f.begin(), f.end(), 0.0, [](double s, const auto& e) { return s + e.energy; })));

        auto other = f;
        std::reverse(other.begin(), other.end());
        const auto again = acoustic_events(other, rule);
        REQUIRE(again.size() == events.size());
        for (std::size_t k = 0; k < events.size(); ++k) {
            REQUIRE(again[k].start == events[k].start);
            REQUIRE(again[k].bonds == events[k].bonds);
            REQUIRE(again[k].energy == events[k].energy); // all times differ: the same sums
            REQUIRE(again[k].radius == events[k].radius);
        }
    }
}

TEST_CASE("acoustic: as many failures as a specimen has bonds, over a time or all at once") {
    const AcousticRule of_specimen{5 * mm, 3500.0};
    constexpr int n = 32000;
    const double edge = std::cbrt(n / 1.5e7); // as dense as a specimen's bonds, 1.5e7 a m3
    for (const bool at_once : {false, true}) {
        std::mt19937_64 random(11);
        std::vector<FailureEvent> f;
        for (int k = 0; k < n; ++k) {
            const Vec3 place{edge * uniform(random), edge * uniform(random), edge * uniform(random)};
            f.push_back(failure(at_once ? 0.0 : 0.1 * n * of_specimen.duration() * uniform(random), place)); // ten in a window of time
        }
        const auto events = acoustic_events(f, of_specimen);
        CHECK((at_once ? events.size() < 10 : events.size() > n / 100)); // all at once: one burst
    }
}

TEST_CASE("acoustic: b of samples of Gutenberg and Richter's law") {
    for (const double b : {0.7, 1.0, 1.6}) {
        for (const double least : {-6.05, -6.0}) { // an edge of the histogram's bins, and the middle of one
            std::mt19937_64 random(42);
            std::vector<double> m;
            for (int k = 0; k < 5000; ++k) {
                m.push_back(least - std::log10(uniform(random)) / b);
            }
            const auto law = magnitude_law(m);
            REQUIRE(law);
            CHECK(std::fabs(law->b - b) < 2.0 * law->error);
            CHECK(law->error == Approx(law->b / std::sqrt(static_cast<double>(law->events))).epsilon(0.05));
            CHECK(law->completeness >= least - 1e-9);
            CHECK(law->completeness < least + 0.15);
        }
    }
}

TEST_CASE("acoustic: b by hand, and no b where there is none") {
    // 60 magnitudes at 1.0 and 30 at 1.3: M_c = 0.95, mean 1.1, b = log10(e) / 0.15; deviations -0.1 and 0.2, sum of squares 1.8.
    std::vector<double> m(60, 1.0);
    m.insert(m.end(), 30, 1.3);
    m.insert(m.end(), 20, 0.2); // below completeness: do not count
    const auto law = magnitude_law(m);
    REQUIRE(law);
    CHECK(law->completeness == Approx(0.95));
    CHECK(law->events == 90);
    CHECK(law->b == Approx(0.4342944819 / 0.15));
    CHECK(law->error == Approx(2.302585093 * law->b * law->b * std::sqrt(1.8 / (90.0 * 89.0))));
    CHECK(magnitude_law({}).reason.find("fewer than 50") != std::string::npos);
    CHECK_FALSE(magnitude_law(std::vector<double>(49, 1.0)));
    CHECK(magnitude_law(std::vector<double>(100, 1.0)).reason.find("do not differ") != std::string::npos);
}

TEST_CASE("acoustic: table, results and plots") {
    std::vector<FailureEvent> f;
    std::mt19937_64 random(3);
    for (int k = 0; k < 300; ++k) { // apart in time: each its own event, of magnitudes that follow b = 1
        f.push_back(failure(1e-3 * k, Vec3::Zero(), 1e-6 * std::pow(uniform(random), -1.5)));
    }
    const auto events = acoustic_events(f, rule);
    REQUIRE(events.size() == 300);
    const auto table = acoustic_table(events, rule);
    CHECK(table.rows.size() == 300);
    CHECK(table.rows[0].size() == table.columns.size());
    CHECK(report::to_csv(table).find("time_s,duration_s,axial_strain,x_m,y_m,z_m,bonds,tension_share,energy_J,magnitude,radius_m\n") !=
          std::string::npos);
    const auto results = acoustic_results(events);
    CHECK(results[0].value == 300.0);
    REQUIRE(results[3].value);
    CHECK(*results[3].value == Approx(1.0).margin(0.25));
    const auto activity = acoustic_activity_plot(events);
    CHECK(activity.curves[0].y.back() == Approx(1.0));
    CHECK(activity.curves[1].y.back() == Approx(1.0));
    CHECK(activity.curves[0].x.back() == Approx(100.0 * f.back().axial_strain));
    const auto frequency = magnitude_plot(events);
    REQUIRE(frequency.curves.size() == 2);
    CHECK_FALSE(frequency.x_from_zero);
    CHECK(frequency.curves[0].y.front() == Approx(std::log10(300.0)));
    CHECK(acoustic_activity_plot({}).curves[0].x.empty());
    CHECK(magnitude_plot({}).curves.size() == 1);
    CHECK_FALSE(acoustic_results({})[3].value);
}
