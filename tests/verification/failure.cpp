// A calculation that loses its footing stops, says when, where and why, and leaves the last good state.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;
using Catch::Matchers::Contains;

namespace {

// Two bonded spheres that swing against each other, at a step over the stable one.
Model pair(double step_over_stable) {
    const Material material = unbreakable();
    Spheres spheres = two_spheres(0.01);
    spheres.velocity.set(0, Vec3(0.001, 0.0, 0.0));
    std::vector<double> weight;
    Bonds bonds = make_bonds(spheres, {material}, {{0, 1}}, {0, 0}, weight);
    Numerics numerics;
    numerics.refuse_unstable = false;
    numerics.fastest = std::numeric_limits<double>::infinity();
    Model model(spheres, {material}, bonds, weight, Walls{}, numerics);
    numerics.time_step = step_over_stable * model.stable_step();
    return Model(std::move(spheres), {material}, std::move(bonds), std::move(weight), Walls{}, numerics);
}

std::string failure_of(Model& model, int steps, const std::vector<double>& speeds = {}) {
    try {
        for (int k = 0; k < steps; ++k) {
            model.step(speeds, true);
        }
    } catch (const NumericalFailure& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("a step above the critical one is found by the energy that it makes, before anything stops being a number") {
    Model stable = pair(0.9);
    CHECK(failure_of(stable, 20000) == "");
    Model unstable = pair(3.0);
    const std::string what = failure_of(unstable, 20000);
    CHECK_THAT(what, Contains("energy ledger") && Contains("time step above the critical one") && Contains("sphere"));
    CHECK(std::isfinite(unstable.ledger().spent()));
    CHECK(std::isfinite(unstable.spheres.position.x[0]));
}

TEST_CASE("a quantity that is no number, and a sphere that runs away, are named with their place") {
    const Deck deck = small_deck(300);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    bench.model->step({0.0, 0.0}, true);
    SECTION("no number") {
        bench.model->spheres.velocity.y[17] = std::numeric_limits<double>::quiet_NaN();
        const std::string what = failure_of(*bench.model, 1, {0.0, 0.0});
        CHECK_THAT(what, Contains("no number any more") && Contains(" of 300 spheres") && Contains("at step 1 "));
    }
    SECTION("runs away") {
        bench.model->spheres.velocity.z[5] = 1e9;
        const std::string what = failure_of(*bench.model, 1, {0.0, 0.0});
        CHECK_THAT(what, Contains("sphere 5 ") && Contains("at ("));
    }
}

TEST_CASE("a test whose calculation fails keeps the last good state, which another goes on from") {
    const TemporaryFolder folder;
    const std::string file = folder.file("kept.h5");
    const Deck deck = small_deck(300, R"({"output": {"fields": 0, "samples": 60}})");
    const Specimen specimen = make_specimen(deck.specimen);
    TestHooks hooks;
    hooks.progress = [](const TestData&, double) {};
    hooks.fields = [] {};
    hooks.interrupted = [] { return false; };
    Bench whole = set_up(deck, specimen);
    const TestData good = run_protocol(deck, whole, hooks);

    Bench failing = set_up(deck, specimen);
    TestHooks spoilt = hooks;
    int looks = 0;
    spoilt.keep = [&](const VisitState& state, bool) {
        save_checkpoint(file, "a test", state);
        if (++looks == 15) { // between a look and the next
            failing.model->spheres.velocity.x[7] = std::numeric_limits<double>::quiet_NaN();
        }
    };
    const TestData bad = run_protocol(deck, failing, spoilt);
    CHECK_THAT(bad.failure, Contains("sphere") && Contains("probable cause"));
    CHECK_THAT(bad.stopped_by, Contains("the calculation failed"));
    CHECK(looks == 15);

    Bench resumed = set_up(deck, specimen);
    TestHooks going_on = hooks;
    going_on.restore = [&](const VisitState& state) { load_checkpoint(file, "a test", state); };
    const TestData again = run_protocol(deck, resumed, going_on);
    CHECK(again.curve.rows == good.curve.rows);
    CHECK(resumed.model->state_hash() == whole.model->state_hash());
}
