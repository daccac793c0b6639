// A sphere that swings between two plates on linear springs (thesis 2.6.4, fig. 2.19).
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lab/verification/cases.hpp"
#include "lab/verification/impact.hpp"

namespace proveta::verification {

namespace sphere_between_plates_case {

constexpr double radius = 0.004;   // m
constexpr double density = 2000.0; // kg/m3
constexpr double gap = 0.007;      // m
constexpr double stiffness = 1.0;  // N/m
constexpr double amplitude = 5e-4; // 1 mm into one plate, none into the other: half a millimetre off the middle
const double mass = density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
const double frequency = std::sqrt(2.0 * stiffness / mass);

struct Swing {
    std::vector<double> time, place; ///< s; distance from the middle over the amplitude
    double stable = 0.0;             ///< the program's own bound, s
    double energy_speed = 0.0;       ///< sqrt(x^2 + (v/omega)^2) over the amplitude, at the end
};

Swing swing(Scheme scheme, double dt, int steps) {
    Material m;
    m.young_modulus = 2.0 * stiffness / (std::numbers::pi * radius); // wall and sphere alike: k_n = E pi R / 2
    m.shear_factor = 0.0;
    m.contact_restitution = 1.0;
    m.contact_tension = true;
    Spheres s;
    s.add({0, 0, 0.5 * gap + amplitude}, radius, density);
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0}, weight);
    std::vector<Platen> plates{make_wall(s, {}, 0.0, m, 0.0), make_wall(s, {.inward = -1.0}, gap, m, 0.0)};
    Numerics numerics;
    numerics.time_step = dt;
    numerics.scheme = scheme;
    numerics.damping = {0.0, 0.0};
    numerics.skin = 2.0; // the springs hold whatever the distance
    numerics.refuse_unstable = false;
    Model model(s, {m}, none, weight, plates, numerics);
    Swing out;
    out.stable = model.stable_step();
    for (int n = 0; n <= steps; ++n) {
        const double x = (model.spheres.position.z[0] - 0.5 * gap) / amplitude;
        out.time.push_back(n * dt);
        out.place.push_back(x);
        out.energy_speed = std::hypot(x, model.spheres.velocity.z[0] / (frequency * amplitude));
        if (std::fabs(x) * amplitude > 0.5 * gap) {
            break; // through a plate
        }
        model.step({0.0, 0.0}, false);
    }
    return out;
}

double largest(const Swing& s) {
    double out = 0.0;
    for (const double x : s.place) {
        out = std::max(out, std::fabs(x));
    }
    return out;
}

Outcome compute() {
    const double critical = 2.0 / frequency;
    Outcome out;
    const Swing below = swing(Scheme::velocity_verlet, 0.999 * critical, 3000);
    const Swing above = swing(Scheme::velocity_verlet, 1.001 * critical, 3000);
    out.checks = {{"omega", 61.075, frequency, 1e-5, Compare::relative, "rad/s", "61.08"},
                  {"critical step, the program's bound", 0.0327465, below.stable, 2e-6, Compare::relative, "s", "0.03275, just above it"},
                  // Velocity Verlet from rest is cos(n theta) at any stable step: bounded by its start.
                  {"Velocity Verlet at 0.999: largest excursion", 1.0 + 1e-6, largest(below), 0.0, Compare::at_most, "A", "bounded"},
                  // cosh(25 kappa), cosh(kappa/2) = 1.001.
                  {"Velocity Verlet at 1.001: after 25 steps", std::cosh(50.0 * std::acosh(1.001)), std::fabs(above.place.at(25)), 1e-6,
                   Compare::relative, "A", "unstable"},
                  {"Velocity Verlet at 1.001: through the plate", 7.0, largest(above), 0.0, Compare::at_least, "A", "unstable"}};
    const double coarse = 0.003;
    const double theta = frequency * coarse;
    for (const auto& [scheme, name, colour] : schemes) {
        const Swing s = swing(scheme, coarse, 100);
        const std::string of = std::string(", ") + name;
        if (scheme == Scheme::forward_euler) {
            // Each step multiplies x + i v/omega by 1 - i theta.
            out.checks.push_back({"growth in 100 steps of 0.003 s" + of, std::pow(1.0 + theta * theta, 50.0), s.energy_speed, 1e-9,
                                  Compare::relative, "", "unstable, the most"});
        } else if (scheme == Scheme::taylor) {
            // Its step matrix has the determinant 1 + theta^2/2; within a turn x and v/omega trade a few percent.
            out.checks.push_back({"growth in 100 steps of 0.003 s" + of, std::pow(1.0 + 0.5 * theta * theta, 50.0), s.energy_speed, 0.1,
                                  Compare::relative, "", "unstable"});
        } else {
            // Bounded by 1/cos(theta/2) and the phase of Symplectic Euler's start.
            out.checks.push_back({"largest excursion at 0.003 s" + of, 1.0 + theta, largest(s), 0.0, Compare::at_most, "A", "stable"});
        }
    }
    // At 1e-4 s theta = 0.0061: over 0.1 s, a turn, Forward Euler gains 0.5 theta^2 a step (1.9 %), Taylor half of that; Symplectic Euler
    // starts half a step off (0.3 %), velocity Verlet lags by theta^3/24 a step.
    const double allowed[] = {0.021, 0.005, 0.011, 2e-5};
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        const Swing s = swing(schemes[k].scheme, 1e-4, 1000);
        double off = 0.0;
        for (std::size_t n = 0; n < s.time.size(); ++n) {
            off = std::max(off, std::fabs(s.place[n] - std::cos(frequency * s.time[n])));
        }
        out.checks.push_back({std::string("distance from the closed form at 1e-4 s, ") + schemes[k].name, 0.0, off, allowed[k],
                              Compare::absolute, "A", "converges"});
    }
    for (const auto& [dt, figure, until] : {std::tuple{critical * 0.999, "b", 1.0}, {coarse, "c", 0.3}, {1e-4, "d", 0.3}}) {
        char title[160];
        std::snprintf(title, sizeof title, "Sphere between plates, step %.5f s (fig. 2.19%s)", dt, figure);
        report::Plot plot{title, "time [s]", "distance from the middle [mm]", {}, {}};
        report::Curve exact{"exact", {}, {}, "#111111"};
        for (int k = 0; k <= 400; ++k) {
            exact.x.push_back(until * k / 400.0);
            exact.y.push_back(1e3 * amplitude * std::cos(frequency * exact.x.back()));
        }
        plot.curves.push_back(exact);
        for (const auto& [scheme, name, colour] : schemes) {
            const Swing s = swing(scheme, dt, static_cast<int>(until / dt));
            report::Curve curve{name, s.time, s.place, colour};
            for (auto& y : curve.y) {
                y *= 1e3 * amplitude;
            }
            plot.curves.push_back(curve);
        }
        out.plots.push_back(plot);
    }
    out.notes = {"A is the initial excursion, half a millimetre. The springs act both ways here; contacts of the laboratory never pull."};
    return out;
}

} // namespace sphere_between_plates_case

Case sphere_between_plates() {
    using namespace sphere_between_plates_case;
    return {"sphere-between-plates", "2.6.4", "A sphere on linear springs between two plates: where each scheme becomes unstable.", false,
            compute};
}

} // namespace proveta::verification
