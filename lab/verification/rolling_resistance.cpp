// A sphere that rolls on a plane until rolling resistance stops it (thesis 2.5.4).
#include <cmath>
#include <numbers>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace rolling_resistance_case {

constexpr double radius = 0.05, density = 2500.0, young = 1e7, poisson = 0.2; // m, kg/m3, Pa
constexpr double gravity = 9.81, speed = 0.2, eta = 0.05;                     // m/s2, m/s

struct Roll {
    report::Curve curve; ///< speed over time
    double arm = 0.0;    ///< radius less the overlap at rest, m
    double distance = 0.0, at_quarter = 0.0, quarter = 0.0, lowest = 0.0, left = 0.0, drift = 0.0, residual = 0.0;
};

Roll roll(ContactLaw law, const char* name, const char* colour) {
    Material m;
    m.young_modulus = young;
    m.poisson_ratio = poisson;
    m.contact_law = law;
    m.contact_restitution = 0.3;
    m.rolling_friction = eta;
    const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    // Overlap under the sphere's weight, wall and sphere alike: k = E pi R/2, or F = 4/3 E* sqrt(R) d^(3/2), E* = E/(2 (1 - nu^2)).
    const double stiff = young / (2.0 * (1.0 - poisson * poisson)) * 4.0 / 3.0 * std::sqrt(radius);
    const double overlap = law == ContactLaw::linear ? mass * gravity / (0.5 * young * std::numbers::pi * radius)
                                                     : std::pow(mass * gravity / stiff, 2.0 / 3.0);
    Roll out;
    out.arm = radius - overlap;
    Spheres s;
    s.add({0, 0, out.arm}, radius, density);
    s.velocity.set(0, {speed, 0, 0});
    s.spin.set(0, {0, speed / out.arm, 0});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0}, weight);
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = {0, 0, -gravity};
    numerics.time_step = 2e-5;
    const std::vector<Platen> floor{make_wall(s, {}, 0.0, m, 0.6)};
    Model model(s, {m}, none, weight, floor, numerics);
    out.curve = {name, {}, {}, colour};
    const int steps = 45000; // 0.9 s
    double rest = 0.0;
    out.quarter = 0.15;
    for (int n = 0; n < steps; ++n) {
        model.step({0.0}, n % 100 == 0 || n == steps - 1);
        const double v = model.spheres.velocity.x[0];
        out.lowest = std::min(out.lowest, v / speed);
        if (n == 7499) {
            out.at_quarter = v;
        }
        if (n == 35000) {
            rest = model.spheres.position.x[0];
        }
        out.left = n >= 35000 ? std::max(out.left, std::fabs(v) / speed) : 0.0;
        if (n % 100 == 0) {
            out.curve.x.push_back(model.time());
            out.curve.y.push_back(v);
        }
    }
    out.distance = model.spheres.position.x[0];
    out.drift = std::fabs(out.distance - rest);
    out.residual = std::fabs(model.ledger().residual()) / (0.7 * mass * speed * speed);
    return out;
}

Outcome compute() {
    Outcome out;
    report::Plot plot{"A sphere rolls to rest", "time [s]", "speed [m/s]", {}, {}};
    for (const auto& [law, name, colour] : {std::tuple{ContactLaw::linear, "LS+D", "#1f4e79"}, {ContactLaw::hertz, "HM+D", "#c0392b"}}) {
        const Roll r = roll(law, name, colour);
        // m a = -f, I a/r = f r - eta R m g:  a = -eta g R / (r + 2/5 R^2/r), r the lever arm of the soft contact.
        const double deceleration = eta * gravity * radius / (r.arm + 0.4 * radius * radius / r.arm);
        const std::string of = std::string(", ") + name;
        // The tangential spring swings in at the start: a few 1e-4 of the speed.
        out.checks.push_back(
            {"speed after 0.15 s" + of, speed - deceleration * r.quarter, r.at_quarter, 2e-3, Compare::relative, "m/s", ""});
        out.checks.push_back({"distance to rest" + of, 0.5 * speed * speed / deceleration, r.distance, 5e-3, Compare::relative, "m", ""});
        out.checks.push_back({"speed at rest over the first, 0.7 to 0.9 s" + of, 0.0, r.left, 1e-6, Compare::absolute, "", ""});
        out.checks.push_back({"drift at rest" + of, 0.0, r.drift, 1e-9, Compare::absolute, "m", ""});
        // The tangential spring lets go of m a / k_t when the sphere stops: a swing back far below a percent of the speed.
        out.checks.push_back({"lowest speed over the first: not driven back" + of, -0.01, r.lowest, 0.0, Compare::at_least, "", ""});
        out.checks.push_back(
            {"energy ledger, residual over the first kinetic energy" + of, 0.0, r.residual, 1e-3, Compare::absolute, "", ""});
        plot.curves.push_back(r.curve);
    }
    out.plots = {plot};
    return out;
}

} // namespace rolling_resistance_case

Case rolling_resistance() {
    using namespace rolling_resistance_case;
    return {"rolling-resistance", "2.5.4", "A sphere rolling on a plane is stopped by rolling resistance and stays at rest.", false,
            compute};
}

} // namespace proveta::verification
