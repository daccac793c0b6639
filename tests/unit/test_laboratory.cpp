// Decks of every test, shared arithmetic of the protocols, faces of platens.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "core/boundaries/platen.hpp"
#include "lab/axial_results.hpp"
#include "lab/deck.hpp"
#include "lab/derived.hpp"
#include "lab/progress.hpp"
#include "lab/protocols/registry.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

bool refuses(const std::string& text, const std::string& path, const std::string& saying) {
    for (const auto& p : problems_of(text)) {
        if (p.path == path && p.text().find(saying) != std::string::npos) {
            return true;
        }
    }
    return false;
}

} // namespace

TEST_CASE("every test has a name, a standard, plots, and a smallest deck that is complete") {
    CHECK(test_names() ==
          std::vector<std::string>{"ucs", "triaxial", "brazilian", "oedometric", "hydrostatic", "direct-tension", "granular-triaxial"});
    for (const auto& name : test_names()) {
        const Deck deck = read_deck({{"test", name}}, "deck.json");
        CHECK_FALSE(deck.protocol->about().standards.empty());
        CHECK_FALSE(deck.protocol->plots().empty());
        CHECK(read_deck(resolved(deck), "again.json").test == name);
    }
}

TEST_CASE("a splitting test is made on its standard's disc unless the deck says otherwise") {
    const Deck disc = read_deck({{"test", "brazilian"}}, "deck.json");
    CHECK(disc.specimen.shape == "disc");
    CHECK(disc.specimen.height == 0.09);
    CHECK(disc.specimen.spheres == 16000);
    CHECK(read_deck({{"test", "brazilian"}, {"specimen", {{"height", 0.05}}}}, "deck.json").specimen.height == 0.05);
}

TEST_CASE("tests refuse what does not belong to them, with the reason") {
    CHECK(refuses(R"({"test": "direct-tension", "loading": {"confining_pressure": 1e6}})", "/loading/confining_pressure", "triaxial"));
    CHECK(refuses(R"({"test": "direct-tension", "loading": {"platen_friction": 0.3}})", "/loading/platen_friction", "glued"));
    CHECK(refuses(R"({"test": "ucs", "loading": {"strips": 0.1}})", "/loading/strips", "brazilian"));
    CHECK(refuses(R"({"test": "hydrostatic", "loading": {"rate": 0.1}})", "/loading/rate", "ramp"));
    CHECK(refuses(R"({"test": "oedometric", "loading": {"ring_diameter": "140 mm"}})", "/loading/ring_diameter", "diameter of 15 cm"));
    CHECK(refuses(R"({"test": "oedometric", "loading": {"confining_pressure": 1e6}})", "/loading/confining_pressure", "ring"));
    CHECK(refuses(R"({"test": "triaxial", "loading": {"confining_pressure": "60 MPa", "pressure_ramp": "10 us"}})",
                  "/loading/pressure_ramp", "beyond the limit"));
    CHECK(refuses(R"({"test": "hydrostatic", "loading": {"pressure": "60 MPa", "ramp": "10 us"}})", "/loading/ramp", "beyond the limit"));
    CHECK(refuses(R"({"test": "triaxial", "specimen": {"shape": "plate", "spheres": 500}})", "/specimen/shape", "plate"));
    CHECK(refuses(R"({"test": "brazilian", "specimen": {"shape": "prism"}})", "/specimen/shape", "round"));
    CHECK(refuses(R"({"test": "ucs", "loading": {"cycles": [{"axial_strain": 0.001}, {"axial_strain": 0.0005}]}})",
                  "/loading/cycles/1/axial_strain", "ascending"));
    CHECK(refuses(R"({"test": "ucs", "loading": {"cycles": [{"axial_strain": 0.01}]}})", "/loading/cycles/0/axial_strain", "ends"));
    CHECK(refuses(R"({"test": "ucs", "loading": {"cycles": [{"unload_to": 0.5}]}})", "/loading/cycles/0", "neither"));
    CHECK(problems_of(R"({"test": "ucs", "loading": {"cycles": [{"axial_strain": 0.001}, {"axial_stress": "20 MPa"}]}})").empty());
}

TEST_CASE("a point on the elastic line, its yield by offset, and values between samples") {
    const std::vector<double> x{0, 1, 2, 3, 4, 5};
    const std::vector<double> y{0, 10, 20, 25, 27, 28};
    const auto line = line_between(x, y, 0.0, 0.5);
    REQUIRE(line);
    CHECK(line->slope == Approx(10.0));
    CHECK(offset_yield(x, y, *line, 0.6).value() == 27.0); // at 3 the shifted line asks for 24, at 4 for 34
    CHECK_FALSE(offset_yield(x, y, *line, 10.0));
    CHECK(y_at(x, y, 2.5).value() == Approx(22.5));
    CHECK_FALSE(y_at(x, y, 6.0));
}

TEST_CASE("the loading is what is neither preparation nor cycle, counted from where it began, in the sense of the test") {
    report::Table t;
    for (const char* name : {"phase", "axial_strain", "gauge_axial_strain", "circumferential_strain", "volumetric_strain", "axial_stress",
                             "deviatoric_stress"}) {
        t.columns.push_back({name, "", ""});
    }
    const auto row = [&](double phase, double v) { t.rows.push_back({phase, v, 2 * v, 3 * v, 4 * v, 5 * v, 6 * v}); };
    row(phase_preparing, -1.0);
    row(phase_preparing, -2.0);
    row(phase_loading, -3.0);
    row(phase_cycling, -1.5);
    row(phase_loading, -4.0);
    const Loading l = loading_of(t, -1.0);
    CHECK(l.row == std::vector<std::size_t>{2, 4});
    CHECK(l.strain == std::vector<double>{1.0, 2.0});
    CHECK(l.volume == std::vector<double>{4.0, 8.0});
    CHECK(l.stress == std::vector<double>{15.0, 20.0}); // stresses are total
    CHECK(l.deviator == std::vector<double>{18.0, 24.0});
}

