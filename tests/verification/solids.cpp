// Elements of deformable bodies: patch tests, rotations, gradients, masses, and meshes that are refused.
#include <catch2/catch.hpp>

#include <Eigen/LU>
#include <cmath>

#include "core/solids/solid_law.hpp"
#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// A mesh with nodes shifted at random; those of a sheet stay in their plane unless it is to be bumpy.
SolidMesh distorted(BodyKind kind, Dice& dice, bool bumpy = false) {
    SolidMesh mesh =
        kind == BodyKind::membrane ? sheet_membrane(0.3, 0.4, 4, 5) : box_mesh({0.3, 0.3, 0.4}, 3, 3, 4, kind == BodyKind::tetrahedra);
    for (auto& v : mesh.node) {
        Vec3 shift = dice.in_box(0.015);
        shift.z() = kind == BodyKind::membrane && !bumpy ? 0.0 : shift.z();
        v += shift;
    }
    return mesh;
}

void deform(Solid& s, const Mat3& F, const Vec3& shift) {
    for (std::size_t k = 0; k < s.nodes(); ++k) {
        s.position[k] = F * s.mesh().node[k] + shift;
    }
}

std::vector<char> on_the_border(const SolidMesh& mesh) {
    std::vector<char> out(mesh.node.size(), 0);
    for (const auto& group : mesh.groups) {
        for (const auto k : group.node) {
            out[k] = 1;
        }
    }
    return out;
}

double largest(const std::vector<Vec3>& f) {
    double out = 0.0;
    for (const auto& v : f) {
        out = std::max(out, v.norm());
    }
    return out;
}

// True stress of a law at a gradient; of a sheet across z, whose stretch in thickness is found by halving.
Mat3 true_stress(const SolidMaterial& m, const Mat3& F, bool sheet) {
    if (!sheet) {
        PlasticState state;
        return respond(m, F, &state).first_piola * F.transpose() / F.determinant();
    }
    const Eigen::Matrix<double, 3, 2> in = F.leftCols<2>();
    const Vec3 normal = in.col(0).cross(in.col(1)).normalized();
    Mat3 whole;
    whole << in, normal;
    double low = 0.1, high = 10.0;
    for (int k = 0; k < 200; ++k) {
        whole.col(2) = 0.5 * (low + high) * normal;
        PlasticState state;
        const double across = normal.dot(respond(m, whole, &state).first_piola.col(2));
        (across > 0.0 ? high : low) = 0.5 * (low + high);
    }
    PlasticState state;
    return respond(m, whole, &state).first_piola * whole.transpose() / whole.determinant();
}

} // namespace

TEST_CASE("solids: patch test, any mesh, any law, any linear displacement") {
    Dice dice(1);
    Team team(2);
    double stress_error = 0.0, force_error = 0.0;
    for (const auto law : laws) {
        for (const auto kind : kinds) {
            for (int n = 0; n < 5; ++n) {
                const SolidMaterial m = soft_solid(law, 1e9);
                Solid s = solid_of(distorted(kind, dice), m);
                const Mat3 F = dice.turn() * (Mat3::Identity() + dice.matrix(0.2));
                REQUIRE(F.determinant() > 0.0);
                deform(s, F, dice.in_box(1.0));
                s.forces(team);
                const Mat3 expected = true_stress(m, F, kind == BodyKind::membrane);
                for (const auto& stress : s.stresses()) {
                    stress_error = std::max(stress_error, (stress - expected).norm() / m.young_modulus);
                }
                const auto f = s.element_forces();
                const auto border = on_the_border(s.mesh());
                for (std::size_t k = 0; k < f.size(); ++k) {
                    force_error = std::max(force_error, border[k] != 0 ? 0.0 : f[k].norm() / largest(f));
                }
            }
        }
    }
    CHECK(stress_error < 1e-9); // the sheets of j2: Newton's method ends at 1e-10 of the modulus
    CHECK(force_error < 1e-12); // round-off
}

