// Effective areas (thesis 5.1.3, 5.3): what the cases of `proveta verify` do not cover.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "core/bonds/areas.hpp"
#include "specimens/laguerre.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("areas: between and beyond the tabulated polyhedra and polygons") {
    CHECK(polyhedron_ratio(10) == Approx(0.5 * (1.65399 + 1.32503)));
    CHECK(polyhedron_ratio(2) == 3.30797);
    CHECK(polyhedron_ratio(40) == Approx(1.0 + 0.20657 / 2));
    CHECK(polygon_ratio(1) == polygon_ratio(3));
}

TEST_CASE("areas: a trapezium between discs, equal ones as the limit") {
    Spheres s;
    s.planar = true;
    for (const double r : {1e-3, 1.00005e-3, 1.0002e-3, 2e-3}) {
        s.add({0, 0, 0}, r, 2500.0);
    }
    const auto raw = [&](std::size_t i, std::size_t j) { return raw_area(AreaRule::truncated_cone, s, i, j); };
    CHECK(raw(0, 0) == Approx(2e-3));
    CHECK(raw(0, 3) == Approx(2e-3 / std::log(2.0)).epsilon(1e-14));
    for (const std::size_t j : {1u, 2u}) {
        CHECK(raw(0, j) == Approx(2.0 * (s.radius[j] - 1e-3) / std::log(s.radius[j] / 1e-3)).epsilon(1e-9));
        CHECK(raw(0, j) == Approx(raw(j, 0)).epsilon(1e-12));
    }
    CHECK(raw_area(AreaRule::minimum_radius, s, 0, 3) == 2e-3);
    CHECK(s.mass[3] == Approx(2500.0 * std::numbers::pi * 4e-6));
    CHECK(s.inertia[3] == Approx(0.5 * s.mass[3] * 4e-6));
}

TEST_CASE("areas: one global factor from porosity and coordination, for minimum_radius only") {
    const Deck deck = small_deck(200, R"({"material": {"area_rule": "minimum_radius", "area_factor": "auto"}})");
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Deck plain = small_deck(200, R"({"material": {"area_rule": "minimum_radius"}})");
    const Bench unit = set_up(plain, make_specimen(plain.specimen));
    REQUIRE(bench.area_factor);
    CHECK(*bench.area_factor == Approx(40.0 * 0.257 / bench.coordination));
    CHECK(bench.model->bonds.area[5] == Approx(*bench.area_factor * unit.model->bonds.area[5]));
    CHECK_THROWS_AS(small_deck(200, R"({"material": {"area_factor": "auto"}})"), input::InputError);
}

TEST_CASE("laguerre: a cubic lattice in a prism has square facets and fills it") {
    Shape shape;
    shape.kind = ShapeKind::prism;
    shape.width = shape.depth = shape.height = 0.04;
    Spheres s;
    for (int k = 0; k < 64; ++k) {
        s.add({0.01 * (k % 4 - 1.5), 0.01 * (k / 4 % 4 - 1.5), 0.01 * (k / 16 + 0.5)}, 0.005, 2500.0);
    }
    auto pairs = find_pairs(s.position, s.radius, 1.01, 0.0);
    const auto l = laguerre_areas(shape, s, pairs);
    CHECK(pairs.size() == 144);
    for (const double area : l.areas.pair) {
        CHECK(area == Approx(1e-4).epsilon(1e-10));
    }
    CHECK(l.volume_ratio == Approx(1.0).epsilon(1e-10));
    CHECK(l.unbonded_share == Approx(0.0).margin(1e-9));
    CHECK(l.facetless == 0);
    CHECK(l.areas.weight[21] == Approx(1e-4 / (std::numbers::pi * 25e-6)));
    // Diagonal pairs share edges at most, and a pair left out is lost area.
    pairs = find_pairs(s.position, s.radius, 1.5, 0.0);
    const auto diagonal = laguerre_areas(shape, s, pairs);
    CHECK(diagonal.facetless == pairs.size() - 144);
    Material m;
    m.area_rule = AreaRule::laguerre;
    std::vector<double> weight;
    const std::vector<std::uint8_t> skin(64, 0);
    CHECK(make_bonds(s, {m}, pairs, skin, weight, &diagonal.areas).size() == 144);
    CHECK_THROWS_AS(make_bonds(s, {m}, pairs, skin, weight), std::invalid_argument);
    CHECK(laguerre_areas(shape, s, {{0, 1}}).unbonded_share == Approx(143.0 / 144.0));
}

TEST_CASE("laguerre: spheres in one place, outside or swallowed are left out") {
    Shape shape;
    shape.diameter = 0.02;
    shape.height = 0.04;
    Spheres s;
    s.add({0, 0, 0.01}, 0.005, 2500.0);
    s.add({0, 0, 0.01}, 0.005, 2500.0);
    s.add({0, 0, 0.01}, 0.003, 2500.0);
    s.add({0, 0, 0.05}, 0.005, 2500.0);
    s.add({0, 0.03, 0.02}, 0.005, 2500.0);
    s.add({0, 0, 0.011}, 0.0001, 2500.0);
    s.add({0, 0, 0.03}, 0.005, 2500.0);
    const auto l = laguerre_areas(shape, s, {{0, 1}, {0, 5}, {0, 6}, {1, 6}});
    CHECK(l.without_cell == 5);
    CHECK(l.facetless == 3);
    // The wall cuts a lone cell by one plane; that of two spheres on the axis has none to lean on.
    CHECK(l.areas.pair[2] > 0.0);
    for (const double w : l.areas.weight) {
        CHECK(std::isfinite(w));
    }
    CHECK(laguerre_areas(shape, Spheres{}, {}).facetless == 0);
}

TEST_CASE("plate: what is pressed in its plane stays there, to the last bit") {
    const Deck deck = small_deck(150, R"({"specimen": {"shape": "plate", "diameter": null, "width": 0.05}, "loading": {"rate": 0.5}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    CHECK(bench.coordination == Approx(5.1).margin(0.05));
    CHECK(bench.statistics.porosity == Approx(0.10));
    CHECK(bench.partition.section == Approx(1.0).margin(0.05));
    Model& m = *bench.model;
    for (int k = 0; k < 20000; ++k) {
        m.step({0.25, -0.25}, k % 100 == 0);
    }
    CHECK(m.broken() > 10);
    for (std::size_t k = 0; k < m.spheres.size(); ++k) {
        CHECK(
            (m.spheres.position.y[k] == 0.0 && m.spheres.velocity.y[k] == 0.0 && m.spheres.spin.x[k] == 0.0 && m.spheres.spin.z[k] == 0.0));
    }
}

TEST_CASE("the specimen that was asked for: thesis mesh 3D-2") {
    const Deck deck = read_deck(input::Json::parse(R"({"test": "ucs"})"), "test.json");
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const auto& st = bench.statistics;
    CHECK(st.mean_radius == Approx(3.86e-3).margin(0.1e-3));
    CHECK(st.relative_deviation == Approx(0.258).margin(0.01));
    CHECK(st.porosity == Approx(0.257).margin(0.005));
    CHECK(bench.coordination == Approx(10.0).margin(0.3));
    CHECK(st.largest_overlap < 0.4);
    CHECK(st.outside == 0);
    CHECK(st.fabric_deviator < 0.02);
    // Flat, well covered ends: spheres at the wall cover at least three quarters of each end with their discs.
    for (const auto& platen : bench.model->walls.platens) {
        CHECK(platen.area_weight < 1.0 / 0.75);
    }
}
