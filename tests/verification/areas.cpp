// polygon-areas (3D part) and area-partition (thesis 5.3, 5.4.1).
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "core/bonds/areas.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;
using std::numbers::pi;

TEST_CASE("polygon-areas: ratios of the Platonic solids from their geometry, to the printed digits") {
    // Surface over inscribed sphere: of a solid with n faces that are regular p-gons, q at a vertex.
    const auto ratio = [](double n, double p, double q) {
        const double half = std::asin(std::cos(pi / q) / std::sin(pi / p)); // half the dihedral angle
        const double side = 2.0 * std::tan(pi / p) / std::tan(half);        // of the solid with inscribed radius 1
        return n * p * side * side / (4.0 * std::tan(pi / p)) / (4.0 * pi);
    };
    CHECK(polyhedron_ratio(4) == Approx(ratio(4, 3, 3)).epsilon(4e-6));
    CHECK(polyhedron_ratio(6) == Approx(ratio(6, 4, 3)).epsilon(4e-6));
    CHECK(polyhedron_ratio(8) == Approx(ratio(8, 3, 4)).epsilon(4e-6));
    CHECK(polyhedron_ratio(12) == Approx(ratio(12, 5, 3)).epsilon(4e-6));
    CHECK(polyhedron_ratio(20) == Approx(ratio(20, 3, 5)).epsilon(4e-6));
    CHECK(polyhedron_ratio(10) == Approx(0.5 * (1.65399 + 1.32503)));
    CHECK(polyhedron_ratio(2) == 3.30797);
    CHECK(polyhedron_ratio(40) == Approx(1.0 + 0.20657 / 2));
}

TEST_CASE("area-partition: bond areas make up the section, whole within 1.5 % and interior within 3.5 %") {
    // Like the thesis's meshes 3D-1 and 3D-2, on two packings each.
    for (const std::int64_t spheres : {10511, 13500}) {
        for (const std::int64_t seed : {1, 2}) {
            input::Json json = {{"test", "ucs"}, {"specimen", {{"spheres", spheres}, {"seed", seed}}}};
            const Deck deck = read_deck(json, "test.json");
            const Bench bench = set_up(deck, make_specimen(deck.specimen));
            INFO(spheres << " spheres, seed " << seed);
            CHECK(bench.partition.section == Approx(1.0).margin(0.015));
            CHECK(bench.partition.interior == Approx(1.0).margin(0.035));
        }
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
    for (const auto& platen : bench.model->platens) {
        CHECK(platen.area_weight < 1.0 / 0.75);
    }
}