TEST_CASE("solids: rotations and translations leave no stress, rigid spins no damping") {
    Dice dice(2);
    Team team(2);
    for (const auto law : laws) {
        for (const auto kind : kinds) {
            SolidMaterial m = soft_solid(law, 1e9);
            m.stiffness_damping = 1e-3;
            Solid s = solid_of(distorted(kind, dice, true), m);
            const double force = m.young_modulus * 0.1 * (kind == BodyKind::membrane ? 0.002 : 0.1); // of a strain of one on an element
            for (const double angle : {0.1, 2.0, std::acos(-1.0)}) {
                const Vec3 axis = dice.in_box(1.0).normalized();
                const Vec3 spin = dice.in_box(100.0);
                deform(s, Eigen::AngleAxisd(angle, axis).toRotationMatrix(), dice.in_box(5.0));
                for (std::size_t k = 0; k < s.nodes(); ++k) {
                    s.velocity[k] = Vec3(3, 2, 1) + spin.cross(s.position[k]);
                }
                s.forces(team);
                CHECK(largest(s.element_forces()) < 1e-11 * force);
                CHECK(std::fabs(s.stored()) < 1e-18 * m.young_modulus);
            }
        }
    }
}

TEST_CASE("solids: damping at small strain is a2 K v") {
    Dice dice(3);
    Team team(1);
    for (const auto kind : kinds) {
        SolidMaterial m = soft_solid(SolidLaw::neo_hookean);
        m.stiffness_damping = 1e-3;
        Solid s = solid_of(distorted(kind, dice), m);
        const Mat3 rate = dice.matrix(1.0);
        for (std::size_t k = 0; k < s.nodes(); ++k) {
            s.velocity[k] = rate * s.position[k];
        }
        s.forces(team);
        const auto damping = s.element_forces();
        // The same field as a displacement, small.
        std::fill(s.velocity.begin(), s.velocity.end(), Vec3::Zero());
        deform(s, Mat3::Identity() + 1e-7 * rate, Vec3::Zero());
        s.forces(team);
        const auto elastic = s.element_forces();
        for (std::size_t k = 0; k < damping.size(); ++k) {
            CHECK((damping[k] - m.stiffness_damping * 1e7 * elastic[k]).norm() < 1e-5 * largest(damping));
        }
    }
}

TEST_CASE("solids: forces are minus the gradient of the stored energy") {
    Dice dice(4);
    Team team(2);
    for (const auto law : laws) {
        for (const auto kind : kinds) {
            Solid s = solid_of(distorted(kind, dice, true), soft_solid(law, 1e9));
            deform(s, dice.turn() * (Mat3::Identity() + dice.matrix(0.15)), dice.in_box(1.0));
            for (auto& x : s.position) {
                x += dice.in_box(0.005);
            }
            s.forces(team);
            const auto f = s.element_forces();
            const auto from = s.position;
            for (int n = 0; n < 5; ++n) {
                std::vector<Vec3> way(s.nodes());
                double power = 0.0;
                for (std::size_t k = 0; k < way.size(); ++k) {
                    way[k] = dice.in_box(1.0);
                    power += f[k].dot(way[k]);
                }
                constexpr double h = 2e-7;
                double energy[2];
                for (int side = 0; side < 2; ++side) {
                    for (std::size_t k = 0; k < way.size(); ++k) {
                        s.position[k] = from[k] + (side == 0 ? h : -h) * way[k];
                    }
                    s.forces(team);
                    energy[side] = s.stored();
                }
                CHECK(-(energy[0] - energy[1]) / (2.0 * h) == Approx(power).epsilon(1e-6).margin(1e-6 * largest(f)));
            }
        }
    }
}

TEST_CASE("solids: a rotation on top turns the forces and nothing else, plastic or not") {
    Dice dice(6);
    Team team(2);
    for (const auto law : laws) {
        for (const auto kind : kinds) {
            SolidMaterial m = soft_solid(law, 1e9);
            m.yield_stress = 1e5;
            m.stiffness_damping = 1e-4;
            const SolidMesh mesh = distorted(kind, dice, true);
            Solid a = solid_of(mesh, m);
            Solid b = solid_of(mesh, m);
            const Mat3 stretch = dice.matrix(0.02);
            for (int step = 1; step <= 10; ++step) { // both go on, one turns meanwhile
                const Mat3 turn = Eigen::AngleAxisd(0.3 * step, Vec3(1, 2, 3).normalized()).toRotationMatrix();
                deform(a, Mat3::Identity() + step * stretch, Vec3::Zero());
                deform(b, turn * (Mat3::Identity() + step * stretch), Vec3(1, 2, 3));
                for (std::size_t k = 0; k < a.nodes(); ++k) {
                    a.velocity[k] = dice.in_box(1.0);
                    b.velocity[k] = turn * a.velocity[k];
                }
                a.forces(team);
                b.forces(team);
                const auto fa = a.element_forces(), fb = b.element_forces();
                for (std::size_t k = 0; k < fa.size(); ++k) {
                    REQUIRE((fb[k] - turn * fa[k]).norm() < 1e-7 * largest(fa)); // the sheets of j2, else round-off
                }
            }
            CHECK(b.plastic() == Approx(a.plastic()).epsilon(1e-7));
            CHECK((law != SolidLaw::j2 || a.plastic() > 0.0));
        }
    }
}

