// Specimens in the press: closed forms, symmetry, the ledger, threads, checkpoints.
#include <catch2/catch.hpp>
#include <omp.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/hash.hpp"
#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

TestData test_of(const Deck& deck, Bench& bench) {
    return run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
}

} // namespace

TEST_CASE("column: spheres in a row between platens are springs in series") {
    const Material m = unbreakable(1e9);
    constexpr int n = 5;
    constexpr double r = 0.01;
    Spheres s;
    for (int k = 0; k < n; ++k) {
        s.add({0, 0, r + 2 * r * k}, r, 2500.0);
    }
    std::vector<Pair> pairs;
    for (std::int32_t k = 0; k + 1 < n; ++k) {
        pairs.push_back({k, k + 1});
    }
    Material tall = m;
    tall.area_rule = AreaRule::truncated_cone;
    std::vector<double> weight;
    Bonds bonds = make_bonds(s, {tall}, pairs, std::vector<std::uint8_t>(n, 1), weight);
    const double area = std::numbers::pi * r * r;
    std::vector<Platen> platens{make_platen(s, {}, 0.0, 0.0, area, 0.1), make_platen(s, {.inward = -1.0}, 2 * r * n, 0.0, area, 0.1)};
    Model model(s, {tall}, bonds, weight, platens, {});
    const double speed = 1e-3;
    for (int k = 0; k < 20000; ++k) {
        const double v = k < 2000 ? 0.5 * speed * k / 2000.0 : 0.5 * speed;
        model.step({v, -v}, k % 1000 == 0);
    }
    const double closed = 2 * r * n - (model.walls.platens[1].position - model.walls.platens[0].position) - 1.0 * speed * model.dt();
    // E A / R at each platen and E A / 2R at each bond: a bar of length 2 R n.
    const double expected = 1e9 * area / (2 * r * n) * closed;
    CHECK(-model.walls.platens[0].reaction.z() == Approx(expected).epsilon(2e-3));
    CHECK(model.walls.platens[1].reaction.z() == Approx(expected).epsilon(2e-3));
}

TEST_CASE("ledger: the residual stays below 1 % of the work, past the peak") {
    const Deck deck = small_deck(1500, R"({"loading": {"rate": "0.1 m/s"}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    const TestData data = test_of(deck, bench);
    CHECK(data.stopped_by.find("from its peak") != std::string::npos);
    const auto work = data.energy.values("platens");
    const auto residual = data.energy.values("residual");
    for (std::size_t k = 0; k < work.size(); ++k) {
        if (work[k] > 0.01 * work.back()) {
            CHECK(std::fabs(residual[k]) < 0.01 * work[k]);
        }
    }
    CHECK(data.energy.values("damage").back() > 0.01 * work.back());
    CHECK(bench.model->broken() == data.events.size());
    double released = 0.0;
    for (const auto& e : data.events) {
        released += e.energy;
    }
    CHECK(released <= data.energy.values("damage").back() * (1 + 1e-9));
}

TEST_CASE("objectivity: one thread and three give the same bits, through failure") {
    std::vector<std::uint64_t> hashes;
    std::vector<std::vector<std::vector<double>>> curves;
    const int before = omp_get_max_threads();
    for (const int threads : {1, 3}) {
        omp_set_num_threads(threads);
        const Deck deck = small_deck(1200, R"({"loading": {"rate": "0.3 m/s"}})");
        Bench bench = set_up(deck, make_specimen(deck.specimen));
        const TestData data = test_of(deck, bench);
        CHECK(bench.model->broken() > 100);
        hashes.push_back(bench.model->state_hash());
        curves.push_back(data.curve.rows);
    }
    omp_set_num_threads(before);
    CHECK(hashes[0] == hashes[1]);
    CHECK(curves[0] == curves[1]);
}

TEST_CASE("objectivity: a specimen turned about its axis and renumbered answers the same, to round-off, while it is elastic") {
    std::vector<double> stress;
    for (const bool turned : {false, true}) {
        const Deck deck = small_deck(800, R"({"loading": {"rate": "0.2 m/s", "stop": {"axial_strain": 0.0003}},
            "material": {"card": "custom", "sigma_f": "100 GPa", "tau_f": "100 GPa", "lcs": ["1 GPa", "2 GPa", "3 GPa"], "elasticity": "as-given"}})");
        Specimen s = make_specimen(deck.specimen);
        if (turned) {
            const Eigen::AngleAxisd turn(1.0, Vec3::UnitZ());
            Packing reversed;
            for (std::size_t k = s.size(); k-- > 0;) {
                reversed.centre.push_back(turn * s.spheres.centre.at(k));
                reversed.radius.push_back(s.spheres.radius[k]);
            }
            s.spheres = reversed;
        }
        Bench bench = set_up(deck, std::move(s));
        stress.push_back(test_of(deck, bench).curve.values("axial_stress").back());
    }
    CHECK(stress[0] > 1e6);
    CHECK(stress[1] == Approx(stress[0]).epsilon(1e-9)); // thousands of steps of round-off, far below any physics
}

