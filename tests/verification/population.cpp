// Particles that come, go and are renumbered in the middle of a calculation.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/boundaries/surface_shapes.hpp"
#include "core/model.hpp"
#include "specimens/random.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

Material grain() {
    Material m;
    m.density = 2500.0;
    m.young_modulus = 1e7;
    m.contact_law = ContactLaw::hertz;
    m.contact_restitution = 0.5;
    m.rolling_friction = 0.01;
    m.mu_d = 0.4;
    return m;
}

// A heap above the floor of a box: spheres of 1 cm and a few pairs of spheres that are one body.
Model heap() {
    Spheres s;
    s.packed = false;
    Random random(3, Stream::positions);
    const auto somewhere = [&](int layer, int k) {
        return Vec3(-0.035 + 0.0235 * (k % 4) + 0.002 * random.uniform(), -0.035 + 0.0235 * (k / 4) + 0.002 * random.uniform(),
                    0.012 + 0.023 * layer);
    };
    for (int layer = 0; layer < 6; ++layer) {
        for (int k = 0; k < 16; ++k) {
            s.add(somewhere(layer, k), 0.01, 2500.0);
            s.velocity.set(s.size() - 1, {0.3 * random.uniform(), 0.3 * random.uniform(), -0.5});
        }
    }
    Clusters clusters;
    ClusterShape dumbbell;
    dumbbell.centre = {{-0.005, 0, 0}, {0.005, 0, 0}};
    dumbbell.radius = {0.008, 0.008};
    dumbbell.volume = 3e-6;
    dumbbell.inertia = {1e-10, 2e-10, 2e-10};
    for (int k = 0; k < 9; ++k) {
        clusters.add(s, dumbbell, 2500.0, {-0.03 + 0.03 * (k % 3), -0.03 + 0.03 * (k / 3), 0.17}, rotation::Quaternion::Identity());
        s.id[s.size() - 2] = s.id[s.size() - 1];
    }
    const Material m = grain();
    Surface box("box", box_surface({0.1, 0.1, 0.4}), m, 0.4);
    box.origin = {0, 0, 0.2};
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, std::vector<std::uint8_t>(s.size(), 0), weight);
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = {0, 0, -9.81};
    numerics.time_step = 2e-5;
    numerics.overlap_growth = 1e-4;
    return {std::move(s), {m}, std::move(none), std::move(weight), Walls({}, {std::move(box)}), numerics, std::move(clusters)};
}

// The model's particles in another order, without those that `leaves` says.
template <class Leaves> void exchange(Model& model, bool reversed, const Leaves& leaves) {
    Spheres spheres;
    spheres.packed = false;
    Clusters clusters;
    std::vector<std::int32_t> origin;
    const std::size_t alone = model.clusters.alone(model.spheres);
    for (std::size_t n = 0; n < alone; ++n) {
        const std::size_t k = reversed ? alone - 1 - n : n;
        if (!leaves(k)) {
            spheres.append(model.spheres, k);
            origin.push_back(static_cast<std::int32_t>(k));
        }
    }
    for (std::size_t n = 0; n < model.clusters.size(); ++n) {
        const std::size_t b = reversed ? model.clusters.size() - 1 - n : n;
        if (!leaves(model.clusters.first[b])) {
            clusters.append(spheres, model.clusters, model.spheres, b);
            for (auto s = model.clusters.first[b]; s < model.clusters.first[b + 1]; ++s) {
                origin.push_back(static_cast<std::int32_t>(s));
            }
        }
    }
    model.repopulate(std::move(spheres), std::move(clusters), origin);
}

} // namespace

TEST_CASE("a renumbering in the middle changes nothing but the order") {
    Model straight = heap();
    Model turned = heap();
    run(straight, 4000);
    run(turned, 2000);
    exchange(turned, true, [](std::size_t) { return false; });
    run(turned, 2000);
    // After 80 ms of collisions, sums in another order have grown from 1e-16 to no more than this.
    for (std::size_t k = 0; k < straight.spheres.size(); ++k) {
        for (std::size_t other = 0; other < turned.spheres.size(); ++other) {
            const bool same =
                turned.spheres.id[other] == straight.spheres.id[k] && (turned.spheres.radius[other] == 0.01 || (k % 2 == other % 2));
            if (same) {
                CHECK((turned.spheres.position.at(other) - straight.spheres.position.at(k)).norm() < 1e-8);
            }
        }
    }
    CHECK(turned.ledger().friction == Approx(straight.ledger().friction).epsilon(1e-6));
    CHECK(turned.ledger().initial == Approx(straight.ledger().initial).epsilon(1e-12));
}