TEST_CASE("the time that is left is bounded, or said to be unknown while next to nothing is done") {
    CHECK(Progress::left(60.0, 0.5).starts_with("at most 1 min"));
    CHECK(Progress::left(60.0, 1e-12).starts_with("time left unknown"));
    CHECK(Progress::left(60.0, 0.0).starts_with("time left unknown"));
}

TEST_CASE("faces: distance, normal and width of flat, hollow and ring-shaped surfaces") {
    const Face flat{Vec3::UnitX(), -1.0, 0.0, 0.01};
    auto foot = flat.foot(0.05, {0.03, 0.005, 1.0});
    CHECK(foot.distance == Approx(0.02));
    CHECK((foot.normal - Vec3(-1, 0, 0)).norm() < 1e-15);
    CHECK(flat.reaches(foot, 0.0));
    CHECK_FALSE(flat.reaches(flat.foot(0.05, {0.03, 0.02, 1.0}), 0.0));

    // A jaw of 0.1 m radius whose nearest point is at x = -0.05: its line is at x = 0.05.
    const Face jaw{Vec3::UnitX(), 1.0, 1.0 / 0.1, Face::boundless};
    foot = jaw.foot(-0.05, {0.05 - 0.06, 0.08 * 0.0, 0.3});
    CHECK(foot.distance == Approx(0.04));
    CHECK((foot.normal - Vec3(1, 0, 0)).norm() < 1e-12);
    foot = jaw.foot(-0.05, {0.05, 0.09, 0.3});
    CHECK(foot.distance == Approx(0.01));
    CHECK((foot.normal - Vec3(0, -1, 0)).norm() < 1e-12);

    const Face ring = ring_face(0.2);
    for (const double angle : {0.3, 1.7, 4.0}) {
        foot = ring.foot(-0.2, {0.15 * std::cos(angle), 0.15 * std::sin(angle), 7.0});
        CHECK(foot.distance == Approx(0.05));
        CHECK((foot.normal + Vec3(std::cos(angle), std::sin(angle), 0.0)).norm() < 1e-12);
        CHECK(ring.reaches(foot, 0.0));
    }

    // A strip sees its own side of the cylinder only.
    Face strip{Vec3::UnitX(), 1.0, 1.0 / 0.1, 0.02};
    CHECK(strip.reaches(strip.foot(-0.1, {-0.095, 0.01, 0.0}), 0.005));
    CHECK_FALSE(strip.reaches(strip.foot(-0.1, {0.095, 0.01, 0.0}), 0.005));
    CHECK_FALSE(strip.reaches(strip.foot(-0.1, {-0.095, 0.021, 0.0}), 0.005));
    // At its edges a sphere's breadth counts, up to half of the strip; a face without bounds has no edges.
    strip.edge = 0.5;
    CHECK(strip.reaches(strip.foot(-0.1, {-0.095, 0.0174, 0.0}), 0.005));
    CHECK_FALSE(strip.reaches(strip.foot(-0.1, {-0.095, 0.0176, 0.0}), 0.005));
    CHECK(strip.reaches(strip.foot(-0.1, {-0.095, 0.0099, 0.0}), 0.1));
    CHECK(Face{}.reaches(Face{}.foot(0.0, {5.0, 5.0, 0.1}), 1.0));
}

TEST_CASE("a curve that falls and recovers has its peak where it broke; ripples and falls of 4 % are none") {
    const auto loading = [](std::vector<double> deviator) {
        Loading l;
        l.deviator = std::move(deviator);
        for (std::size_t k = 0; k < l.deviator.size(); ++k) {
            l.row.push_back(k);
            for (auto* of : {&l.strain, &l.gauge, &l.girth, &l.volume, &l.stress}) {
                of->push_back(static_cast<double>(k));
            }
        }
        return l;
    };
    const Loading recovers = until_recovery(loading({0, 50, 100, 92, 96, 110, 150}));
    CHECK(recovers.deviator == std::vector<double>{0, 50, 100, 92, 96});
    CHECK(recovers.strain.size() == 5);
    CHECK(peak_if_passed(recovers.deviator) == 100.0);
    CHECK(until_recovery(loading({0, 50, 100, 96, 120, 130})).deviator.size() == 6);
    CHECK_FALSE(peak_if_passed({0, 50, 100, 96, 120, 130}));
    CHECK(until_recovery(loading({0, 2, 1, 50, 100, 90})).deviator.size() == 6); // the ripple at the start is no peak
    CHECK(peak_if_passed({0, 100, 94, 99}) == 100.0);
    CHECK(until_recovery(loading({})).deviator.empty());
}

TEST_CASE("the elastic part of a loading ends where a hundredth of the work is lost") {
    report::Table energy;
    for (const char* name : {"platens", "pressure", "damage", "plastic", "friction"}) {
        energy.columns.push_back({name, "J", ""});
    }
    energy.rows = {{0, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {6, 4, 0.05, 0.02, 0.02}, {15, 5, 0.1, 0.2, 0.1}, {30, 10, 0.1, 0.2, 0.0}};
    Loading l;
    l.row = {0, 1, 2, 3, 4};
    const std::vector<FailureEvent> events;
    const report::Table curve;
    const Shape shape;
    const Press press;
    CHECK(elastic_samples({curve, energy, events, shape, press}, l) == 3);
    l.row = {3, 4};
    CHECK(elastic_samples({curve, energy, events, shape, press}, l) == 0);
}
