// Laws of deformable bodies: Hooke at small strain, plasticity in closed form.
#include <catch2/catch.hpp>

#include <cmath>

#include "core/solids/solid_law.hpp"
#include "tests/bodies.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("solids: all laws are Hooke's at small strain") {
    Dice dice(5);
    for (const auto law : laws) {
        const SolidMaterial m = soft_solid(law, 1e9);
        for (int n = 0; n < 20; ++n) {
            const Mat3 turn = dice.turn();
            const Mat3 h = dice.matrix(1.0);
            const Mat3 strain = 0.5 * (h + h.transpose());
            const Mat3 hooke = m.lame().lambda * strain.trace() * Mat3::Identity() + 2.0 * m.lame().mu * strain;
            for (const double size : {1e-4, 1e-6}) { // the difference is of second order
                PlasticState state;
                const SolidResponse r = respond(m, turn * (Mat3::Identity() + size * h), &state);
                CHECK((turn.transpose() * r.first_piola - size * hooke).norm() < 20.0 * size * size * m.young_modulus);
                const double energy = 0.5 * size * size * (hooke.array() * strain.array()).sum();
                CHECK(r.stored == Approx(energy).epsilon(40.0 * size + 1e-9 / size));
            }
        }
    }
}

namespace {

SolidMaterial metal() {
    SolidMaterial m = soft_solid(SolidLaw::j2);
    m.young_modulus = 2e11;
    m.yield_stress = 3e8;
    m.hardening = 1e9;
    return m;
}

// Stretches a point to a logarithmic strain in one direction without stress in the others; returns the Kirchhoff stress. Adds up plastic
// and all work. sheet: the third direction is left to the solver of membranes.
struct Uniaxial {
    SolidMaterial m = metal();
    bool sheet = false;
    PlasticState state;
    double strain = 0.0, stress = 0.0, lateral = 1.0, across = 1.0, plastic = 0.0, stored = 0.0, work = 0.0;

    SolidResponse at(double log_strain, double narrow, PlasticState& trial, double& thickness) const {
        Mat3 F = Vec3(std::exp(log_strain), narrow, sheet ? thickness : narrow).asDiagonal();
        const SolidResponse r = sheet ? respond_in_plane(m, F, &trial) : respond(m, F, &trial);
        thickness = F(2, 2);
        return r;
    }
    void go(double to) {
        double low = 0.5 * lateral, high = 2.0 * lateral;
        for (int k = 0; k < 100; ++k) {
            PlasticState trial = state;
            double thickness = across;
            const double middle = 0.5 * (low + high);
            (at(to, middle, trial, thickness).first_piola(1, 1) > 0.0 ? high : low) = middle;
        }
        lateral = 0.5 * (low + high);
        const SolidResponse r = at(to, lateral, state, across);
        const double now = r.first_piola(0, 0) * std::exp(to);
        work += 0.5 * (stress + now) * (to - strain);
        plastic += r.plastic;
        stored = r.stored;
        stress = now;
        strain = to;
    }
};

} // namespace

TEST_CASE("solids: plasticity in tension and back, in closed form at large strain") {
    for (const bool sheet : {false, true}) {
        Uniaxial u;
        u.sheet = sheet;
        const double E = u.m.young_modulus, H = u.m.hardening, Y = u.m.yield_stress;
        const double tangent = E * H / (E + H);
        u.go(0.5 * Y / E);
        CHECK(u.stress == Approx(0.5 * Y).epsilon(1e-7));
        CHECK(u.state.strain == 0.0);
        u.go(Y / E); // corners of the curve are met, so that the trapezoidal area is exact
        for (int k = 1; k <= 50; ++k) {
            u.go(Y / E + 0.01 * k);
            CHECK(u.stress == Approx(Y + tangent * (u.strain - Y / E)).epsilon(1e-6));
        }
        const double top = u.stress;
        const double from = u.strain;
        CHECK(u.state.strain == Approx((top - Y) / H).epsilon(1e-5));
        u.go(from - top / E);
        CHECK(u.stress == Approx(0.0).margin(1e-6 * Y));
        u.go(from - 2.0 * top / E); // hardening is isotropic
        CHECK(u.stress == Approx(-top).epsilon(1e-6));
        for (int k = 1; k <= 20; ++k) {
            u.go(from - 2.0 * top / E - 0.02 * k);
            CHECK(u.stress == Approx(-top - tangent * 0.02 * k).epsilon(1e-6));
        }
        CHECK(u.stored == Approx(0.5 * u.stress * u.stress / E).epsilon(1e-6));
        CHECK(u.plastic == Approx(u.work - u.stored).epsilon(1e-6));
    }
}

TEST_CASE("solids: a plastic sheet in equal tension both ways") {
    SolidMaterial m = metal();
    Solid s = solid_of(sheet_membrane(0.2, 0.2, 3, 3), m);
    Team team(1);
    for (int k = 1; k <= 40; ++k) {
        const double strain = 0.005 * k;
        for (std::size_t n = 0; n < s.nodes(); ++n) {
            s.position[n] = std::exp(strain) * s.mesh().node[n];
        }
        s.forces(team);
        // e = tau (1 - nu)/E + (tau - Y)/(2 H): half the plastic strain in thickness goes into each direction.
        const double tau = (strain + 0.5 * m.yield_stress / m.hardening) / ((1.0 - m.poisson_ratio) / m.young_modulus + 0.5 / m.hardening);
        const double volume = std::exp(2.0 * tau * (1.0 - 2.0 * m.poisson_ratio) / m.young_modulus);
        const Mat3 stress = s.stresses()[4];
        CHECK(stress(0, 0) == Approx(tau / volume).epsilon(1e-7));
        CHECK(stress(1, 1) == Approx(tau / volume).epsilon(1e-7));
        CHECK(std::fabs(stress(2, 2)) < 1e-7 * tau);
        CHECK(s.plastic_strain()[4] == Approx((tau - m.yield_stress) / m.hardening).epsilon(1e-6));
    }
}
