// A test that leads its own rate against a steady, slow one.
#include <catch2/catch.hpp>

#include <cmath>

#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

struct Tested {
    double strength = 0.0;
    double modulus = 0.0;
    double steps = 0.0;
};

// A brittle material, of which a steady rate spends most of its steps on the way to the peak.
Tested tested(const std::string& more, const Specimen& specimen) {
    input::Json json = input::Json::parse(more);
    json["material"] = verification::brittle_concrete();
    const Deck deck = small_deck(1500, json.dump());
    Bench bench = set_up(deck, specimen);
    const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
    Tested out;
    for (const auto& r : deck.protocol->results({data.curve, data.energy, data.events, bench.specimen.shape, bench.press})) {
        out.strength = r.name == "strength" ? r.value.value() : out.strength;
        out.modulus = r.name == "young_modulus" ? r.value.value() : out.modulus;
    }
    out.steps = static_cast<double>(bench.model->steps());
    return out;
}

} // namespace

TEST_CASE("rate auto: modulus and strength are those of a slow steady rate, in two fifths of the steps with mass scaling") {
    const Specimen specimen = make_specimen(small_deck(1500).specimen);
    const Tested steady = tested(R"({"loading": {"rate": "0.05 m/s"}, "numerics": {"mass_scaling": 0}})", specimen);
    const Tested led = tested(R"({"loading": {"rate": "auto"}, "numerics": {"mass_scaling": 0}})", specimen);
    const Tested scaled = tested(R"({"loading": {"rate": "auto"}, "numerics": {"mass_scaling": 0.02}})", specimen);
    for (const auto& one : {led, scaled}) {
        CHECK(one.modulus == Approx(steady.modulus).epsilon(0.01));
        // Failure is unstable: runs of so few spheres that differ in round-off alone scatter by some percent.
        CHECK(one.strength == Approx(steady.strength).epsilon(0.08));
        CHECK(one.steps < steady.steps);
    }
    CHECK(scaled.steps < 0.6 * led.steps);
    CHECK(scaled.steps < 0.4 * steady.steps);
}
