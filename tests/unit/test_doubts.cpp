#include <catch2/catch.hpp>

#include <algorithm>

#include "lab/deck_doubts.hpp"
#include "lab/doubts.hpp"
#include "lab/protocols/registry.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

bool speaks_of(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A loading in the stresses given, Pa, a thousandth of strain apart, as a test's curve; phases: of the rows, 1 everywhere when empty.
report::Table curve_of(const std::vector<double>& stress, const std::vector<double>& phases = {}) {
    report::Table t;
    t.columns = {{"time", "s", ""},
                 {"axial_strain", "", ""},
                 {"gauge_axial_strain", "", ""},
                 {"axial_stress", "Pa", ""},
                 {"deviatoric_stress", "Pa", ""},
                 {"circumferential_strain", "", ""},
                 {"stage", "", ""},
                 {"phase", "", ""},
                 {"volumetric_strain", "", ""}};
    double strain = 0.0;
    double stage = 0.0;
    for (std::size_t k = 0; k < stress.size(); ++k) {
        const double phase = phases.empty() ? phase_loading : phases[k];
        stage += k > 0 && phase != (phases.empty() ? phase_loading : phases[k - 1]) ? 1.0 : 0.0;
        strain += phase == phase_cycling ? -1e-3 : 1e-3;
        t.rows.push_back({static_cast<double>(k), strain, strain, stress[k], stress[k], 0.0, stage, phase, 0.0});
    }
    return t;
}

// An energy ledger of n rows in which a share of the work is lost from row `from` on.
report::Table energy_of(std::size_t n, std::size_t from) {
    report::Table t;
    t.columns = {{"platens", "J", ""}, {"pressure", "J", ""}, {"damage", "J", ""}, {"plastic", "J", ""}, {"friction", "J", ""}};
    for (std::size_t k = 0; k < n; ++k) {
        t.rows.push_back({1.0 + static_cast<double>(k), 0.0, k >= from ? 0.5 : 0.0, 0.0, 0.0});
    }
    return t;
}

FailureEvent failure(double time, FailureMode mode, const Vec3& at = Vec3::Zero(), double area = 1e-4) {
    return {time, 0.0, at, mode, 1e-3, area};
}

std::vector<std::string> of_deck(const std::string& material) {
    return doubts_of(read_deck(input::Json::parse(R"({"test": "ucs", "material": )" + material + "}"), "deck.json"));
}

} // namespace

TEST_CASE("platens on nine spheres or fewer are said, with the counts") {
    CHECK(few_at_platens({10, 40}).empty());
    CHECK(speaks_of(few_at_platens({9, 40}), "touch 9 and 40 spheres"));
    CHECK(speaks_of(few_at_platens({10, 1}), "touch 10 and 1 spheres"));
}

TEST_CASE("a network unlike that of the program's cards is said; cards of users are of any") {
    Card card;
    card.status = "calibrated";
    CHECK(unlike_the_cards(card, 10.9, false).empty());
    CHECK(unlike_the_cards(card, 5.2, true).empty());
    CHECK(speaks_of(unlike_the_cards(card, 8.0, false), "8.0 bonds a sphere, where the card's strengths hold for 10.0"));
    CHECK(speaks_of(unlike_the_cards(card, 8.0, false), "lower"));
    CHECK(speaks_of(unlike_the_cards(card, 12.0, false), "higher"));
    card.status = "user";
    CHECK(unlike_the_cards(card, 8.0, false).empty());
}

TEST_CASE("a peak that is passed and left behind by a later one is said, a mere dip or fall is not") {
    const auto of = [](const std::vector<double>& stress) { return recovered_peak(loading_of(curve_of(stress), 1.0)); };
    CHECK(of({1e6, 10e6, 20e6, 12e6, 4e6}).empty());
    CHECK(of({1e6, 10e6, 20e6, 19.5e6, 22e6, 4e6}).empty());
    const auto found = of({1e6, 10e6, 20e6, 15e6, 18e6, 24e6, 26e6, 5e6});
    CHECK(speaks_of(found, "peak of 20 MPa by 25 %"));
    CHECK(speaks_of(found, "to 26 MPa"));
}

TEST_CASE("bonds that fail while a specimen is unloaded are said, with their share and the cycle") {
    const auto curve = curve_of({1e6, 2e6, 1e6, 0.5e6, 3e6, 4e6, 2e6, 1e6, 5e6}, {1, 1, 2, 2, 1, 1, 2, 2, 1});
    std::vector<FailureEvent> events;
    for (const double time : {0.5, 3.5, 6.5, 6.6, 6.9, 8.0}) { // three of them in the second unloading
        events.push_back(failure(time, FailureMode::tension));
    }
    CHECK(broken_by_unloading(curve, events, 1000, 1.0).empty());
    const auto found = broken_by_unloading(curve, events, 100, 1.0);
    CHECK(speaks_of(found, "3.0 % of all bonds"));
    CHECK(speaks_of(found, "cycle 2"));
    CHECK(broken_by_unloading(curve_of({1e6, 2e6, 1e6}), events, 100, 1.0).empty());
}

