// lsd-impact and restitution for the loose contact law, through the whole engine.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

struct Impact {
    double restitution;
    double duration;    // s
    double penetration; // m
};

// Two unbonded spheres, of different groups, meet head on at v0 relative.
Impact collide(double asked, double v0, double steps_per_contact) {
    Material m = unbreakable();
    m.contact_restitution = asked;
    Spheres s;
    s.add({0, 0, 0}, 0.01, 100.0, 0);
    s.add({0.02, 0, 0}, 0.01, 100.0, 1);
    s.velocity.set(0, {0.5 * v0, 0, 0});
    s.velocity.set(1, {-0.5 * v0, 0, 0});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0, 0}, weight);
    const double k = m.young_modulus * std::numbers::pi * 0.01 * 0.01 / 0.02; // E A / L of the touching pair
    const double reduced = 0.5 * s.mass[0];
    const double t_c = std::numbers::pi * std::sqrt(reduced / k);
    Numerics numerics;
    numerics.time_step = t_c / steps_per_contact;
    numerics.damping = {0.0, 0.0};
    Model model(s, {m}, none, weight, {}, numerics);
    Impact out{0, 0, 0};
    bool touched = false;
    for (int n = 0; n < 20 * steps_per_contact; ++n) {
        const double gap = model.spheres.position.x[1] - model.spheres.position.x[0] - 0.02;
        out.penetration = std::max(out.penetration, -gap);
        if (gap < 0) {
            touched = true;
            out.duration += model.dt();
        } else if (touched) {
            break;
        }
        model.step({}, n % 50 == 0);
    }
    out.restitution = (model.spheres.velocity.x[1] - model.spheres.velocity.x[0]) / v0;
    return out;
}

} // namespace

TEST_CASE("lsd-impact: duration and depth of an undamped impact are those of the linear spring") {
    const double k = 28e9 * std::numbers::pi * 1e-4 / 0.02;
    const double reduced = 0.5 * 100.0 * 4.0 / 3.0 * std::numbers::pi * 1e-6;
    const Impact i = collide(1.0, 0.5, 500);
    CHECK(i.restitution == Approx(1.0).epsilon(1e-3));
    CHECK(i.duration == Approx(std::numbers::pi * std::sqrt(reduced / k)).epsilon(0.01)); // counted in whole steps of 0.2 %
    CHECK(i.penetration == Approx(0.5 * std::sqrt(reduced / k)).epsilon(1e-3));
}

TEST_CASE("restitution: the law without tension gives back 0.550 for 0.5 and 0.253 for 0.1") {
    CHECK(collide(0.5, 0.5, 2000).restitution == Approx(0.550).epsilon(0.005));
    CHECK(collide(0.1, 0.5, 2000).restitution == Approx(0.253).epsilon(0.01));
}
