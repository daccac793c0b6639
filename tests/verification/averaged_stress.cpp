// Averaged stress, criteria on it, fragments, and bonds that the engine fails by them.
#include <catch2/catch.hpp>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/averaged_stress.hpp"
#include "lab/fragments.hpp"
#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("averaged stress: Mohr-Coulomb and Rankine on tensors with known answers") {
    const auto diagonal = [](double a, double b, double c) { return Mat3(Vec3(a, b, c).asDiagonal()); };
    CHECK(mohr_coulomb(diagonal(30e6, 30e6, 30e6), 16e6, 0.9, 5e6) == Approx(0.0).margin(1e-9));
    // Pure shear without friction: tau / c. With tension 2 MPa of 5 MPa the cut-off is the smaller.
    CHECK(mohr_coulomb(diagonal(2e6, 0, -2e6), 4e6, 0.0, 5e6) == Approx(0.5));
    // Uniaxial strength of Mohr-Coulomb: 2 c tan(pi/4 + phi/2).
    const double phi = std::atan(0.9);
    const double strength = 2.0 * 16e6 * std::tan(0.25 * 3.14159265358979 + 0.5 * phi);
    CHECK(mohr_coulomb(diagonal(0, 0, strength), 16e6, 0.9, 5e6) == Approx(1.0).epsilon(1e-6));
    CHECK(rankine(diagonal(-2e6, 10e6, 0), 5e6) == Approx(0.4));
    Mat3 shear = Mat3::Zero();
    shear(0, 1) = shear(1, 0) = 3e6;
    CHECK(rankine(shear, 5e6) == Approx(0.6));
}

TEST_CASE("averaged stress: the spheres of a pressed column carry its stress, symmetric") {
    const Deck deck =
        small_deck(1500, R"({"loading": {"rate": "0.05 m/s", "stop": {"axial_strain": 0.0004}, "platen_friction": "lubricated"},
        "numerics": {"damping_translation": 0.6}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
    const Model& m = *bench.model;
    const auto volume = tributary_volumes(m.spheres, m.bonds);
    const auto stress = sphere_stresses(m.spheres, m.bonds, m.contacts, m.walls, m.pressures, volume);
    Mat3 sum = Mat3::Zero();
    for (std::size_t k = 0; k < stress.size(); ++k) {
        REQUIRE((stress[k] - stress[k].transpose()).norm() == 0.0);
        sum += volume[k] * stress[k];
    }
    // The sum over all spheres is the virial of the platens' forces: axial stress times the specimen's volume.
    const double axial = data.curve.values("axial_stress").back();
    CHECK(sum(2, 2) == Approx(axial * bench.specimen.shape.volume()).epsilon(0.02)); // loading is dynamic, if slow
    CHECK(std::fabs(sum(0, 0)) < 0.03 * sum(2, 2));
    const auto vicinity = vicinity_stresses(m.bonds, stress, volume);
    double scatter[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < stress.size(); ++k) {
        scatter[0] += std::pow(stress[k](2, 2) - axial, 2);
        scatter[1] += std::pow(vicinity[k](2, 2) - axial, 2);
    }
    CHECK(scatter[1] < 0.5 * scatter[0]);
}

TEST_CASE("averaged criterion: a pressed specimen fails by it, and its ledger closes") {
    const Deck deck = small_deck(800, R"({"loading": {"rate": "0.5 m/s", "stop": {"axial_strain": 0.01, "post_peak_drop": 0.3}},
        "material": {"card": "custom", "criterion": "mohr_coulomb"}})");
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    const TestData data = run_protocol(deck, bench, {[](const TestData&, double) {}, [] {}, [] { return false; }});
    CHECK(bench.model->broken() > 100);
    CHECK(bench.model->broken() == data.events.size());
    CHECK(data.energy.values("damage").back() > 0.0);
    CHECK(std::fabs(data.energy.values("residual").back()) < 0.01 * data.energy.values("platens").back());
    CHECK(data.stopped_by.find("from its peak") != std::string::npos);
}

TEST_CASE("fracture energy: bonds that would snap back are refused, naming the longest allowed") {
    const Deck deck = small_deck(300, R"({"material": {"card": "custom", "fracture_energy_tension": 0.5, "fracture_energy_shear": 5}})");
    try {
        set_up(deck, make_specimen(deck.specimen));
        FAIL("accepted");
    } catch (const input::InputError& e) {
        REQUIRE(e.problems.size() == 2);
        CHECK(e.problems[0].path == "/material/fracture_energy_tension");
        CHECK(e.problems[1].path == "/material/fracture_energy_shear");
        CHECK(e.problems[0].expected.find("bonds of at most") != std::string::npos);
    }
}

TEST_CASE("fragments: what has come off is marked, what holds together is not") {
    const Deck deck = small_deck(500);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    Model& m = *bench.model;
    for (std::size_t b = 0; b < m.bonds.size(); ++b) {
        if (m.bonds.i[b] == 7 || m.bonds.j[b] == 7) {
            m.bonds.mode[b] = 1;
        }
    }
    const auto off = detached_spheres(m);
    for (std::size_t k = 0; k < off.size(); ++k) {
        CHECK(int(off[k]) == (k == 7 ? 1 : 0));
    }
}

TEST_CASE("checkpoint: bonds with moments and an averaged criterion go on bit for bit") {
    const Deck deck = small_deck(
        400,
        R"({"material": {"card": "custom", "criterion": "rankine", "sigma_f": "0.5 MPa", "bending_factor": 1, "twisting_factor": 0.5}})");
    const Specimen specimen = make_specimen(deck.specimen);
    Bench whole = set_up(deck, specimen);
    const auto press = [](Model& m, int steps) {
        for (int k = 0; k < steps; ++k) {
            m.step({0.3, -0.3}, k % 100 == 0);
        }
    };
    press(*whole.model, 2500);
    const auto file = (std::filesystem::temp_directory_path() / ("proveta_moments_" + std::to_string(::getpid()) + ".h5")).string();
    save_model(*whole.model, file);
    Bench second = set_up(deck, specimen);
    load_model(*second.model, file);
    std::filesystem::remove(file);
    CHECK(whole.model->broken() > 0);
    press(*whole.model, 300);
    press(*second.model, 300);
    CHECK(second.model->state_hash() == whole.model->state_hash());
}
