// Schemes, damping and rotation beyond the cases of `proveta verify`.
#include <catch2/catch.hpp>

#include <cmath>

#include "core/motion/rotation.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

Model free_sphere(const Numerics& numerics) {
    Spheres s;
    s.add({0, 0, 0}, 1.0, 1000.0);
    s.velocity.set(0, {0.5, 0, 0});
    s.spin.set(0, {0, 0, 2.0});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {Material{}}, {}, {0}, weight);
    return {s, {Material{}}, none, weight, {}, numerics};
}

} // namespace

TEST_CASE("viscous damping: motion dies out exponentially and its work is the energy lost") {
    Numerics numerics;
    numerics.time_step = 1e-3;
    numerics.damping = {3.0, 5.0, true};
    Model m = free_sphere(numerics);
    for (int k = 0; k < 1000; ++k) {
        m.step({}, true);
    }
    // Velocities stand half a step before the thousandth.
    CHECK(m.spheres.velocity.x[0] == Approx(0.5 * std::exp(-3.0 * 0.9995)).epsilon(1e-4));
    CHECK(m.spheres.spin.z[0] == Approx(2.0 * std::exp(-5.0 * 0.9995)).epsilon(1e-4));
    CHECK(std::fabs(m.ledger().relative_residual()) < 1e-3); // background damping is counted half a step ahead
}

TEST_CASE("viscous damping leaves the stable step as it is, however strong") {
    Spheres s = two_spheres(0.004);
    Material m = unbreakable();
    m.shear_factor = 0.0;
    std::vector<double> weight;
    for (const double rate : {1e4, 1e6, 1e9}) {
        Bonds b = make_bonds(s, {m}, {{0, 1}}, {0, 0}, weight);
        s.velocity.set(0, {1e-6, 0, 0});
        Numerics numerics;
        numerics.safety = 0.999;
        numerics.damping = {rate, rate, true};
        Model model(s, {m}, b, weight, {}, numerics);
        for (int k = 0; k < 5000; ++k) {
            model.step({}, false);
            REQUIRE(model.spheres.velocity.at(0).norm() < 1e-4); // near the limit the swing grows to 1/cos(theta/2) = 22 times the start
        }
    }
}

TEST_CASE("velocity Verlet starts with half a kick: a bonded pair set in motion follows the oscillator from its first step") {
    Spheres s = two_spheres(0.004);
    const Material m = unbreakable();
    s.velocity.set(0, {-1e-3, 0, 0});
    s.velocity.set(1, {1e-3, 0, 0});
    Bonds b = one_bond(s, m);
    std::vector<double> weight(2, 1.0);
    const double omega = std::sqrt(2.0 * b.stiffness[0] / s.mass[0]);
    // The same from the other end of the swing, where only a force starts it.
    for (const bool stretched : {false, true}) {
        Spheres start = s;
        const double reach = 2e-3 / omega;
        if (stretched) {
            start.velocity.fill(0.0);
            start.position.x[1] += reach;
        }
        Numerics numerics;
        numerics.damping = {0.0, 0.0};
        numerics.time_step = 0.1 / omega;
        Model model(start, {m}, b, weight, {}, numerics);
        const double theta = 2.0 * std::asin(0.05); // phase of a step of the scheme
        for (int k = 1; k <= 200; ++k) {
            model.step({}, true);
            const double stretch = model.spheres.position.x[1] - model.spheres.position.x[0] - 0.008;
            const double exact = stretched ? std::cos(k * theta) : std::sin(k * theta) * 0.1 / std::sin(theta);
            REQUIRE(stretch == Approx(reach * exact).margin(1e-6 * reach));
        }
        CHECK(std::fabs(model.ledger().relative_residual()) < 0.01); // of the scheme: (omega dt)^2/4
    }
}

TEST_CASE("rotation: a torque about a principal axis spins a body up; a sphere's spin follows its momentum in both schemes") {
    for (const bool rk4 : {true, false}) {
        rotation::State s = rotation::start({2.0, 3.0, 4.0}, rotation::Quaternion::Identity(), Vec3::Zero());
        for (int k = 0; k < 1000; ++k) {
            rk4 ? rotation::advance_rk4(s, {0, 0, 8.0}, 1e-3) : rotation::advance_direct(s, {0, 0, 8.0}, 1e-3);
        }
        CHECK(s.spin.z() == Approx(2.0)); // T t / I
        CHECK(rotation::energy(s) == Approx(0.5 * 4.0 * 4.0));
        const double angle = 2.0 * std::acos(s.attitude.w());
        CHECK(angle == Approx(1.0).epsilon(2e-3)); // T t^2 / 2 I, first order in the step
    }
    rotation::State ball = rotation::start({1.0, 1.0, 1.0}, rotation::Quaternion(0.5, 0.5, 0.5, 0.5), {1, 2, 3});
    rotation::advance_rk4(ball, {1, 0, 0}, 0.1);
    CHECK((ball.spin - Vec3(1.1, 2, 3)).norm() < 1e-14);
}
