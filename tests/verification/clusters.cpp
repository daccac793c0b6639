// Clusters: their mass properties, their motion, their contacts.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "core/model.hpp"
#include "specimens/cluster_shape.hpp"

using namespace proveta;

namespace {

Material soft() {
    Material m;
    m.density = 2000.0;
    m.young_modulus = 1e7;
    m.contact_law = ContactLaw::hertz;
    m.contact_restitution = 1.0;
    return m;
}

// One sphere as a cluster.
ClusterShape ball(double radius) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    return {{Vec3::Zero()}, {radius}, volume, Vec3::Constant(0.4 * volume * radius * radius)};
}

ClusterShape dumbbell(double radius, double distance) {
    const std::vector<Vec3> centre{{-0.5 * distance, 0, 0}, {0.5 * distance, 0, 0}};
    return cluster_shape(centre, {radius, radius}, mass_properties(centre, {radius, radius}));
}

Surface floor_of(const Material& m, double friction) { return {"floor", plane_surface(4.0, 4.0), m, friction}; }

Model model_of(Spheres s, Clusters c, std::vector<Surface> surfaces, const Material& m, const Vec3& gravity, double dt) {
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, std::vector<std::uint8_t>(s.size(), 0), weight);
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = gravity;
    numerics.time_step = dt;
    return {std::move(s), {m}, std::move(none), std::move(weight), Walls({}, std::move(surfaces)), numerics, std::move(c)};
}

struct Motion {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(); // about the origin
};
Motion momentum(const Model& m) {
    Motion out;
    for (std::size_t k = 0; k < m.clusters.alone(m.spheres); ++k) {
        const Vec3 p = m.spheres.mass[k] * m.spheres.velocity.at(k);
        out.linear += p;
        out.angular += m.spheres.position.at(k).cross(p) + m.spheres.inertia[k] * m.spheres.spin.at(k);
    }
    for (std::size_t k = 0; k < m.clusters.size(); ++k) {
        const Vec3 p = m.clusters.mass[k] * m.clusters.velocity[k];
        out.linear += p;
        out.angular += m.clusters.position[k].cross(p) + m.clusters.turning[k].momentum;
    }
    return out;
}

} // namespace

TEST_CASE("clusters: mass properties of solids are exact, those of spheres near it") {
    const Vec3 size(1.0, 0.6, 0.3);
    SurfaceMesh box = box_surface(size);
    for (auto& v : box.vertex) {
        v += Vec3(0.3, -2.0, 5.0);
    }
    const MassProperties p = mass_properties(box);
    CHECK(p.volume == Approx(0.18).epsilon(1e-12));
    CHECK((p.centre - Vec3(0.3, -2.0, 5.0)).norm() < 1e-12);
    const Vec3 squares = size.cwiseProduct(size);
    const Vec3 expected = 0.18 / 12.0 * Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
    CHECK((p.inertia - Mat3(expected.asDiagonal())).norm() < 1e-11);
    // Two spheres that overlap: volume of both less the lens, pi (4 R + d) (2 R - d)^2 / 12.
    const double r = 0.1, d = 0.13;
    const MassProperties u = mass_properties({{0, 0, 0}, {d, 0, 0}}, {r, r});
    const double lens = std::numbers::pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12.0;
    CHECK(u.volume == Approx(8.0 / 3.0 * std::numbers::pi * r * r * r - lens).epsilon(1e-4));
    CHECK((u.centre - Vec3(0.5 * d, 0, 0)).norm() < 1e-6);
    CHECK_THROWS_AS(mass_properties(plane_surface(1, 1)), std::invalid_argument);
}

TEST_CASE("clusters: spheres fill a solid from inside, more of them more of it") {
    const SurfaceMesh box = box_surface({1.0, 0.7, 0.5});
    const Fit few = fit_of(box, fill_with_spheres(box, {4, 1.0, 20, 0.0}));
    const ClusterShape shape = fill_with_spheres(box, {60, 0.97, 20, 0.0});
    const Fit many = fit_of(box, shape);
    CHECK(many.filled > few.filled);
    CHECK(many.filled > 0.85);  // spheres do not reach into edges
    CHECK(many.outside < 0.01); // inscribed: nothing but the grids' error
    CHECK(shape.volume == Approx(0.35));
    CHECK(shape.inertia.x() < shape.inertia.y());
    CHECK(shape.inertia.y() < shape.inertia.z());
}

