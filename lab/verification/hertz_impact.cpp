// Impact of two spheres by HM+D without damping (thesis 2.6.3, appendix A, figs 2.16 to 2.18, table 2.3).
#include <cmath>

#include "lab/verification/cases.hpp"
#include "lab/verification/impact.hpp"

namespace proveta::verification {

namespace hertz_impact_case {

constexpr double young = 1e5; // Pa; table 2.3 says 1e5 kN/m2
constexpr double poisson = 0.2;
constexpr double speed = 0.5; // m/s

// gamma = 16/15 E* sqrt(R_eq) / m_eq (A.17), with E* = E / (2 (1 - nu^2)), R_eq = R/2.
const double gamma_factor = [] {
    const Impact impact;
    return 16.0 / 15.0 * young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(0.5 * impact.radius) / impact.reduced_mass();
}();

// The exact path has no closed form in time: (A.18) by RK4 with steps of a thousandth of the contact, from the start.
struct Exact {
    double overlap, speed;
};

Exact exact(double t) {
    const auto pull = [](double d) { return -1.25 * gamma_factor * std::pow(std::max(d, 0.0), 1.5); };
    double d = 0.0;
    double v = speed;
    constexpr int steps = 1000;
    const double h = t / steps;
    for (int k = 0; k < steps; ++k) {
        const double k1 = pull(d);
        const double k2 = pull(d + 0.5 * h * v);
        const double k3 = pull(d + 0.5 * h * v + 0.25 * h * h * k1);
        const double k4 = pull(d + h * v + 0.5 * h * h * k2);
        d += h * v + h * h / 6.0 * (k1 + k2 + k3);
        v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return {d, v};
}

Outcome compute() {
    Impact impact;
    impact.material.young_modulus = young;
    impact.material.poisson_ratio = poisson;
    impact.material.contact_law = ContactLaw::hertz;
    impact.material.contact_restitution = 1.0;
    const double depth = std::pow(speed * speed / gamma_factor, 0.4);
    const double duration = 2.94328 * depth / speed; // (A.19b)
    Outcome out;
    impact.dt = duration / 1000.5;
    const ImpactPath fine = collide(impact);
    // Errors of a second order scheme at a thousand steps; the constant of (A.19b) has six digits.
    out.checks = {{"contact time (A.19b)", duration, fine.duration, 1e-5, Compare::relative, "s",
                   "1.99e-3 s in table 2.3, 4.17e-3 s in 2.2: exchanged"},
                  {"contact time, literal", 4.167e-3, fine.duration, 3e-4, Compare::relative, "s", ""}, // four digits
                  {"largest overlap (A.17)", depth, fine.deepest, 1e-5, Compare::relative, "m", ""},
                  {"exit speed", speed, fine.exit_speed, 1e-5, Compare::relative, "m/s", ""}};
    const Convergence errors = convergence(impact, duration, depth);
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        const std::string of_depth = std::string("order of overlap, ") + schemes[k].name;
        const std::string of_speed = std::string("order of exit speed, ") + schemes[k].name;
        if (schemes[k].scheme == Scheme::forward_euler || schemes[k].scheme == Scheme::taylor) {
            out.checks.push_back({of_depth, 1.0, errors.depth_order(k), 0.1, Compare::absolute, "", "linear"});
            out.checks.push_back({of_speed, 1.0, errors.speed_order(k), 0.1, Compare::absolute, "", "linear"});
        } else {
            // The force starts and fades out with the power 3/2 of the overlap, which mixes a term of order 5/2 into the errors.
            out.checks.push_back({of_depth, 1.9, errors.depth_order(k), 0.0, Compare::at_least, "", "quadratic"});
            out.checks.push_back({of_speed, 1.9, errors.speed_order(k), 0.0, Compare::at_least, "", "above quadratic"});
        }
    }
    out.plots = impact_plots(
        impact, duration, errors, "HM+D", {"fig. 2.16", "fig. 2.17", "fig. 2.18"}, [](double t) { return exact(t).overlap; },
        [](double t) { return exact(t).speed; });
    return out;
}

} // namespace hertz_impact_case

Case hertz_impact() {
    using namespace hertz_impact_case;
    return {"hertz-impact", "2.6.3, A", "Impact of two spheres by Hertz's law, four schemes against appendix A.", false, compute};
}

} // namespace proveta::verification
