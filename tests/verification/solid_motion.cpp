// Deformable bodies in motion: energy, momentum, damping, what holds and presses them, threads.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

Vec3 angular_momentum(const Solid& s) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < s.nodes(); ++k) {
        sum += s.mass()[k] * s.position[k].cross(s.velocity[k]);
    }
    return sum;
}

} // namespace

TEST_CASE("solids: the energy of a vibrating cantilever and of a vibrating sheet stays") {
    for (const bool sheet : {false, true}) {
        Solid s = sheet ? solid_of(sheet_membrane(0.2, 0.2, 8, 8), soft_solid(SolidLaw::neo_hookean))
                        : solid_of(box_mesh({0.4, 0.1, 0.1}, 8, 2, 2, false), soft_solid(SolidLaw::neo_hookean));
        s.holds.push_back(hold(s, sheet ? "rim" : "x-"));
        for (std::size_t k = 0; k < s.nodes(); ++k) {
            const Vec3 x = s.position[k];
            s.velocity[k].z() = sheet ? 5.0 * std::cos(std::numbers::pi * x.x() / 0.2) * std::cos(std::numbers::pi * x.y() / 0.2)
                                      : 20.0 * std::pow(x.x() + 0.2, 2);
        }
        for (const auto k : s.holds[0].node) {
            s.velocity[k].setZero();
        }
        Run run{s};
        run.dt = 0.25 * stable(s);
        // The kinetic energy is of the mean of two velocities: it wavers with the square of the step, so that means are compared.
        constexpr int window = 2000;
        double mean[2] = {0.0, 0.0};
        double stored = 0.0;
        for (int n = 0; n < 10 * window; ++n) {
            run.step();
            stored = std::max(stored, s.stored());
            mean[n < window ? 0 : 1] += n < window || n >= 9 * window ? run.energy() / window : 0.0;
        }
        INFO("after " << 10 * window * run.dt << " s; energy " << mean[0] << ", then " << mean[1] << ", stored at most " << stored);
        CHECK(stored > 0.5 * mean[0]);
        CHECK(std::fabs(mean[1] / mean[0] - 1.0) < 1e-3);
        CHECK(run.held == 0.0);
    }
}

TEST_CASE("solids: a free body keeps its momentum and its spin, damped or not") {
    Dice dice(1);
    for (const bool damped : {false, true}) {
        for (const auto law : {SolidLaw::kirchhoff, SolidLaw::neo_hookean, SolidLaw::j2}) {
            SolidMesh mesh = box_mesh({0.3, 0.2, 0.1}, 3, 2, 1, law != SolidLaw::kirchhoff);
            const SolidMesh sheet = sheet_membrane(0.2, 0.2, 2, 2);
            for (const auto& t : sheet.membranes) { // all elements in one body
                const auto n = static_cast<std::uint32_t>(mesh.node.size());
                mesh.membranes.push_back({n + t[0], n + t[1], n + t[2]});
            }
            for (const auto& v : sheet.node) {
                mesh.node.emplace_back(v + Vec3(0.5, 0, 0));
            }
            SolidMaterial m = soft_solid(law);
            m.stiffness_damping = damped ? 1e-4 : 0.0;
            Solid s = solid_of(mesh, m);
            for (auto& v : s.velocity) {
                v = Vec3(1, -2, 3) + dice.in_box(3.0);
            }
            Run run{s};
            run.dt = 0.5 * stable(s);
            const Vec3 linear = s.momentum(), angular = angular_momentum(s);
            for (int n = 0; n < 2000; ++n) {
                run.step();
            }
            CHECK((s.momentum() - linear).norm() < 1e-11 * linear.norm());
            CHECK((angular_momentum(s) - angular).norm() < 1e-10 * angular.norm());
            CHECK((run.rayleigh > 0.0) == damped);
        }
    }
}

TEST_CASE("solids: Rayleigh's damping takes a1/2 + a2 w^2/2 out of a mode") {
    // One cell whose upper nodes go up and down: w^2 = 2 (lambda + 2 mu)/(rho L^2).
    for (const auto& [a1, a2] : {std::pair{30.0, 0.0}, {0.0, 2e-5}, {10.0, 1e-5}}) {
        SolidMaterial m = soft_solid(SolidLaw::neo_hookean);
        m.mass_damping = a1;
        m.stiffness_damping = a2;
        Solid s = solid_of(box_mesh({0.1, 0.1, 0.1}, 1, 1, 1, false), m);
        s.holds.push_back(hold(s, "z-"));
        s.holds.push_back(hold(s, "z+", {true, true, false}));
        for (const auto k : s.holds[1].node) {
            s.velocity[k].z() = 1e-4;
        }
        const double w = std::sqrt(2.0 * (m.lame().lambda + 2.0 * m.lame().mu) / m.density) / 0.1;
        const double rate = 0.5 * a1 + 0.5 * a2 * w * w;
        Run run{s};
        const int per_period = 400;
        run.dt = 2.0 * std::numbers::pi / std::sqrt(w * w - rate * rate) / per_period;
        REQUIRE(run.dt < 0.5 * stable(s));
        const auto top = s.holds[1].node[0];
        double peak[2] = {0.0, 0.0};
        for (int n = 0; n < 10 * per_period; ++n) {
            run.step();
            double& of = peak[n < per_period ? 0 : 1];
            of = n < per_period || n >= 9 * per_period ? std::max(of, s.position[top].z() - 0.05) : of;
        }
        CHECK(std::log(peak[0] / peak[1]) == Approx(rate * 9.0 * per_period * run.dt).epsilon(5e-3));
    }
}