TEST_CASE("a modulus off the card's is said with both figures, and why where its range is no longer elastic") {
    const auto curve = curve_of({10e6, 20e6, 30e6, 40e6, 20e6});
    const auto elastic = energy_of(5, 4);
    const auto lossy = energy_of(5, 0);
    const Shape shape;
    const Press press;
    const std::vector<FailureEvent> none;
    Card card; // calibrated, 28 GPa
    const auto of = [&](double modulus, const report::Table& energy) {
        return modulus_off(card, {{"young_modulus", "E", modulus, "Pa", ""}}, {curve, energy, none, shape, press});
    };
    CHECK(of(30e9, elastic).empty());
    CHECK(speaks_of(of(20e9, elastic), "20 GPa"));
    CHECK(speaks_of(of(20e9, elastic), "28 GPa (-29 %)."));
    CHECK(speaks_of(of(20e9, lossy), "no longer elastic"));
    const auto stiff = modulus_off(card, {{"young_modulus", "E", {}, "Pa", ""}, {"young_modulus_platens", "E", 56e12, "Pa", ""}},
                                   {curve, elastic, none, shape, press});
    CHECK(speaks_of(stiff, "56000 GPa"));
    CHECK(speaks_of(modulus_off(card, {{"young_modulus", "E", {}, "Pa", ""}}, {curve, elastic, none, shape, press}),
                    "could not be measured"));
    CHECK(modulus_off(card, {}, {curve, elastic, none, shape, press}).empty()); // a test that does not ask for it
    card.elasticity = "as-given";                                               // the bonds' modulus and not the specimen's
    CHECK(of(20e9, elastic).empty());
}

TEST_CASE("a disc that is crushed under its strips is told from one that splits") {
    const auto test = make_protocol("brazilian");
    const auto curve = curve_of({1e6, 2e6, 3e6, 2e6, 1.4e6});
    const auto energy = energy_of(5, 5);
    Shape shape;
    shape.diameter = 0.1;
    shape.height = 0.05;
    const Press press;
    const auto of = [&](const std::vector<FailureEvent>& events) { return test->doubts({curve, energy, events, shape, press}); };
    std::vector<FailureEvent> split;
    std::vector<FailureEvent> crushed;
    std::vector<FailureEvent> sheared;
    for (int k = 0; k < 50; ++k) { // 50 cm2 along the loaded plane, of which half lies in its middle half
        const double x = -0.049 + 0.002 * k;
        split.push_back(failure(3.0, FailureMode::tension, Vec3(x, 0.001, 0.02)));
        crushed.push_back(failure(3.0, FailureMode::tension, Vec3(x > 0.0 ? 0.045 : -0.045, 0.001, 0.02)));
        sheared.push_back(failure(3.0, k % 4 == 0 ? FailureMode::tension : FailureMode::shear, Vec3(x, 0.001, 0.02), 2e-4));
    }
    CHECK(of(split).empty());
    REQUIRE(of(crushed).size() == 1);
    CHECK(speaks_of(of(crushed)[0], "make up 0 % of the loaded plane"));
    CHECK(speaks_of(of(crushed)[0], "100 % of the cracked area lies next to the platens"));
    REQUIRE(of(sheared).size() == 1);
    CHECK(speaks_of(of(sheared)[0], "74 % of the cracked area failed in shear"));
    CHECK(of({}).empty());
}

TEST_CASE("a modulus that cannot be one is refused with the unit it lacks") {
    const auto problems = problems_of(R"({"test": "ucs", "material": {"card": "concrete_sfer", "young_modulus": 28}})");
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].path == "/material/young_modulus");
    CHECK(speaks_of(problems[0].found, "28 Pa, far below tensile_strength = 2.6 MPa"));
    CHECK(problems[0].suggestion == "did you mean \"28 GPa\"?");
}

TEST_CASE("values of a deck that are likely to lack their unit are doubted, those of every example are not") {
    CHECK(of_deck("{}").empty());
    CHECK(of_deck(R"({"young_modulus": "35 GPa", "tensile_strength": "4 MPa", "compressive_yield_strength": "60 MPa"})").empty());
    const auto low = of_deck(R"({"tensile_strength": 2.6})");
    REQUIRE(low.size() == 2); // and its ratio to the modulus
    CHECK(low[0] == "/material/tensile_strength: 2.6 Pa is likely to lack its unit: \"2.6 MPa\"?");
    CHECK(speaks_of(low[1], "1.1e+10 times tensile_strength = 2.6 Pa"));
    const auto mega = of_deck(R"({"young_modulus": "28 MPa"})");
    REQUIRE(mega.size() == 1);
    CHECK(speaks_of(mega[0], "/material/young_modulus: 28 MPa is below transitional_stress = 600 MPa"));
    const auto stiff = of_deck(R"({"young_modulus": 1e16})");
    REQUIRE(stiff.size() == 1);
    CHECK(speaks_of(stiff[0], "in another unit"));
    const auto light = of_deck(R"({"density": 2.5})");
    REQUIRE(light.size() == 1);
    CHECK(speaks_of(light[0], "\"2.5 g/cm3\"?"));
    const auto strong = of_deck(R"({"tensile_strength": "2.8 GPa"})");
    REQUIRE(strong.size() == 1);
    CHECK(speaks_of(strong[0], "is only 10 times tensile_strength"));
    const auto far = doubts_of(read_deck(input::Json::parse(R"({"test": "triaxial",
        "loading": {"confining_pressure": "4.5 GPa", "stop": {"axial_strain": 0.5}}})"),
                                         "deck.json"));
    REQUIRE(far.size() == 2);
    CHECK(speaks_of(far[0], "/loading/confining_pressure: 4.5 GPa is 0.16 of /material/young_modulus"));
    CHECK(speaks_of(far[1], "/loading/stop/axial_strain: 0.5 is 50 %: is \"0.5 %\" meant?"));
    const auto deck = read_deck(input::Json::parse(R"({"test": "triaxial", "specimen": {"diameter": 50, "height": 100},
        "loading": {"confining_pressure": 4.5}})"),
                                "deck.json");
    const auto all = doubts_of(deck);
    REQUIRE(all.size() == 3);
    CHECK(speaks_of(all[0], "/specimen/diameter: 50 m is likely to lack its unit: \"50 mm\"?"));
    CHECK(speaks_of(all[2], "/loading/confining_pressure: 4.5 Pa is likely to lack its unit: \"4.5 MPa\"?"));
}
