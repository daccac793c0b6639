#include <catch2/catch.hpp>

#include <cmath>

#include <algorithm>

#include "lab/deck.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;
using input::Json;

namespace {

bool has(const input::Problems& problems, const std::string& path) {
    return std::any_of(problems.begin(), problems.end(), [&](const auto& p) { return p.path == path; });
}

} // namespace

TEST_CASE("JSON: keys that stand twice, each at its place, and levels without end") {
    const auto problems_of = [](const std::string& text) {
        try {
            (void)input::parse_json(text, "a.json");
        } catch (const input::InputError& e) {
            return e.problems;
        }
        return input::Problems();
    };
    CHECK(problems_of(R"({"a": [{"b": 1}, {"b": 2}], "b": {"a": 1}})").empty());
    const auto twice = problems_of(R"({"a": 1, "list": [0, [], {"b": 1, "c": {}, "b": 2}], "a": {"d": 0, "d": 0}})");
    REQUIRE(twice.size() == 3);
    CHECK(twice[0].path == "/list/2/b");
    CHECK(twice[1].path == "/a");
    CHECK(twice[2].path == "/a/d");
    std::string many = R"({")" + std::string(20000, 'k') + R"(": {"a": 0)";
    for (int k = 0; k < 15000; ++k) {
        many += R"(, "a": 0)";
    }
    const auto first = problems_of(many + "}}");
    CHECK(first.size() == 50);
    CHECK(first[0].path.size() < 200);
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    CHECK_THAT(problems_of(deep).at(0).found, Catch::Contains("64 nested levels"));
    input::Json deck = {{"test", "ucs"}};
    CHECK_THROWS_AS(apply_settings(deck, {"title=" + deep}), input::InputError);
    CHECK_THROWS_AS(apply_settings(deck, {"title=\xff"}), input::InputError);
    CHECK_THROWS_AS(apply_settings(deck, {R"(loading={"rate": 1, "rate": 2})"}), input::InputError);
    apply_settings(deck, {"title=[draft] 1"});
    CHECK(deck["title"] == "[draft] 1");
}

TEST_CASE("the smallest deck is complete and gets every default") {
    const Deck deck = read_deck(Json::parse(R"({"test": "ucs"})"), "deck.json");
    CHECK(deck.specimen.spheres == 13500);
    CHECK(deck.specimen.diameter == 0.15);
    CHECK(deck.material.values.name == "concrete_sfer");
    CHECK(deck.bonding.interaction_range.word == "auto");
}

TEST_CASE("all problems of a deck are reported at once, each with its path") {
    const auto problems = problems_of(R"({"test": "ucs", "specimen": {"diameter": "-3 mm", "sphere": 100, "seed": 1.5},
        "material": {"card": "concrete_sferr", "tau_f": "16 parsec", "lcs": [3, 2, 1]},
        "loading": {"rate": 0, "confining_pressure": "30 MPa", "platen_friction": "sticky"}, "output": [], "color": "red"})");
    for (const char* path :
         {"/specimen/diameter", "/specimen/sphere", "/specimen/seed", "/material/card", "/material/tau_f", "/material/lcs", "/loading/rate",
          "/loading/confining_pressure", "/loading/platen_friction", "/output", "/color"}) {
        INFO(path);
        CHECK(has(problems, path));
    }
    CHECK(problems.size() == 12); // two of them on the LCS
    const auto key = std::find_if(problems.begin(), problems.end(), [](const auto& p) { return p.path == "/specimen/sphere"; });
    CHECK(key->suggestion == "did you mean \"spheres\"?");
    const auto card = std::find_if(problems.begin(), problems.end(), [](const auto& p) { return p.path == "/material/card"; });
    CHECK(card->suggestion == "did you mean \"concrete_sfer\"?");
}

TEST_CASE("a key that another choice has a use for says so, and which choice there is") {
    const auto problems = problems_of(R"({"test": "granular-triaxial", "specimen": {"particles": {"form": "sphere", "forms": 3}}})");
    REQUIRE(has(problems, "/specimen/particles/forms"));
    const auto key = std::find_if(problems.begin(), problems.end(), [](const auto& p) { return p.path == "/specimen/particles/forms"; });
    CHECK(key->found.find("nothing looks at with \"form\": \"sphere\"") != std::string::npos);
}