TEST_CASE("between a renumbering and the next search a surface still knows how stiff its contacts are") {
    Model model = heap();
    run(model, 3000);
    const auto stiffness = [&] { return model.walls.surfaces[0].stiffness_along({0, 0, 1}, model.spheres); };
    const double before = stiffness();
    REQUIRE(before > 0.0);
    exchange(model, true, [](std::size_t) { return false; });
    CHECK(stiffness() == Approx(before).epsilon(1e-12)); // the same terms in another order
    exchange(model, false, [](std::size_t k) { return k % 3 == 0; });
    CHECK(stiffness() < before);
    CHECK(stiffness() > 0.0);
}

TEST_CASE("the ledger closes while particles leave") {
    Model model = heap();
    run(model, 3000);
    const double before = model.ledger().residual() / model.ledger().given();
    const double given = model.ledger().given();
    // In the thick of it: contacts are pressed, particles move.
    exchange(model, false, [](std::size_t k) { return k % 3 == 0; });
    run(model, 1);
    CHECK(model.ledger().given() < given);
    CHECK(std::fabs(model.ledger().residual()) < std::fabs(before * given) + 2e-4 * given);
    run(model, 3000);
    CHECK(std::fabs(model.ledger().relative_residual()) < 1e-3);
    CHECK(model.spheres.size() < 96 + 18);
}

TEST_CASE("what is thrown into a scene brings its energy along") {
    Model model = heap();
    run(model, 1000);
    const double initial = model.ledger().initial;
    Spheres spheres;
    spheres.packed = false;
    Clusters clusters;
    std::vector<std::int32_t> origin(model.spheres.size() + 1);
    const std::size_t alone = model.clusters.alone(model.spheres);
    for (std::size_t k = 0; k < alone; ++k) {
        spheres.append(model.spheres, k);
    }
    std::iota(origin.begin(), origin.begin() + static_cast<std::ptrdiff_t>(alone), 0);
    spheres.add({0, 0, 0.3}, 0.01, 2500.0);
    spheres.velocity.set(alone, {0, 0, -2.0});
    origin[alone] = -1;
    for (std::size_t b = 0; b < model.clusters.size(); ++b) {
        clusters.append(spheres, model.clusters, model.spheres, b);
    }
    std::iota(origin.begin() + static_cast<std::ptrdiff_t>(alone) + 1, origin.end(), static_cast<std::int32_t>(alone));
    const double mass = spheres.mass[alone];
    model.repopulate(std::move(spheres), std::move(clusters), origin);
    CHECK(model.ledger().initial - initial == Approx(0.5 * mass * 4.0).epsilon(1e-12));
    run(model, 5000);
    CHECK(std::fabs(model.ledger().relative_residual()) < 1e-3);
}

TEST_CASE("a model of clusters among surfaces goes on from a checkpoint bit for bit") {
    const testing::TemporaryFolder folder;
    const std::string file = folder.file("checkpoint.h5");
    Model straight = heap();
    straight.walls.surfaces[0].drive = {{0.1, 0, 0}, {0, 0, 1.0}};
    run(straight, 1500);
    testing::save_model(straight, file);
    run(straight, 1500);
    Model resumed = heap();
    testing::load_model(resumed, file);
    resumed.walls.surfaces[0].drive = {{0.1, 0, 0}, {0, 0, 1.0}};
    run(resumed, 1500);
    CHECK(resumed.state_hash() == straight.state_hash());
    CHECK(resumed.ledger().friction == straight.ledger().friction);
    CHECK(resumed.walls.surfaces[0].sums.reaction == straight.walls.surfaces[0].sums.reaction);
}

TEST_CASE("specimens with bonds or platens keep their particles") {
    Model model = heap();
    model.walls.platens.emplace_back();
    CHECK_THROWS_AS(model.repopulate(Spheres{}, Clusters{}, {}), std::logic_error);
}
