// Forces between spheres and the skin of a deformable body, contact by contact: balance, walls, continuity, shares.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "core/boundaries/surface_shapes.hpp"
#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// A skin of triangles of tetrahedra, of warped quadrilaterals or of membranes, some 10 cm wide and bumpy.
SolidMesh bumpy(int kind, Dice& dice) {
    SolidMesh mesh = kind == 2 ? sheet_membrane(0.3, 0.3, 6, 6) : box_mesh({0.3, 0.3, 0.2}, 4, 4, 3, kind == 0);
    for (auto& v : mesh.node) {
        v += dice.in_box(0.012);
    }
    return mesh;
}

// Puts spheres on random places of the skin.
void scatter(CouplingBench& b, Dice& dice, int spheres, double smallest, double largest) {
    const auto& g = b.body.skin.geometry();
    for (int k = 0; k < spheres; ++k) {
        const auto t = static_cast<std::uint32_t>(dice(0.0, static_cast<double>(b.body.skin.triangles())));
        Vec3 w(dice(0, 1), dice(0, 1), dice(0, 1));
        w /= w.sum();
        const double radius = std::exp(dice(std::log(smallest), std::log(largest)));
        b.spheres.add(b.body.skin.point(t, w) + dice(0.9, 1.02) * radius * g.plane[t].normal, radius, 2000.0);
    }
}

} // namespace

TEST_CASE("coupling: what spheres feel the nodes feel, forces and moments") {
    Dice dice(1);
    std::size_t touching = 0, several = 0;
    for (const auto how : both) {
        for (int kind = 0; kind < 3; ++kind) {
            for (int n = 0; n < 12; ++n) {
                const Material m = grain(n % 2 == 0 ? ContactLaw::linear : ContactLaw::hertz, 0.5, 0.5, 0.05);
                CouplingBench b(bumpy(kind, dice), m, how, n % 3 == 0 ? 0.0 : 1.0);
                scatter(b, dice, 300, 0.005, 0.1);
                for (std::size_t k = 0; k < b.spheres.size(); ++k) {
                    b.spheres.velocity.set(k, dice.in_box(1.0));
                    b.spheres.spin.set(k, dice.in_box(50.0));
                }
                for (auto& v : b.body.solid.velocity) {
                    v = dice.in_box(1.0);
                }
                b.list(0.01);
                for (int step = 0; step < 5; ++step) {
                    const SkinSums sums = b.advance(1e-4);
                    touching += static_cast<std::size_t>(sums.touching);
                    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
                    double size = 0.0, arm = 0.0;
                    for (std::size_t k = 0; k < b.spheres.size(); ++k) {
                        const Vec3 x = b.spheres.position.at(k);
                        force += b.force(k);
                        moment += x.cross(b.force(k)) + b.torque(k);
                        size += b.force(k).norm();
                        arm += x.norm() * b.force(k).norm();
                    }
                    for (std::size_t k = 0; k < b.body.solid.nodes(); ++k) {
                        force += b.body.solid.contact[k];
                        moment += b.body.solid.position[k].cross(b.body.solid.contact[k]);
                    }
                    REQUIRE(size > 0.0);
                    REQUIRE(force.norm() < 1e-13 * size * 10);
                    REQUIRE(moment.norm() < 1e-12 * arm);
                    b.move(1e-4);
                }
                for (const auto& block : b.body.touches) {
                    for (std::size_t k = 1; k < block.size(); ++k) {
                        several += block[k].sphere == block[k - 1].sphere ? 1 : 0;
                    }
                }
            }
        }
    }
    CHECK(touching > 50000);
    CHECK(several > 2000);
}

TEST_CASE("coupling: without friction there is no torque") {
    Dice dice(2);
    for (const auto how : both) {
        for (int kind = 0; kind < 3; ++kind) {
            CouplingBench b(bumpy(kind, dice), grain(ContactLaw::hertz, 0.0, 1.0, 0.0), how, 0.0);
            scatter(b, dice, 200, 0.01, 0.1);
            for (std::size_t k = 0; k < b.spheres.size(); ++k) {
                b.spheres.spin.set(k, dice.in_box(50.0));
            }
            b.list(0.01);
            b.advance(1e-4);
            for (std::size_t k = 0; k < b.spheres.size(); ++k) {
                CHECK(b.torque(k).norm() <= 1e-13 * b.spheres.radius[k] * b.force(k).norm());
            }
        }
    }
}