TEST_CASE("sizes of another shape, regions outside and steps that nothing could be stable with are refused") {
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"width": 0.15}})"), "/specimen/width"));
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"shape": "prism", "diameter": 0.15}})"), "/specimen/diameter"));
    CHECK(has(problems_of(R"({"test": "ucs", "numerics": {"time_step": "1e-12 s"}})"), "/numerics/time_step"));
    CHECK(has(problems_of(R"({"test": "ucs", "regions": [{"from": [-1, -1, 0], "to": [1, 1, 1], "material": {}}]})"), "/regions/0"));
    const auto shape = problems_of(R"({"test": "ucs", "specimen": {"shape": "cube", "width": 0.1, "side": 0.1}})");
    CHECK(has(shape, "/specimen/shape"));
    CHECK(has(shape, "/specimen/side"));
    CHECK(shape.size() == 2); // which shape's key the width is, nobody knows
    const auto card = problems_of(R"({"test": "ucs", "material": {"card": "concrete_sfr", "tensile_strength": "2 MPaa"}})");
    REQUIRE(!card.empty());
    CHECK(
        std::none_of(card.begin(), card.end(), [](const auto& p) { return p.suggestion.find("this card has law") != std::string::npos; }));
    const auto both = problems_of(R"({"test": "ucs", "regions": [{"from": [1, 1, 1], "to": [2, 2, 2], "group": 1}],
        "numerics": {"time_step": "1 ms"}})");
    CHECK(has(both, "/regions/0"));
    CHECK(has(both, "/numerics/time_step"));
}

TEST_CASE("a stored specimen leaves nothing to set but the seed of strengths, which a manifest keeps") {
    const auto beside = problems_of(R"({"test": "ucs", "specimen": {"file": "s.h5", "spheres": 500, "seed": 3, "sphere": 2}})");
    CHECK(beside.size() == 2);
    CHECK(has(beside, "/specimen/spheres"));
    CHECK(has(beside, "/specimen/sphere"));
    Json json = Json::parse(R"({"test": "ucs", "specimen": {"file": "s.h5", "seed": 3}})");
    CHECK_FALSE(resolved(read_deck(json, "deck.json"))["specimen"].contains("seed"));
    json["regions"] = Json::parse(R"([{"from": [-1, -1, 0], "to": [1, 1, 1], "material": {"weibull_modulus": 8}}])");
    CHECK(resolved(read_deck(json, "deck.json"))["specimen"]["seed"] == 3);
}

TEST_CASE("a region's material begins as the deck's, and a region has to differ") {
    const Deck deck = read_deck(Json::parse(R"({"test": "ucs", "material": {"card": "custom", "density": 2100}, "regions": [
        {"from": [-1, -1, 0], "to": [1, 1, 1], "group": 1},
        {"from": [-1, -1, 0], "to": [1, 1, 1], "material": {"young_modulus": "9 GPa"}},
        {"from": [-1, -1, 0], "to": [1, 1, 1], "material": {"card": "concrete_dempack"}}]})"),
                                "deck.json");
    CHECK(deck.regions[0].material.values.density == 2100.0);
    CHECK(deck.regions[1].material.values.density == 2100.0);
    CHECK(deck.regions[1].material.values.young_modulus == 9e9);
    CHECK(deck.regions[2].material.values.name == "concrete_dempack");
    CHECK(has(problems_of(R"({"test": "ucs", "regions": [{"from": [-1, -1, 0], "to": [1, 1, 1]}]})"), "/regions/0"));
}

TEST_CASE("loose contacts, schemes and damping: wrong words and bounds are named") {
    const auto problems = problems_of(R"({"test": "ucs", "material": {"contact_law": "hertzian", "restitution_rule": "tsuji",
        "rolling_friction": -0.1, "contact_restitution": 0}, "numerics": {"scheme": "verlet", "damping": "none", "damping_rotation": -1}})");
    for (const char* path : {"/material/contact_law", "/material/restitution_rule", "/material/rolling_friction",
                             "/material/contact_restitution", "/numerics/scheme", "/numerics/damping", "/numerics/damping_rotation"}) {
        INFO(path);
        CHECK(has(problems, path));
    }
    CHECK(problems.size() == 7);
    CHECK(has(problems_of(R"({"test": "ucs", "numerics": {"damping_translation": 1.0}})"), "/numerics/damping_translation"));
    CHECK(problems_of(R"({"test": "ucs", "numerics": {"damping": "viscous", "damping_translation": 1000}})").empty());
    const Deck deck =
        read_deck(Json::parse(R"({"test": "ucs", "material": {"contact_law": "hertz", "rolling_friction": 0.1}})"), "deck.json");
    const Material m = to_material(deck.material.values);
    CHECK(m.contact_law == ContactLaw::hertz);
    CHECK(m.restitution_rule == RestitutionRule::corrected);
    CHECK(m.rolling_friction == 0.1);
}