TEST_CASE("clusters: one sphere as a cluster moves as a sphere") {
    const Material m = soft();
    Spheres alone, member;
    alone.add({0, 0, 0.25}, 0.1, m.density);
    Clusters body;
    body.add(member, ball(0.1), m.density, {0, 0, 0.25}, rotation::Quaternion(0.5, 0.5, 0.5, 0.5));
    Model a = model_of(alone, {}, {floor_of(m, 0.4)}, m, {0, 0, -9.81}, 1e-5);
    Model b = model_of(member, body, {floor_of(m, 0.4)}, m, {0, 0, -9.81}, 1e-5);
    a.spheres.velocity.set(0, {1.0, 0.5, 0.0});
    b.clusters.velocity[0] = {1.0, 0.5, 0.0};
    b.clusters.place(0, 0.0, b.spheres);
    double apart = 0.0;
    for (int n = 0; n < 60000; ++n) { // two rebounds, with spin from the floor
        a.step({}, n % 1000 == 0);
        b.step({}, n % 1000 == 0);
        apart = std::max(apart, (a.spheres.position.at(0) - b.spheres.position.at(0)).norm());
    }
    CHECK(a.spheres.spin.at(0).norm() > 1.0);
    CHECK(apart < 1e-8); // round-off through two elastic rebounds
    CHECK((a.spheres.spin.at(0) - b.spheres.spin.at(0)).norm() < 1e-6);
    CHECK(b.ledger().kinetic == Approx(a.ledger().kinetic).epsilon(1e-7));
}

TEST_CASE("clusters: an oblique impact of two dumbbells keeps momenta and energy") {
    Material m = soft();
    m.mu_d = 0.0;
    Spheres s;
    s.add({0.0, 0.35, 0.02}, 0.05, m.density);
    Clusters c;
    const ClusterShape shape = dumbbell(0.1, 0.15);
    c.add(s, shape, m.density, {-0.3, 0, 0}, rotation::Quaternion(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized())));
    c.add(s, shape, m.density, {0.3, 0.04, 0.03}, rotation::Quaternion(Eigen::AngleAxisd(1.3, Vec3(-1, 1, 0).normalized())));
    Model model = model_of(s, c, {}, m, Vec3::Zero(), 5e-6);
    model.clusters.velocity[0] = {2.0, 0, 0};
    model.clusters.velocity[1] = {-1.0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
        auto& t = model.clusters.turning[k];
        t = rotation::start(t.inertia, t.attitude, {3.0, -5.0, 2.0});
        model.clusters.place(k, 0.0, model.spheres);
    }
    model.step({}, true);
    const Motion before = momentum(model);
    const double energy = model.ledger().kinetic;
    const Vec3 first = model.clusters.velocity[0];
    for (int n = 0; n < 60000; ++n) {
        model.step({}, n % 500 == 0 || n == 59999);
    }
    const Motion after = momentum(model);
    CHECK((model.clusters.velocity[0] - first).norm() > 0.5); // they met
    CHECK((after.linear - before.linear).norm() < 1e-10 * before.linear.norm());
    // Positions and velocities are half a step apart: the couple of v dt / 2 and p vanishes, but not that of changing forces.
    CHECK((after.angular - before.angular).norm() < 1e-4 * before.angular.norm());
    CHECK(model.ledger().kinetic == Approx(energy).epsilon(1e-4));
    CHECK(std::fabs(model.ledger().relative_residual()) < 1e-3);
}

TEST_CASE("clusters: a dumbbell comes to rest on both spheres and weighs what it weighs") {
    Material m = soft();
    m.contact_restitution = 0.3;
    Spheres s;
    Clusters c;
    c.add(s, dumbbell(0.1, 0.15), m.density, {0, 0, 0.16}, rotation::Quaternion(Eigen::AngleAxisd(0.3, Vec3::UnitY())));
    Model model = model_of(s, c, {floor_of(m, 0.5)}, m, {0, 0, -9.81}, 1e-5);
    for (int n = 0; n < 200000; ++n) {
        model.step({}, n % 10000 == 0);
    }
    CHECK(model.walls.surfaces[0].sums.touching == 2);
    CHECK(-model.walls.surfaces[0].sums.reaction.z() == Approx(model.clusters.mass[0] * 9.81).epsilon(1e-4));
    CHECK(model.clusters.velocity[0].norm() < 1e-3); // a thousandth of the fall's
}

TEST_CASE("clusters: the bound on the step counts the lever arms of a long body") {
    // A dumbbell on a floor swings up and down and about its middle: 2 k / m and 2 k (d/2)^2 / I.
    Material m = soft();
    m.contact_law = ContactLaw::linear;
    for (const double distance : {0.15, 0.3, 1.0}) {
        Spheres s;
        Clusters c;
        c.add(s, dumbbell(0.1, distance), m.density, {0, 0, 0.0999}, rotation::Quaternion::Identity());
        const double mass = c.mass[0];
        const double across = c.turning[0].inertia.maxCoeff();
        const Model model = model_of(s, c, {floor_of(m, 0.5)}, m, {0, 0, -9.81}, 1e-6);
        const LooseContact& law = model.walls.surfaces[0].law[0];
        const double square = 2.0 * law.k_n * std::max(1.0 / mass, 0.25 * distance * distance / across);
        CHECK(model.stable_step() <= 2.0 / std::sqrt(square));
        CHECK(model.stable_step() > 0.4 * 2.0 / std::sqrt(square)); // it also counts sliding
        CHECK_THROWS_AS(model_of(s, c, {floor_of(m, 0.5)}, m, {0, 0, -9.81}, 2.0 / std::sqrt(square)), UnstableStep);
    }
}