TEST_CASE("coupling: a flat skin however fine is a rigid wall to the sphere") {
    for (const auto how : both) {
        for (const int cells : {1, 7, 40}) {
            // Without dashpots: those against a membrane are of the mass of its nodes, those against a wall of the sphere's alone.
            const Material m = grain(ContactLaw::hertz, 0.4, 1.0, 0.05);
            CouplingBench b(sheet_membrane(0.4, 0.4, cells, cells), m, how, 0.0);
            Surface wall("wall", plane_surface(0.4, 0.4), m, 0.4);
            b.spheres.add({0.013, 0.024, 0.048}, 0.05, 2000.0);
            b.spheres.velocity.set(0, {0.3, 0.1, -0.2});
            b.spheres.spin.set(0, {3, 2, 1});
            b.list(0.01);
            search_surface(b.spheres, b.material, 0.01, wall);
            for (int n = 0; n < 20; ++n) {
                b.advance(1e-4);
                Loads loads(1);
                const WallSums sums = surface_forces(b.spheres, wall, 0, loads.blocks()[0], {1e-4, 1e-4}, loads);
                CHECK((b.force(0) + sums.reaction).norm() < 1e-11 * b.force(0).norm());
                CHECK((b.torque(0) - Vec3(loads.row(0).torque[0], loads.row(0).torque[1], loads.row(0).torque[2])).norm() <
                      1e-11 * 0.05 * b.force(0).norm());
                b.move(1e-4);
            }
        }
    }
}

TEST_CASE("coupling: two faces that tilt into a valley") {
    // By areas the force goes on as it was; directly it doubles where the second contact is found.
    for (const auto how : both) {
        SolidMesh mesh = sheet_membrane(0.2, 0.1, 2, 1);
        mesh.membranes = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
        CouplingBench b(mesh, grain(ContactLaw::linear, 0.0, 1.0, 0.0), how, 0.0);
        b.spheres.add({0.001, 0.0, 0.0}, 0.02, 2000.0);
        double last = 0.0, jump = 0.0;
        for (int n = 0; n <= 2000; ++n) {
            const double slope = 1e-5 * n;
            for (const std::uint32_t k : {0U, 2U, 3U, 5U}) {
                b.body.solid.position[k].z() = 0.1 * slope;
            }
            const double force = force_at(b, {0.0, 0.003, 0.019}).z();
            jump = std::max(jump, n == 0 ? 0.0 : std::fabs(force / last - 1.0));
            last = force;
        }
        if (how == Coupling::direct) {
            CHECK(jump == Approx(1.0).epsilon(0.01));
        } else {
            CHECK(jump < 1e-4);
        }
    }
}

TEST_CASE("coupling: a sphere slides over edges, ridges and corners without a jump") {
    Dice dice(3);
    // Faces of a convex body: whatever edge or corner comes, the contact is the nearest point.
    for (const auto how : both) {
        for (const bool flat : {true, false}) {
            SolidMesh mesh = flat ? sheet_membrane(0.4, 0.4, 9, 7) : box_mesh({0.2, 0.2, 0.2}, 3, 3, 3, true);
            CouplingBench b(mesh, grain(ContactLaw::linear, 0.0, 1.0, 0.0), how, 1.0);
            b.spheres.add({0, 0, 0}, 0.02, 2000.0);
            const double top = flat ? 0.0 : 0.1;
            Vec3 last = force_at(b, {-0.12, -0.11, top + 0.018});
            double jump = 0.0, mean = 0.0;
            for (int n = 1; n <= 4000; ++n) { // 60 um a step, from beyond the side of the box
                const Vec3 f = force_at(b, Vec3(-0.12, -0.11, top + 0.018) + n / 4000.0 * Vec3(0.2, 0.13, 0.0));
                jump = std::max(jump, (f - last).norm());
                mean += f.norm() / 4000.0;
                last = f;
            }
            CHECK(mean > 0.0);
            CHECK(jump < (flat ? 1e-9 : 0.1) * mean); // it turns around a sharp edge within some 30 steps
        }
    }
}

TEST_CASE("coupling: shares are those of the areas and sum to one") {
    Dice dice(4);
    double uneven = 0.0;
    // Planes of one height under the centre with a slope each way: equal overlaps, so that the force is k times overlap times the shares.
    for (int n = 0; n < 50; ++n) {
        SolidMesh mesh = sheet_membrane(0.4, 0.4, 2, 2);
        const double slope = dice(0.01, 0.3);
        for (auto& v : mesh.node) {
            v.z() = slope * std::fabs(v.x());
        }
        CouplingBench b(mesh, grain(ContactLaw::linear, 0.0, 1.0, 0.0), Coupling::area_distributed, 0.0);
        const double angle = std::atan(slope), radius = dice(0.02, 0.05), overlap = 0.05 * radius;
        b.spheres.add({0, 0, 0}, radius, 2000.0);
        const Vec3 f = force_at(b, {0.0, dice(-0.05, 0.05), (radius - overlap) / std::cos(angle)});
        const double k = b.body.law[0].k_n;
        CHECK(f.z() == Approx(k * overlap * std::cos(angle)).epsilon(1e-9));
        REQUIRE(b.body.touches[0].size() == 2);
        uneven = std::max(uneven, std::fabs(b.body.touches[0][0].force.norm() / (0.5 * k * overlap) - 1.0));
    }
    CHECK(uneven < 0.01); // a far triangle of the one plane may give way to the contact with the other
}