TEST_CASE("impossible recipes are refused before any sphere is made") {
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"spheres": 1}})"), "/specimen/spheres"));
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"spheres": 1000000000}})"), "/specimen/spheres"));
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"spheres": 2, "diameter": "1 mm"}})"), "/specimen/spheres"));
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"radius_deviation": 0.5, "smallest_radius": 0.9, "largest_radius": 1.1}})"),
              "/specimen/radius_deviation"));
    CHECK(has(problems_of(R"({"test": "ucs", "specimen": {"grading": [{"diameter": "2 mm", "passing": 0.5}]}})"), "/specimen/grading/0"));
    CHECK(has(problems_of(R"({"specimen": {}})"), "/test"));
    CHECK(has(problems_of(R"({"test": "usc"})"), "/test"));
}

TEST_CASE("the resolved deck reads back as itself") {
    Json json = Json::parse(R"({"test": "ucs", "material": {"card": "concrete_dempack", "sigma_f": "3 MPa"}, "specimen": {"spheres": 50},
        "regions": [{"from": [0, 0, 0], "to": [1, 1, "10 mm"], "group": 2, "material": {"card": "concrete_dempack", "tau_f": 1e6}}],
        "loading": {"platen_friction": "glued", "ramp": "1 ms"}})");
    const Json once = resolved(read_deck(json, "deck.json"));
    const Json twice = resolved(read_deck(once, "deck.json"));
    CHECK(once == twice);
    CHECK(once["material"]["sigma_f"] == 3e6);
    CHECK(once["regions"][0]["material"]["tau_f"] == 1e6);
    CHECK(once["loading"]["platen_friction"] == "glued");
    CHECK(once["loading"]["ramp"] == 1e-3);
}

TEST_CASE("whole numbers end with 64 bits, however they are written") {
    const auto seed = [](const std::string& text) { return R"({"test": "ucs", "specimen": {"seed": )" + text + "}}"; };
    CHECK(problems_of(seed("9223372036854774784.0")).empty());
    for (const char* text : {"9223372036854775808", "9223372036854775808.0", "18446744073709551615", "1e300", "-1"}) {
        CHECK(has(problems_of(seed(text)), "/specimen/seed"));
    }
}

TEST_CASE("settings from the command line change one value") {
    Json json = Json::parse(R"({"test": "ucs"})");
    apply_settings(json, {"loading.rate=0.1", "material.card=concrete_dempack", "output.fields=0"});
    CHECK(json["loading"]["rate"] == 0.1);
    CHECK(json["material"]["card"] == "concrete_dempack");
    CHECK_THROWS_AS(apply_settings(json, {"rate"}), input::InputError);
    CHECK_THROWS_AS(apply_settings(json, {"test.x=1"}), input::InputError);
}

TEST_CASE("the presets beside the default carry the law they are named after") {
    const auto material = [](const std::string& text) { return to_material(read_deck(Json::parse(text), "deck.json").material.values); };
    const auto law_of = [](const Material& m) { return std::get<Dempack::Constants>(bond_group(m).law); };
    const Material released = material(R"({"test": "ucs", "material": {"card": "dempack-released"}})");
    CHECK(std::holds_alternative<KratosDempack::Parameters>(released.bond));
    CHECK(released.area_rule == AreaRule::minimum_radius);
    const Material thesis = material(R"({"test": "ucs", "material": {"card": "thesis"}})");
    CHECK(thesis.as<Dempack>().sigma_f == 5e6);
    CHECK(thesis.local_damping == 0.9);
    const Material tough = material(
        R"({"test": "ucs", "material": {"card": "custom", "fracture_energy_tension": 100, "fracture_energy_shear": 0, "sigma_f": "4 MPa", "strength_factor": 1}})");
    CHECK(law_of(tough).opening_f == Approx(2.0 * 100 / 4e6));
    CHECK(law_of(tough).slip_f == 0.0);
    const Material sheared = material(
        R"({"test": "ucs", "material": {"card": "custom", "fracture_energy_tension": 0, "fracture_energy_shear": 900, "tau_f": "15 MPa", "strength_factor": 1}})");
    CHECK(law_of(sheared).opening_f == 0.0);
    CHECK(law_of(sheared).slip_f == Approx(2.0 * 900 / 15e6));
    const Material averaged =
        material(R"({"test": "ucs", "material": {"card": "thesis", "criterion": "rankine", "sigma_f": "4 MPa", "strength_factor": 1}})");
    CHECK(bond_group(averaged).criterion.sigma_f == 4e6);
    CHECK(std::isinf(law_of(averaged).sigma_f));
}

