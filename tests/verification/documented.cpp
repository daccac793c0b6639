// The test of docs/adding-a-test.md, which is compiled as it stands there.
#include <catch2/catch.hpp>

#include "lab/test_run.hpp"
#include "tests/support.hpp"

namespace proveta {
std::unique_ptr<Protocol> make_relaxation();
}

using namespace proveta;

TEST_CASE("the documentation's new test: an elastic specimen loses nothing when the platens stop, one that cracks does") {
    Deck deck = testing::small_deck(500, R"({"output": {"fields": 0}})");
    const Specimen specimen = make_specimen(deck.specimen);
    const auto relaxation = [&](double strain) {
        deck.protocol = make_relaxation();
        input::Problems problems;
        input::read(input::Json{{"axial_strain", strain}, {"hold", "0.5 ms"}}, *deck.protocol, "test.json", "/loading", problems);
        CHECK(problems.empty());
        Bench bench = set_up(deck, specimen);
        const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
        CHECK(data.failure == "");
        CHECK(data.stages == std::vector<std::string>{"closing", "hold"});
        const auto results = deck.protocol->results({data.curve, data.energy, data.events, bench.specimen.shape, bench.press});
        CHECK(results.front().value.value() > 0.0);
        return results.back().value.value();
    };
    // What is lost without cracks is what the damping takes from the last waves: a few parts in a hundred.
    CHECK(relaxation(0.0002) < 0.03);
    CHECK(relaxation(0.002) > 0.1);
}
