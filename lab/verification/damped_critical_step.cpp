// Stability limit of one damped bond as the engine runs it, against the scheme's own criterion and the program's bound (thesis 2.6.4).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace damped_critical_step_case {

struct Bonded {
    Spheres spheres;
    Bonds bonds;
    std::vector<double> weight;
};

Material damped_material(double xi) {
    Material m; // strong enough never to leave the elastic range at the speeds below
    m.local_damping = xi;
    return m;
}

Bonded bonded_pair(const Material& m) {
    Bonded b;
    b.spheres.add({0, 0, 0}, 0.004, m.density);
    b.spheres.add({0.008, 0, 0}, 0.004, m.density);
    b.bonds = make_bonds(b.spheres, {m}, {{0, 1}}, {0, 0}, b.weight);
    return b;
}

Model model_of(Bonded b, const Material& m, double dt) {
    Numerics numerics;
    numerics.time_step = dt;
    numerics.damping = {0.0, 0.0};
    numerics.refuse_unstable = false;
    numerics.energy_made = std::numeric_limits<double>::infinity(); // that is what is looked for
    return {std::move(b.spheres), {m}, std::move(b.bonds), std::move(b.weight), {}, numerics};
}

// Spheres that fly apart, and with `shear` slide and roll on each other too.
bool stays_bounded(const Material& m, double dt, bool shear) {
    constexpr double speed = 1e-9; // m/s
    Bonded b = bonded_pair(m);
    b.spheres.velocity.set(0, {speed, shear ? speed : 0.0, 0});
    b.spheres.velocity.set(1, {-speed, shear ? -speed : 0.0, 0});
    for (std::size_t k = 0; k < 2 && shear; ++k) {
        b.spheres.spin.set(k, {0, 0, -100.0 * speed});
    }
    Model model = model_of(std::move(b), m, dt);
    for (int n = 0; n < 1500; ++n) {
        model.step({}, false);
        if (!(model.spheres.velocity.at(0).norm() < 1e3 * speed)) {
            return false;
        }
    }
    return true;
}

double measured_limit(const Material& m, double guess, bool shear) {
    double stable = 0.5 * guess;
    double unstable = 2.0 * guess;
    while (unstable / stable > 1.001) {
        const double dt = std::sqrt(stable * unstable);
        (stays_bounded(m, dt, shear) ? stable : unstable) = dt;
    }
    return std::sqrt(stable * unstable);
}

Outcome compute() {
    Outcome out;
    report::Plot plot{"Critical step of one bond over that without damping", "damping ratio xi", "step over 2/omega", {}, {}};
    report::Curve measured{"measured, normal motion", {}, {}, "#1f4e79"};
    report::Curve criterion{"(2.71)", {}, {}, "#c0392b"};
    report::Curve bound{"the program's bound", {}, {}, "#1e7b46"};
    for (int k = 0; k <= 9; ++k) {
        const double xi = 0.1 * k;
        const Material m = damped_material(xi);
        const Bonded pair = bonded_pair(m);
        const double mass = pair.spheres.mass[0];
        const double stiffness = pair.bonds.stiffness[0];
        // Relative normal motion: K = 2 k / m, C = 2 c / m with c = 2 xi sqrt(k m/2): dt^2 K + 2 dt C = 4, which is (2.71).
        const double undamped = 2.0 / std::sqrt(2.0 * stiffness / mass);
        const double c = 2.0 * xi * std::sqrt(0.5 * mass * stiffness);
        const double normal = (-2.0 * c + std::sqrt(4.0 * c * c + 8.0 * stiffness * mass)) / (2.0 * stiffness);
        // Shear with rotation: k_t (2/m + 2 R^2/I) = 7 k_t / m for solid spheres.
        const double shear = 2.0 / std::sqrt(7.0 * pair.bonds.groups[0].shear_ratio() * stiffness / mass);
        const double lowest = std::min(normal, shear);
        const double found = measured_limit(m, normal, false);
        const double own = model_of(pair, m, 0.1 * lowest).stable_step();
        for (auto [curve, value] : {std::pair{&measured, found}, {&criterion, normal}, {&bound, own}}) {
            curve->x.push_back(xi);
            curve->y.push_back(value / undamped);
        }
        if (k % 3 != 0) {
            continue;
        }
        char label[16];
        std::snprintf(label, sizeof label, "xi %.1f: ", xi);
        out.checks.push_back({std::string(label) + "normal motion", normal, found, 0.02, Compare::relative, "s", "(2.71)"});
        out.checks.push_back(
            {std::string(label) + "all motions", lowest, measured_limit(m, lowest, true), 0.02, Compare::relative, "s", ""});
        out.checks.push_back({std::string(label) + "the program's bound", lowest * (1.0 + 1e-9), own, 0.0, Compare::at_most, "s", ""});
        // Sphere by sphere the largest eigenvalues of stiffness and damping are added although they belong to different motions.
        out.checks.push_back({std::string(label) + "the bound is not wasteful", 0.7 * lowest, own, 0.0, Compare::at_least, "s", ""});
    }
    out.plots = {plot};
    out.plots[0].curves = {measured, criterion, bound};
    out.notes = {
        "The criterion of velocities that lag half a step, dt^2 K + 2 dt C = 4, is (2.71) for a single spring. The bound also covers "
        "sliding "
        "and rolling, whose limit is the lower one at small xi, and adds the worst stiffness to the worst damping although they belong "
        "to different motions."};
    return out;
}

} // namespace damped_critical_step_case

Case damped_critical_step() {
    using namespace damped_critical_step_case;
    return {"damped-critical-step", "2.6.4", "Measured stability limit of a damped bond against criterion and bound.", false, compute};
}

} // namespace proveta::verification