TEST_CASE("solids: a pressure that follows does the work of the volume") {
    Dice dice(2);
    Solid s = solid_of(sphere_membrane(0.1, 2), soft_solid(SolidLaw::neo_hookean));
    s.pressures.push_back({-3e3, s.mesh().membranes, 1.0}); // from inside
    const auto volume = [&] {
        double sum = 0.0;
        for (const auto& t : s.mesh().membranes) {
            sum += s.position[t[0]].dot(s.position[t[1]].cross(s.position[t[2]])) / 6.0;
        }
        return sum;
    };
    for (auto& x : s.position) {
        x += dice.in_box(0.001);
    }
    Run run{s};
    run.dt = 0.05 * stable(s);
    // The forces are p dV/dx, without a sum and without a moment.
    const double before = volume();
    run.step();
    const double initial = run.energy(); // of the shifts
    const Vec3 momentum = s.momentum();
    CHECK(momentum.norm() < 1e-13 * 3e3 * 0.1 * run.dt);
    CHECK(angular_momentum(s).norm() < 1e-14 * 3e3 * 0.1 * run.dt);
    double work = 0.0, now = 0.0;
    for (int n = 0; n < 4000; ++n) {
        const double last = run.pressure;
        now = volume();
        run.step();
        work = 0.5 * (last + run.pressure); // sums reach half a step beyond the forces
    }
    INFO("volume grew by " << now / before - 1.0 << ", work " << work << " J");
    CHECK(std::fabs(now / before - 1.0) > 0.02);
    CHECK(work == Approx(3e3 * (now - before)).epsilon(1e-4)); // the trapezoidal rule's error
    CHECK(std::fabs(run.residual() + initial) < 0.01 * work);
}

TEST_CASE("solids: what holds a body feels its forces and does its work") {
    // A bar drawn slowly, free at its sides but for three planes of symmetry; edges and corners are held by two and three of them.
    for (const auto law : {SolidLaw::neo_hookean, SolidLaw::j2}) {
        SolidMaterial m = soft_solid(law);
        m.mass_damping = 300.0;
        Solid s = solid_of(box_mesh({0.2, 0.1, 0.1}, 2, 1, 1, false), m);
        s.holds = {hold(s, "x-", {true, false, false}), hold(s, "y-", {false, true, false}), hold(s, "z-", {false, false, true}),
                   hold(s, "x+", {true, false, false})};
        Run run{s};
        run.dt = 0.5 * stable(s);
        const double end = 0.2; // strain
        const int steps = 12000;
        for (int n = 0; n < steps; ++n) {
            const double share = std::min(1.0, 2.0 * n / steps); // no jump at the start
            s.holds[3].velocity.x() = 0.2 * end * share * 4.0 / 3.0 / (steps * run.dt);
            run.step();
        }
        for (const auto k : group(s, "x-")) {
            CHECK(s.position[k].x() == -0.1);
        }
        for (const auto k : group(s, "y-")) {
            CHECK(s.position[k].y() == -0.05);
        }
        // Uniaxial stress in the middle of it: forces on both ends are that of the law.
        const Mat3 stress = s.stresses()[0];
        CHECK(std::fabs(stress(1, 1)) < 0.01 * stress(0, 0));
        const double area = (s.position[group(s, "y+")[0]].y() + 0.05) * (s.position[group(s, "z+")[0]].z() + 0.05);
        CHECK(s.holds[3].reaction.x() == Approx(-stress(0, 0) * area).epsilon(0.01));
        CHECK(s.holds[0].reaction.x() == Approx(stress(0, 0) * area).epsilon(0.01));
        CHECK(s.holds[0].reaction.y() == 0.0);
        CHECK(std::fabs(s.holds[1].reaction.y()) < 0.02 * stress(0, 0) * area);
        INFO("residual " << run.residual() << " of " << run.held);
        CHECK(std::fabs(run.residual()) < 1e-3 * run.held);
    }
}

TEST_CASE("solids: numbers of threads change no bit") {
    const auto run_with = [](int threads) {
        SolidMesh mesh = cylinder_mesh(0.1, 0.2, 3, 2, 5);
        const SolidMesh tube = tube_membrane(0.15, 0.2, 24, 8);
        const auto n = static_cast<std::uint32_t>(mesh.node.size());
        mesh.node.insert(mesh.node.end(), tube.node.begin(), tube.node.end());
        for (const auto& t : tube.membranes) {
            mesh.membranes.push_back({n + t[0], n + t[1], n + t[2]});
        }
        SolidMaterial m = soft_solid(SolidLaw::j2);
        m.stiffness_damping = 1e-5;
        Solid s = solid_of(std::move(mesh), m);
        Dice dice(6);
        for (auto& v : s.velocity) {
            v = dice.in_box(20.0);
        }
        s.holds.push_back(hold(s, "z-"));
        Team team(threads);
        SolidSums sums;
        const double dt = 0.5 * stable(s);
        for (int k = 0; k < 200; ++k) {
            s.forces(team);
            sums = s.move(team, dt, k == 0, {0, 0, -9.81}, {});
        }
        CHECK(s.plastic() > 0.0);
        std::vector<double> out{sums.kinetic, sums.held, sums.rayleigh, s.stored(), s.plastic()};
        for (const auto& x : s.position) {
            out.insert(out.end(), x.begin(), x.end());
        }
        return out;
    };
    CHECK(run_with(1) == run_with(2));
}
