// damped-critical-step, and the bound on whole specimens.
#include <catch2/catch.hpp>

#include <cmath>

#include "core/bonds/bond_forces.hpp"
#include "core/motion/motion.hpp"
#include "core/motion/stable_step.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// True if two bonded spheres, set in motion, stay bounded with this step.
bool stays_bounded(const Material& m, double dt, const Vec3& velocity, const Vec3& spin) {
    Spheres s = two_spheres(0.004);
    Bonds b = one_bond(s, m);
    Contacts none;
    none.incidence = make_incidence(2, {}, {});
    std::vector<BondFailure> failures;
    s.velocity.set(0, velocity);
    s.velocity.set(1, -velocity);
    s.spin.set(0, spin);
    s.spin.set(1, spin);
    for (int k = 0; k < 4000; ++k) {
        bond_forces(s, b, dt, false, failures);
        move_spheres(s, b, none, {0.0, 0.0}, dt, false);
        if (!(s.velocity.at(0).norm() < 1e3 * velocity.norm() + 1e3 * spin.norm())) {
            return false;
        }
    }
    return true;
}

double measured_limit(const Material& m, const Vec3& velocity, const Vec3& spin) {
    double stable = 1e-8;
    double unstable = 1e-4;
    for (int k = 0; k < 30; ++k) {
        const double dt = std::sqrt(stable * unstable);
        (stays_bounded(m, dt, velocity, spin) ? stable : unstable) = dt;
    }
    return stable;
}

} // namespace

TEST_CASE("damped-critical-step: the scheme is stable up to its own criterion, which the bound never passes") {
    for (const double xi : {0.0, 0.3, 0.6, 0.9}) {
        Material m = unbreakable();
        m.local_damping = xi;
        const Spheres s = two_spheres(0.004);
        const Bonds b = one_bond(s, m);
        const double mass = s.mass[0];
        const double k = b.stiffness[0];
        const double c = b.dashpot[0];
        // Relative normal motion: K = 2 k / m, C = 2 c / m; dt^2 K + 2 dt C = 4 for velocities that lag half a step.
        const double normal = (-2.0 * c + std::sqrt(4.0 * c * c + 8.0 * k * mass)) / (2.0 * k);
        // Shear with rotation: k_t (2/m + 2 R^2/I) = 7 k_t / m for solid spheres.
        const double shear = 2.0 / std::sqrt(7.0 * b.laws[0].shear_ratio * k / mass);
        INFO("xi " << xi);
        CHECK(measured_limit(m, {1e-9, 0, 0}, {0, 0, 0}) == Approx(normal).epsilon(0.02));
        // Both motions at once: the lower of the two limits shows.
        CHECK(measured_limit(m, {1e-9, 1e-9, 0}, {0, 0, -1e-7}) == Approx(std::min(normal, shear)).epsilon(0.02));
        Contacts none;
        none.incidence = make_incidence(2, {}, {});
        const double bound = StepBound(s, b).limit(s, b, none, {});
        CHECK(bound <= std::min(normal, shear) * (1 + 1e-9));
        CHECK(bound >= 0.7 * std::min(normal, shear));
    }
}

TEST_CASE("stable-step: the bound on a specimen lies below the power iteration's limit and near it") {
    const Deck deck = small_deck(1500);
    const Bench bench = set_up(deck, make_specimen(deck.specimen));
    const Model& m = *bench.model;
    const double critical = 2.0 / std::sqrt(largest_eigenvalue(m.spheres, m.bonds, 2000));
    Contacts none;
    none.incidence = make_incidence(m.spheres.size(), {}, {});
    const double bound = StepBound(m.spheres, m.bonds).limit(m.spheres, m.bonds, none, {});
    CHECK(bound <= critical * (1 + 1e-6));
    CHECK(bound >= 0.9 * critical);
    CHECK(m.stable_step() <= bound);
    CHECK(m.dt() == Approx(0.9 * m.stable_step()));
}

TEST_CASE("step: a user's step above the stable one is refused with both numbers") {
    const Deck deck = small_deck(300, R"({"numerics": {"time_step": "1 ms"}})");
    try {
        set_up(deck, make_specimen(deck.specimen));
        FAIL("accepted");
    } catch (const input::InputError& e) {
        REQUIRE(e.problems.size() == 1);
        CHECK(e.problems[0].path == "/numerics/time_step");
        CHECK(e.problems[0].found == "1 ms");
        CHECK(e.problems[0].expected.find("stable step of") != std::string::npos);
    }
}
