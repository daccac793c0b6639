// Sides of a deformable skin, and what its contacts remember.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("coupling: on one side a sphere that has crossed is pushed back") {
    for (const auto how : both) {
        for (const double side : {1.0, -1.0, 0.0}) {
            CouplingBench b(sheet_membrane(0.4, 0.4, 5, 5), grain(ContactLaw::linear, 0.0, 1.0, 0.0), how, side);
            b.spheres.add({0.01, 0.02, 0.001}, 0.05, 2000.0);
            for (const double z : {0.045, 0.005, -0.005}) {
                const Vec3 f = force_at(b, {0.01, 0.02, z});
                const SkinSums sums = b.advance(1e-9);
                const double sign = side != 0.0 ? side : z > 0.0 ? 1.0 : -1.0;
                CHECK(f.z() == Approx(sign * b.body.law[0].k_n * (0.05 - sign * z)));
                CHECK(sums.crossed == (sign * z < 0.0 ? 1U : 0U));
            }
        }
    }
}

TEST_CASE("coupling: at edges and corners, sharp or not, nobody outside has crossed") {
    Dice dice(5);
    for (const auto how : both) {
        std::size_t touching = 0;
        for (int n = 0; n < 200; ++n) {
            SolidMesh mesh; // one tetrahedron: angles between its faces are 70 degrees and, drawn out, much less
            mesh.node = {Vec3(0.1, 0.1, 0.1), Vec3(0.1, -0.1, -0.1), Vec3(-0.1, 0.1, -0.1), Vec3(-0.1, -0.1, 0.1)};
            for (auto& v : mesh.node) {
                v = v.cwiseProduct(Vec3(1.0, 1.0, n % 3 == 0 ? 0.2 : 1.0)) + dice.in_box(0.01);
            }
            mesh.tetrahedra = {{0, 1, 2, 3}};
            tidy(mesh);
            CouplingBench b(mesh, grain(ContactLaw::linear, 0.0, 1.0, 0.0), how, 1.0);
            const auto& v = b.body.solid.position;
            const double radius = 0.03;
            b.spheres.add({0, 0, 0}, radius, 2000.0);
            // The nearest point of an edge or a corner, seen from outside.
            const double along = n % 2 == 0 ? dice(0, 1) : 0.0;
            const Vec3 point = (1.0 - along) * v[0] + along * v[1];
            const Vec3 middle = 0.25 * (v[0] + v[1] + v[2] + v[3]);
            const Vec3 centre = point + 0.9 * radius * ((point - middle).normalized() + dice.in_box(0.4)).normalized();
            const auto& planes = b.body.skin.geometry().plane;
            if (std::none_of(planes.begin(), planes.end(), [&](const FacePlane& p) { return p.normal.dot(centre) > p.offset; })) {
                continue;
            }
            const Vec3 f = force_at(b, centre);
            const SkinSums sums = b.advance(1e-9);
            touching += sums.touching > 0 ? 1 : 0;
            CHECK(sums.crossed == 0);
            CHECK(f.norm() <= 1.0001 * b.body.law[0].k_n * radius);
        }
        CHECK(touching > 100);
    }
}

TEST_CASE("coupling: springs go along with a body that moves and turns") {
    for (const auto how : both) {
        // The sphere sticks: it is drawn along the skin, over edges, then both turn together.
        CouplingBench b(box_mesh({0.2, 0.2, 0.2}, 5, 5, 5, false), grain(ContactLaw::linear, 100.0, 1.0, 0.0), how, 1.0);
        b.spheres.add({-0.03, -0.01, 0.148}, 0.05, 2000.0);
        b.list(0.1);
        const double dt = 1e-4;
        b.spheres.velocity.set(0, {0.5, 0.2, 0.0});
        b.advance(1e-12);
        for (int n = 0; n < 1000; ++n) {
            b.move(dt);
            b.advance(dt);
        }
        const Vec3 shear = -b.body.law[0].k_t * 0.1 * Vec3(0.5, 0.2, 0.0);
        CHECK((b.force(0) - shear - b.body.law[0].k_n * Vec3(0, 0, 0.002)).norm() < 1e-6 * shear.norm());
        const Vec3 spin(3.0, -5.0, 4.0), drift(0.3, 0.2, 0.1);
        const Vec3 force = b.force(0), centre = b.spheres.position.at(0);
        const auto from = b.body.solid.position;
        b.spheres.spin.set(0, spin);
        const int steps = 3000;
        for (int n = 1; n <= steps; ++n) { // positions exactly on their circles, velocities in the middle of the steps
            const auto place = [&](const Vec3& x, double time) -> Vec3 {
                return Eigen::AngleAxisd(time * spin.norm(), spin.normalized()).toRotationMatrix() * x + time * drift;
            };
            const double time = n * dt;
            for (std::size_t k = 0; k < from.size(); ++k) {
                b.body.solid.position[k] = place(from[k], time);
                b.body.solid.velocity[k] = drift + spin.cross(place(from[k], time - 0.5 * dt) - (time - 0.5 * dt) * drift);
            }
            b.spheres.position.set(0, place(centre, time));
            b.spheres.velocity.set(0, drift + spin.cross(place(centre, time - 0.5 * dt) - (time - 0.5 * dt) * drift));
            b.advance(dt);
        }
        const Vec3 now = Eigen::AngleAxisd(steps * dt * spin.norm(), spin.normalized()).toRotationMatrix() * force;
        CHECK((b.force(0) - now).norm() < 1e-3 * force.norm());
    }
}

TEST_CASE("coupling: a spring outlives a skin that tilts under a sphere at rest") {
    for (const auto how : both) {
        CouplingBench b(sheet_membrane(0.2, 0.2, 1, 1), grain(ContactLaw::linear, 100.0, 1.0, 0.0), how, 0.0);
        b.spheres.add({0.0, 0.01, 0.049}, 0.05, 2000.0);
        b.list(0.1);
        b.spheres.velocity.set(0, {0.0, 0.1, 0.0});
        const double dt = 1e-4;
        b.advance(1e-12);
        for (int n = 0; n < 100; ++n) {
            b.move(dt);
            b.advance(dt);
        }
        b.spheres.velocity.set(0, Vec3::Zero());
        const double before = b.body.touches[0][0].history.slip.norm();
        CHECK(before == Approx(0.001).epsilon(1e-6));
        // About the x axis through the point under the centre, which thus stays where it is.
        const Vec3 pivot(0.0, b.spheres.position.at(0).y(), 0.0);
        for (int n = 0; n < 100; ++n) {
            for (std::size_t k = 0; k < 4; ++k) {
                b.body.solid.velocity[k] = Vec3(1.0, 0, 0).cross(b.body.solid.position[k] - pivot);
            }
            b.move(dt);
            b.advance(dt);
        }
        CHECK(b.body.touches[0][0].history.slip.norm() == Approx(before).epsilon(0.05)); // 0.01 rad
    }
}
