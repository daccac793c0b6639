// The controller of the platens' speed, on made-up specimens.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>

#include "lab/controls/rate_control.hpp"

using namespace proveta;

namespace {

constexpr RateScale scale{0.3, 3500.0, 4e-4, 40};
constexpr double dt = 0.3 / 3500.0 / 160.0; // 160 steps a crossing

// A bar that is elastic up to a strain and then turns a share of the work into damage.
struct MadeUp {
    double strain = 0.0;
    double work = 0.0;
    double damage = 0.0;
    double onset = 7e-4;
    double share = 0.03;
    std::int64_t steps = 0;

    void step(RateControl& control) {
        const double rate = control.rate();
        const double more = rate * dt / scale.height;
        work += 28e9 * strain * more;
        damage += strain > onset ? share * 28e9 * strain * more : 0.0;
        strain += more;
        if (control.looks_at(steps)) {
            const double eta = strain > 0.0 ? rate / scale.wave_speed / strain : 0.0;
            const double elastic = std::max(work - damage, 1e-300);
            control.observe({strain, work, damage, eta * eta / 12.0 * elastic, elastic, 0.0, 1e-4});
        }
        control.advance(dt);
        ++steps;
    }
};

} // namespace

TEST_CASE("rate control: starts from rest, moves fast in the elastic range and slowly where bonds break") {
    RateControl control(scale, 1.0);
    MadeUp bar;
    CHECK(control.rate() == 0.0);
    double elastic_rate = 0.0;
    while (bar.strain < 1.5e-3) {
        const double before = control.rate();
        bar.step(control);
        // Inertia makes at most about a hundredth of the stress: (1/8) du / e for a change du in one crossing.
        const double gain = std::fabs(control.rate() - before) / scale.wave_speed * 160.0;
        REQUIRE(gain <= 0.101 * std::max(bar.strain, 1e-4));
        elastic_rate = bar.strain < 7e-4 ? control.rate() : elastic_rate;
        REQUIRE(bar.steps < 20000);
    }
    CHECK(elastic_rate > 0.2);
    CHECK(control.rate() < 0.2 * elastic_rate);
    CHECK(control.damage_ratio() == Approx(bar.share).epsilon(0.05));
}

TEST_CASE("rate control: half the pace is half the speed and twice the steps") {
    double rate[2];
    double steps[2];
    for (const int k : {0, 1}) {
        RateControl control(scale, k == 0 ? 1.0 : 0.5);
        MadeUp bar;
        while (bar.strain < 1.5e-3) {
            bar.step(control);
        }
        rate[k] = control.rate();
        steps[k] = static_cast<double>(bar.steps);
    }
    CHECK(rate[1] == Approx(0.5 * rate[0]).epsilon(0.02));
    CHECK(steps[1] > 1.6 * steps[0]);
}

TEST_CASE("rate control: motion and unbalanced forces slow it down, and it never stops") {
    RateControl control(scale, 1.0);
    MadeUp bar;
    while (bar.strain < 6e-4) {
        bar.step(control);
    }
    const double before = control.rate();
    for (int n = 0; n < 40000; ++n) {
        if (n % 40 == 0) {
            control.observe({6e-4, bar.work, 0.0, 0.0, 1.0, 0.0, 0.5});
        }
        control.advance(dt);
    }
    CHECK(control.rate() < 0.2 * before);
    CHECK(control.rate() > 0.0);
}

TEST_CASE("rate control: a specimen that is crushed goes on as fast as its elastic strain allows") {
    // Two bars at the same strain and the same rate so far; the second has stored a quarter of its work.
    double rate[2];
    for (const int k : {0, 1}) {
        RateControl control(scale, 1.0);
        for (int n = 0; n < 40000; ++n) {
            if (n % 40 == 0) {
                control.observe({0.01, 1.0, 0.0, 0.0, k == 0 ? 1.0 : 0.25, k == 0 ? 0.0 : 0.75, 0.0});
            }
            control.advance(dt);
        }
        rate[k] = control.rate();
    }
    CHECK(rate[1] == Approx(0.25 * rate[0]).epsilon(1e-3));
}

TEST_CASE("rate control: however early damage rules, the test goes on") {
    RateControl control(scale, 1.0);
    MadeUp bar;
    bar.onset = 1e-12;
    while (bar.strain < 5e-3) {
        bar.step(control);
        REQUIRE(bar.steps < 5000 * 160); // crossings
    }
}

TEST_CASE("rate control: its few numbers are its state") {
    RateControl control(scale, 1.0);
    MadeUp bar;
    while (bar.strain < 9e-4) {
        bar.step(control);
    }
    std::map<std::string, double> stored;
    control.visit([&](const std::string& name, double& value) { stored[name] = value; });
    RateControl other(scale, 1.0);
    other.visit([&](const std::string& name, double& value) { value = stored.at(name); });
    MadeUp twin = bar;
    for (int n = 0; n < 2000; ++n) {
        bar.step(control);
        twin.step(other);
    }
    CHECK(other.rate() == control.rate());
    CHECK(twin.strain == bar.strain);
}