TEST_CASE("a law has its own keys: those of another are refused by name, and a card changed to another law starts from its defaults") {
    const auto problems = problems_of(R"({"test": "ucs", "material": {"sigma_f": "3 MPa", "lcs": [1, 2, 3]}})");
    REQUIRE(problems.size() == 2);
    CHECK(problems[0].text().find("it belongs to law dempack, kratos_dempack; this card has law \"facet\"") != std::string::npos);
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"law": "dempack_released"}})"), "/material/law"));
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"criterion": "rankine"}})"), "/material/criterion"));
    const Deck deck = read_deck(Json::parse(R"({"test": "ucs", "material": {"law": "dempack", "tau_f": "9 MPa"}})"), "deck.json");
    const Material m = to_material(deck.material.values);
    CHECK(m.as<Dempack>().tau_f == 9e6);
    CHECK(m.as<Dempack>().sigma_f == 5e6);
    const Json again = resolved(deck);
    CHECK_FALSE(again["material"].contains("tensile_strength"));
    CHECK(read_deck(again, "again.json").material.values.law == "dempack");
    const Material facets =
        to_material(read_deck(Json::parse(R"({"test": "ucs", "material": {"strength_factor": 2}})"), "d").material.values);
    CHECK(facets.as<Facet>().sigma_t == Approx(2.0 * 2.6e6));
    CHECK(facets.as<Facet>().sigma_c0 == Approx(2.0 * 32e6));
    CHECK(facets.as<Facet>().shear_ratio_t == Approx(6.25));
}

TEST_CASE("a pair of materials: weaker and shorter of two facet laws, the first of two different laws") {
    Material a;
    Material b;
    a.bond = Facet::Parameters{};
    auto weak = Facet::Parameters{};
    weak.sigma_t = 1e6;
    weak.exponent = 2.0;
    weak.first_length = 0.0;
    b.bond = weak;
    for (const Material& m : {equivalent(a, b), equivalent(b, a)}) {
        CHECK(m.as<Facet>().sigma_t == 1e6);
        CHECK(m.as<Facet>().exponent == Approx(0.5 * (2.0 + Facet::Parameters{}.exponent)));
        CHECK(m.as<Facet>().first_length == 0.0);
    }
    const Material old;
    CHECK(std::holds_alternative<Dempack::Parameters>(equivalent(a, old).bond));
    CHECK(std::holds_alternative<Dempack::Parameters>(equivalent(old, a).bond));
}

TEST_CASE("laws that do not go together are refused, each with its place") {
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"card": "dempack-released", "criterion": "rankine"}})"), "/material/criterion"));
    CHECK(
        has(problems_of(R"({"test": "ucs", "material": {"card": "dempack-released", "bending_factor": 1}})"), "/material/bending_factor"));
    CHECK(
        has(problems_of(R"({"test": "ucs", "material": {"card": "custom", "criterion": "mohr_coulomb", "fracture_energy_tension": 100}})"),
            "/material/criterion"));
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"card": "custom", "criterion": "mohr-coulomb"}})"), "/material/criterion"));
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"card": "dempack-released", "plastic_modulus_ratio": 2}})"),
              "/material/plastic_modulus_ratio"));
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"normal_factor": 1.4}})"), "/material/normal_factor"));
    CHECK(has(problems_of(R"({"test": "ucs", "material": {"poisson_ratio": 0.495}})"), "/material/poisson_ratio"));
    CHECK(problems_of(R"({"test": "ucs", "material": {"elasticity": "as-given", "averaged_factor": 1, "poisson_ratio": 0.495}})").empty());
}
