// A sphere thrown upwards (thesis 2.6.3, figs 2.10 to 2.12).
#include <cmath>

#include "lab/verification/cases.hpp"
#include "lab/verification/impact.hpp"

namespace proveta::verification {

namespace parabolic_flight_case {

constexpr double gravity = -10.0; // m/s2
constexpr double speed = 1.0;     // m/s
constexpr double flight = 0.2;    // s

struct Flight {
    std::vector<double> time, height, velocity; ///< at whole steps
    double residual = 0.0;                      ///< of the ledger at the end
};

Flight fly(Scheme scheme, int steps) {
    Material m;
    Spheres s;
    s.add({0, 0, 0}, 1.0, 1000.0); // as large as the engine's own check on wild speeds asks for
    s.velocity.set(0, {0, 0, speed});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0}, weight);
    Numerics numerics;
    numerics.time_step = flight / steps;
    numerics.scheme = scheme;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = {0, 0, gravity};
    Model model(s, {m}, none, weight, {}, numerics);
    Flight out;
    for (int n = 0; n <= steps; ++n) {
        const double height = model.spheres.position.z[0];
        const double before = model.spheres.velocity.z[0];
        model.step({}, true);
        const bool between = scheme == Scheme::velocity_verlet && n > 0;
        out.time.push_back(n * flight / steps);
        out.height.push_back(height);
        out.velocity.push_back(between ? 0.5 * (before + model.spheres.velocity.z[0]) : before);
    }
    out.residual = model.ledger().relative_residual();
    return out;
}

Outcome compute() {
    Outcome out;
    report::Plot height{"Height of a thrown sphere, ten steps (fig. 2.10)", "time [s]", "height [m]", {}, {}};
    report::Plot velocity{"Its velocity (fig. 2.11)", "time [s]", "velocity [m/s]", {}, {}};
    report::Plot error{
        "Error of the height at the end (fig. 2.12); the others have none", "log10 of steps a flight", "log10 of error [m]", {}, {}};
    for (const auto& [scheme, name, colour] : schemes) {
        const Flight ten = fly(scheme, 10);
        double off = 0.0;
        double off_speed = 0.0;
        for (std::size_t k = 0; k < ten.time.size(); ++k) {
            const double t = ten.time[k];
            off = std::max(off, std::fabs(ten.height[k] - (speed * t + 0.5 * gravity * t * t)));
            off_speed = std::max(off_speed, std::fabs(ten.velocity[k] - (speed + gravity * t)));
        }
        const std::string of = std::string(", ") + name;
        const bool exact = scheme == Scheme::taylor || scheme == Scheme::velocity_verlet;
        if (exact) {
            out.checks.push_back({"height, largest error" + of, 0.0, off, 1e-14, Compare::absolute, "m", "exact"}); // round-off
        } else {
            // The sums of the schemes: -+ g t dt / 2 beside the parabola.
            out.checks.push_back({"height, error at the end" + of, 0.5 * std::fabs(gravity) * flight * flight / 10.0, off, 1e-12,
                                  Compare::relative, "m", "linear"});
            report::Curve curve{name, {}, {}, colour};
            std::vector<double> errors;
            for (const int steps : {10, 20, 40, 80, 160, 320}) {
                errors.push_back(std::fabs(fly(scheme, steps).height.back()));
                curve.x.push_back(std::log10(steps));
                curve.y.push_back(std::log10(errors.back()));
            }
            error.curves.push_back(curve);
            out.checks.push_back({"order of height" + of, 1.0, std::log2(errors[4] / errors[5]), 1e-6, Compare::absolute, "", "linear"});
        }
        out.checks.push_back({"velocity, largest error" + of, 0.0, off_speed, 1e-14, Compare::absolute, "m/s", "exact"});
        height.curves.push_back({name, ten.time, ten.height, colour});
        velocity.curves.push_back({name, ten.time, ten.velocity, colour});
        if (exact) {
            out.checks.push_back({"energy ledger, residual" + of, 0.0, ten.residual, 1e-13, Compare::absolute, "", ""});
        }
    }
    out.plots = {height, velocity, error};
    return out;
}

} // namespace parabolic_flight_case

Case parabolic_flight() {
    using namespace parabolic_flight_case;
    return {"parabolic-flight", "2.6.3", "A sphere thrown upwards, ten steps, four schemes against the parabola.", false, compute};
}

} // namespace proveta::verification
