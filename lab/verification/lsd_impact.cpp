// Impact of two spheres by LS+D without damping (thesis 2.6.3, figs 2.13 to 2.15, table 2.2).
#include <cmath>
#include <numbers>

#include "lab/verification/cases.hpp"
#include "lab/verification/impact.hpp"

namespace proveta::verification {

namespace lsd_impact_case {

constexpr double stiffness = 520.83; // N/m; table 2.2 says kN/m

const double frequency = [] {
    Impact impact;
    return std::sqrt(stiffness / impact.reduced_mass());
}();

Outcome compute() {
    Impact impact;
    impact.material = linear_material(stiffness, impact.radius);
    const double duration = std::numbers::pi / frequency;
    const double depth = impact.speed / frequency;
    Outcome out;
    impact.dt = duration / 1000.5;
    const ImpactPath fine = collide(impact);
    // A thousand steps a contact leave a second order scheme errors of 1e-6, the interpolated end of contact as much.
    out.checks = {{"contact time (2.65)", duration, fine.duration, 1e-5, Compare::relative, "s",
                   "4.17e-3 s in table 2.2, 1.99e-3 s in 2.3: exchanged"},
                  {"contact time, literal", 1.992e-3, fine.duration, 3e-4, Compare::relative, "s", ""}, // four digits
                  {"largest overlap (2.64)", depth, fine.deepest, 1e-5, Compare::relative, "m", ""},
                  {"exit speed", impact.speed, fine.exit_speed, 1e-5, Compare::relative, "m/s", ""}};
    const Convergence errors = convergence(impact, duration, depth);
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        const bool first = schemes[k].scheme == Scheme::forward_euler || schemes[k].scheme == Scheme::taylor;
        const std::string thesis = first ? "linear" : "quadratic";
        out.checks.push_back({std::string("order of overlap, ") + schemes[k].name, first ? 1.0 : 2.0, errors.depth_order(k), 0.1,
                              Compare::absolute, "", thesis});
        out.checks.push_back({std::string("order of exit speed, ") + schemes[k].name, first ? 1.0 : 2.0, errors.speed_order(k), 0.1,
                              Compare::absolute, "", thesis});
    }
    out.plots = impact_plots(
        impact, duration, errors, "LS+D", {"fig. 2.13", "fig. 2.14", "fig. 2.15"},
        [](double t) { return 0.5 / frequency * std::sin(frequency * t); }, [](double t) { return 0.5 * std::cos(frequency * t); });
    out.notes = {
        "From a contact that begins without overlap the first force is zero, so Symplectic Euler takes the very positions of velocity "
        "Verlet; only its velocities belong to other times."};
    return out;
}

} // namespace lsd_impact_case

Case lsd_impact() {
    using namespace lsd_impact_case;
    return {"lsd-impact", "2.6.3", "Impact of two spheres with a linear spring, four schemes against the harmonic oscillator.", false,
            compute};
}

} // namespace proveta::verification