TEST_CASE("objectivity: the neighbour lists' skin changes speed, not results, while nothing has broken") {
    std::vector<std::uint64_t> hashes;
    for (const char* skin : {"0.02", "0.5"}) {
        const Deck deck = small_deck(
            500,
            std::string(R"({"loading": {"rate": "0.2 m/s", "stop": {"axial_strain": 0.0002}}, "numerics": {"mass_scaling": 0, "skin": )") +
                skin + R"(, "time_step": "100 ns"}})"); // below the bound for either skin, so that no mass is scaled
        Bench bench = set_up(deck, make_specimen(deck.specimen));
        test_of(deck, bench);
        Hash hash; // without the lists themselves, and when they were made
        for (const VectorField* f : {&bench.model->spheres.position, &bench.model->spheres.velocity, &bench.model->bonds.slip}) {
            hash.mix_value(f->x);
            hash.mix_value(f->y);
            hash.mix_value(f->z);
        }
        hashes.push_back(hash.value());
    }
    CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("checkpoint: a restored model goes on bit for bit, across failures") {
    const auto file = (std::filesystem::temp_directory_path() / ("proveta_check_" + std::to_string(::getpid()) + ".h5")).string();
    const Deck deck = small_deck(1000);
    const Specimen specimen = make_specimen(deck.specimen);
    const auto press = [](Model& m, int steps) {
        for (int k = 0; k < steps; ++k) {
            m.step({0.2, -0.2}, k % 100 == 0);
        }
    };
    Bench whole = set_up(deck, specimen);
    press(*whole.model, 1500);
    save_model(*whole.model, file);
    const std::size_t broken = whole.model->broken();
    press(*whole.model, 1000);
    CHECK(broken > 0);
    CHECK(whole.model->broken() > broken);

    Bench second = set_up(deck, specimen);
    load_model(*second.model, file);
    CHECK(second.model->broken() == broken);
    press(*second.model, 1000);
    CHECK(second.model->state_hash() == whole.model->state_hash());
    CHECK(second.model->ledger().damage == whole.model->ledger().damage);
    CHECK(second.model->ledger().platens == whole.model->ledger().platens);

    const Deck other = small_deck(900);
    Bench third = set_up(other, make_specimen(other.specimen));
    CHECK_THROWS(load_model(*third.model, file));
    std::filesystem::remove(file);
}

TEST_CASE("groups and materials: bonds stay within groups, pairs of materials take the weaker strength") {
    const Deck deck = small_deck(800, R"({"material": {"card": "custom"}, "regions": [
        {"from": ["-1 m", "-1 m", "50 mm"], "to": ["1 m", "1 m", "1 m"], "group": 0,
         "material": {"card": "custom", "sigma_f": "1 MPa", "fracture_energy_tension": 0, "fracture_energy_shear": 0}},
        {"from": ["-1 m", "-1 m", "75 mm"], "to": ["1 m", "1 m", "1 m"], "group": 5,
         "material": {"card": "custom", "young_modulus": "7 GPa", "fracture_energy_tension": 0, "fracture_energy_shear": 0}}]})");
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Bonds& b = bench.model->bonds;
    CHECK(b.groups.size() == 4); // lower, lower/middle, middle, and the top, which is a group of its own
    const double strength = to_material(deck.material.values).as<Dempack>().sigma_f;
    const double weaker = to_material(deck.regions[0].material.values).as<Dempack>().sigma_f;
    CHECK(b.groups[0].tensile_limit() == strength);
    CHECK(b.groups[1].tensile_limit() == weaker);
    std::size_t counted = 0;
    for (const auto& block : b.blocks) {
        counted += block.end - block.begin;
        for (auto k = block.begin; k < block.end; ++k) {
            const auto i = static_cast<std::size_t>(b.i[k]);
            const auto j = static_cast<std::size_t>(b.j[k]);
            REQUIRE(bench.model->spheres.group[i] == bench.model->spheres.group[j]);
        }
    }
    CHECK(counted == b.size());
    CHECK(bench.model->contacts.size() > 0); // across the group boundary spheres meet by the loose law
    // Overlaps of the packing across that boundary store nothing at the start.
    Model& m = *bench.model;
    m.step({0.0, 0.0}, true);
    CHECK(m.ledger().elastic == 0.0);
}
