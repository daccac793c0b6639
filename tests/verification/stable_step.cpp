// The bound on the stable step of whole specimens.
#include <catch2/catch.hpp>

#include <cmath>

#include "core/motion/stable_step.hpp"
#include "core/statics/bond_network.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("stable-step: the bound on a specimen lies below the power iteration's limit and near it") {
    const Deck deck = small_deck(1500);
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Model& m = *bench.model;
    const double critical = 2.0 / std::sqrt(largest_eigenvalue(m.spheres, m.bonds, 2000));
    Contacts none;
    none.incidence = make_incidence(m.spheres.size(), {}, {});
    const double bound = StepBound(m.spheres, m.bonds).limit({m.spheres, m.bonds, none, Walls(), Clusters()});
    CHECK(bound <= critical * (1 + 1e-6));
    CHECK(bound >= 0.9 * critical);
    CHECK(m.stable_step() <= bound);
    CHECK(m.dt() == Approx(0.9 * m.stable_step()));
}

TEST_CASE("step: a user's step above the stable one is refused with both numbers") {
    const Deck deck = small_deck(300, R"({"numerics": {"time_step": "20 us"}})");
    try {
        set_up(deck, make_specimen(deck.specimen));
        FAIL("accepted");
    } catch (const input::InputError& e) {
        REQUIRE(e.problems.size() == 1);
        CHECK(e.problems[0].path == "/numerics/time_step");
        CHECK(e.problems[0].found == "20 us");
        CHECK(e.problems[0].expected.find("stable step of") != std::string::npos);
    }
}