TEST_CASE("solids: nodes bear the integrals of their shape functions") {
    Dice dice(7);
    // Gauss's rule of five points, exact to degree nine.
    constexpr double at[5] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640};
    constexpr double weight[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891, 0.2369268850561891};
    for (int n = 0; n < 20; ++n) {
        SolidMesh mesh = box_mesh({1, 1, 1}, 1, 1, 1, false);
        for (auto& v : mesh.node) {
            v += dice.in_box(0.12);
        }
        const SolidMaterial m = soft_solid(SolidLaw::kirchhoff);
        const Solid s = solid_of(mesh, m);
        std::array<double, 8> mass{};
        for (int i = 0; i < 125; ++i) {
            const Vec3 own(at[i % 5], at[i / 5 % 5], at[i / 25]);
            constexpr double signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
            Mat3 jacobian = Mat3::Zero();
            std::array<double, 8> shape{};
            for (std::size_t a = 0; a < 8; ++a) {
                const double f[3] = {1 + signs[a][0] * own.x(), 1 + signs[a][1] * own.y(), 1 + signs[a][2] * own.z()};
                shape[a] = f[0] * f[1] * f[2] / 8.0;
                const Vec3 slope(signs[a][0] * f[1] * f[2], f[0] * signs[a][1] * f[2], f[0] * f[1] * signs[a][2]);
                jacobian += s.position[s.mesh().hexahedra[0][a]] * slope.transpose() / 8.0;
            }
            for (std::size_t a = 0; a < 8; ++a) {
                mass[a] += m.density * weight[i % 5] * weight[i / 5 % 5] * weight[i / 25] * shape[a] * jacobian.determinant();
            }
        }
        double worst = 0.0;
        for (std::size_t a = 0; a < 8; ++a) {
            worst = std::max(worst, std::fabs(s.mass()[s.mesh().hexahedra[0][a]] / mass[a] - 1.0));
        }
        CHECK(worst < 1e-12); // N det J is of degree three in each coordinate: two points are exact
    }
    for (const auto kind : kinds) {
        const SolidMesh mesh = distorted(kind, dice);
        double volume = volume_of(mesh);
        for (const auto& t : mesh.membranes) {
            volume += 0.5 * 0.002 * (mesh.node[t[1]] - mesh.node[t[0]]).cross(mesh.node[t[2]] - mesh.node[t[0]]).norm();
        }
        const Solid s = solid_of(mesh, soft_solid(SolidLaw::kirchhoff));
        double sum = 0.0;
        for (const double one : s.mass()) {
            sum += one;
        }
        CHECK(sum == Approx(1200.0 * volume).epsilon(1e-12));
    }
}

TEST_CASE("solids: what cannot be calculated with is refused") {
    const auto refused = [](const SolidMesh& mesh, double thickness = 0.002) {
        CHECK_THROWS_AS(Solid("bad", mesh, soft_solid(SolidLaw::kirchhoff), thickness), std::invalid_argument);
    };
    const SolidMesh box = box_mesh({1, 1, 1}, 2, 2, 2, false);
    refused({});
    for (const bool tetrahedra : {false, true}) {
        SolidMesh mesh = box_mesh({1, 1, 1}, 2, 2, 2, tetrahedra);
        mesh.node[13] += Vec3(1.2, 0, 0); // the middle beyond the side
        refused(mesh);
        mesh.node[13] = Vec3(0, 0, std::nan(""));
        refused(mesh);
    }
    SolidMesh mesh = box;
    mesh.hexahedra[3][2] = 999;
    refused(mesh);
    mesh = box;
    mesh.hexahedra[3][2] = mesh.hexahedra[3][1];
    refused(mesh);
    mesh = box;
    mesh.node.emplace_back(3, 3, 3);
    refused(mesh);
    mesh = box;
    std::swap_ranges(mesh.hexahedra[0].begin(), mesh.hexahedra[0].begin() + 4, mesh.hexahedra[0].begin() + 4);
    refused(mesh);
    refused(sheet_membrane(1, 1, 2, 2), 0.0);
    refused(sheet_membrane(1, 1, 2, 2), std::nan(""));
}
