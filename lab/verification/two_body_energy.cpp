// Two spheres and one bond through every mechanism: nothing is lost, nothing made.
#include <cmath>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace two_body_energy_case {

struct Motion {
    const char* name;
    Vec3 velocity; // of sphere 1 against sphere 0, m/s
    Vec3 spin;     // of sphere 0, rad/s
    double damping = 0.0;
    double background = 0.0;
    double bending = 0.0;
    double fracture_energy = 0.0;
    double safety = 0.05; // step over the stable one
    double tau_f = 16e6;
};

struct Balance {
    double worst = 0.0; // residual over the energy put in
    Ledger end;
    report::Curve spent;
};

Balance follow(const Motion& motion) {
    Material m;
    m.local_damping = motion.damping;
    m.as<Dempack>().tau_f = motion.tau_f;
    m.as<Dempack>().mu_s = 0.3;
    m.bending = m.twisting = motion.bending;
    m.as<Dempack>().fracture_energy_n = motion.fracture_energy;
    m.as<Dempack>().fracture_energy_t = 50.0 * motion.fracture_energy;
    Spheres s;
    s.add({0, 0, 0}, 0.004, 2500.0);
    s.add({0.0078, 0.0006, -0.0003}, 0.005, 2500.0); // overlapping a little, in no special direction
    std::vector<double> weight;
    Bonds bonds = make_bonds(s, {m}, {{0, 1}}, {0, 0}, weight);
    s.velocity.set(1, motion.velocity);
    s.spin.set(0, motion.spin);
    Numerics numerics;
    numerics.damping = {motion.background, motion.background};
    numerics.safety = motion.safety;
    Model model(s, {m}, bonds, weight, {}, numerics);
    const double input = 0.5 * s.mass[1] * motion.velocity.squaredNorm() + 0.5 * s.inertia[0] * motion.spin.squaredNorm();
    Balance out;
    out.spent.name = motion.name;
    for (int k = 0; k < 20000; ++k) {
        model.step({}, true);
        out.worst = std::max(out.worst, std::fabs(model.ledger().spent() - input) / input);
        if (model.time() < 30e-6) {
            out.spent.x.push_back(1e6 * model.time());
            out.spent.y.push_back(model.ledger().kinetic / input);
        }
    }
    out.end = model.ledger();
    return out;
}

} // namespace two_body_energy_case

Case two_body_energy() {
    using namespace two_body_energy_case;
    return {"two-body-energy", "5.2 (ledger)",
            "Two bonded spheres set in motion: the ledger through elasticity, damage, plasticity, friction, dashpots and moments.", false,
            [] {
                const Motion motions[] = {
                    {"elastic", {0.05, 0.02, 0.01}, {10, 30, 5}},
                    {"torn apart", {3.0, 0.2, 0.0}, {0, 0, 0}},
                    {"torn apart, G_f", {12.0, 0.2, 0.0}, {0, 0, 0}, 0.0, 0.0, 0.0, 20.0},
                    {"crushed", {-14.0, 0.0, 0.0}, {0, 0, 0}},
                    {"sheared under pressure, then friction", {-6.0, 14.0, 4.0}, {0, 0, 900}, 0.0, 0.0, 0.0, 0.0, 0.05, 1e5},
                    // Damping forces lag half a step, which is a first-order offset for a start at full speed: finer steps.
                    {"with dashpots", {-2.0, 1.0, 0.0}, {0, 300, 0}, 0.3, 0.0, 0.0, 0.0, 0.003},
                    {"with background damping", {-2.0, 1.0, 0.0}, {0, 300, 0}, 0.0, 0.2, 0.0, 0.0, 0.003},
                    {"with moments, torn apart", {2.5, 0.5, 0.3}, {300, 200, 100}, 0.0, 0.0, 1.0},
                };
                Outcome out;
                report::Plot plot{"Kinetic energy of two bonded spheres.", "time [us]", "kinetic energy over the input", {}, {}};
                const char* colours[] = {"#1f4e79", "#c0392b", "#d68910", "#7d3c98", "#1e7b46", "#b9770e", "#0e8a93", "#111111"};
                double used[6] = {};
                for (const auto& motion : motions) {
                    Balance b = follow(motion);
                    // A fraction of a percent is left to the steps in which a stiffness changes.
                    out.checks.push_back(
                        {std::string(motion.name) + ": worst residual over the energy put in", 1e-3, b.worst, 0.0, Compare::at_most, ""});
                    b.spent.colour = colours[plot.curves.size() % 8];
                    if (plot.curves.size() < 6) { // what fits in a picture
                        plot.curves.push_back(b.spent);
                    }
                    const double terms[6] = {b.end.damage, b.end.plastic, b.end.friction, b.end.dashpots, b.end.background, b.end.elastic};
                    for (int k = 0; k < 6; ++k) {
                        used[k] = std::max(used[k], terms[k]);
                    }
                }
                const char* names[6] = {"damage", "plastic", "friction", "dashpots", "background", "elastic"};
                for (int k = 0; k < 5; ++k) {
                    out.checks.push_back(
                        {std::string("the motions together use the term ") + names[k], 1e-9, used[k], 0.0, Compare::at_least, "J"});
                }
                out.plots.push_back(plot);
                return out;
            }};
}

} // namespace proveta::verification
