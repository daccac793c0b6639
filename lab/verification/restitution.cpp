// Restitution asked for and given back by both loose laws (thesis 2.5.1, 2.5.2).
#include <cmath>
#include <numbers>

#include "lab/verification/cases.hpp"
#include "lab/verification/impact.hpp"

namespace proveta::verification {

namespace restitution_case {

// Four thousand steps a contact: velocities that lag half a step shift the dashpot's force by xi pi / 8000 of its own, and e with it.
constexpr double steps = 4000.0;
constexpr double tolerance = 2e-3;

double given_back(ContactLaw law, RestitutionRule rule, bool tension, double asked) {
    Impact impact;
    impact.material = linear_material(520.83, impact.radius);
    double duration = std::numbers::pi * std::sqrt(impact.reduced_mass() / 520.83);
    if (law == ContactLaw::hertz) {
        impact.material.contact_law = law;
        impact.material.young_modulus = 1e5;
        duration = 4.167e-3; // of the impact without damping, see hertz-impact
    }
    impact.material.restitution_rule = rule;
    impact.material.contact_tension = tension;
    impact.material.contact_restitution = asked;
    impact.dt = duration / steps;
    return collide(impact).exit_speed / impact.speed;
}

// Schwager and Poeschel 2007: restitution of a linear contact that never pulls whose dashpot is that of (2.21).
double cut(double asked) {
    const double l = std::log(asked);
    const double xi = -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
    const double w = std::sqrt(1.0 - xi * xi);
    return std::exp(-xi / w * (std::numbers::pi - std::atan2(2.0 * xi * w, 1.0 - 2.0 * xi * xi)));
}

Outcome compute() {
    Outcome out;
    report::Plot plot{"Restitution given back", "restitution asked for", "restitution found", {}, {}};
    struct Variant {
        const char* name;
        ContactLaw law;
        RestitutionRule rule;
        bool tension;
        const char* colour;
        bool gives_back;
    };
    const Variant variants[] = {
        {"LS+D, may pull, by (2.21)", ContactLaw::linear, RestitutionRule::nominal, true, "#1f4e79", true},
        {"LS+D, cut, by (2.21)", ContactLaw::linear, RestitutionRule::nominal, false, "#c0392b", false},
        {"LS+D, cut, corrected", ContactLaw::linear, RestitutionRule::corrected, false, "#1e7b46", true},
        {"HM+D, may pull, by (2.21)", ContactLaw::hertz, RestitutionRule::nominal, true, "#b9770e", false},
        {"HM+D, may pull, sqrt(5/6)", ContactLaw::hertz, RestitutionRule::corrected, true, "#0e8a93", true},
        {"HM+D, cut, by (2.21)", ContactLaw::hertz, RestitutionRule::nominal, false, "#7d3c98", false},
        {"HM+D, cut, corrected", ContactLaw::hertz, RestitutionRule::corrected, false, "#111111", true},
    };
    for (const auto& v : variants) {
        report::Curve curve{v.name, {}, {}, v.colour};
        double worst = 0.0;
        double worst_cut = 0.0;
        for (int k = 1; k <= 9; ++k) {
            const double asked = 0.1 * k;
            const double e = given_back(v.law, v.rule, v.tension, asked);
            curve.x.push_back(asked);
            curve.y.push_back(e);
            worst = std::max(worst, std::fabs(e - asked));
            worst_cut = std::max(worst_cut, std::fabs(e - cut(asked)));
        }
        const std::string name = v.name;
        if (v.gives_back) {
            out.checks.push_back({name + ": worst error, e = 0.1 .. 0.9", 0.0, worst, tolerance, Compare::absolute, "", ""});
        } else if (v.law == ContactLaw::linear) {
            out.checks.push_back({name + ": e for 0.5", 0.550, curve.y[4], tolerance, Compare::absolute, "", ""});
            out.checks.push_back({name + ": e for 0.1", 0.253, curve.y[0], tolerance, Compare::absolute, "", ""});
            out.checks.push_back({name + ": worst distance from the closed form", 0.0, worst_cut, tolerance, Compare::absolute, "", ""});
        } else {
            // In the phase plane Hertz's contact is a linear one of 5/6 the stiffness: exp(-pi xi'/w'), xi' = sqrt(6/5) xi, and its cut
            // form.
            out.checks.push_back({name + ": e for 0.5", v.tension ? 0.466 : 0.523, curve.y[4], tolerance, Compare::absolute, "", ""});
        }
        plot.curves.push_back(curve);
    }
    out.plots = {plot};
    out.notes = {"Contacts of granular matter never pull (fig. 2.7). (2.21) supposes that they do, and a linear spring; the corrected rule "
                 "inverts the closed "
                 "form of the contact that is cut off when its force is zero (Schwager and Poeschel 2007), and scales it by sqrt(5/6) for "
                 "Hertz's law."};
    return out;
}

} // namespace restitution_case

Case restitution() {
    return {"restitution", "2.5.1, 2.5.2", "Restitution asked for and given back by LS+D and HM+D.", false, restitution_case::compute};
}

} // namespace proveta::verification
