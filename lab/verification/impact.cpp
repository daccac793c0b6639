#include "lab/verification/impact.hpp"

#include <cmath>
#include <numbers>

namespace proveta::verification {

using std::numbers::pi;

double Impact::mass() const { return density * 4.0 / 3.0 * pi * radius * radius * radius; }
double Impact::reduced_mass() const { return 0.5 * mass(); }

ImpactPath collide(const Impact& impact) {
    Spheres s;
    s.add({0, 0, 0}, impact.radius, impact.density);
    s.add({2.0 * impact.radius, 0, 0}, impact.radius, impact.density);
    s.velocity.set(0, {impact.speed, 0, 0});
    std::vector<double> weight;
    Bonds none = make_bonds(s, {impact.material}, {}, {0, 0}, weight);
    Numerics numerics;
    numerics.time_step = impact.dt;
    numerics.scheme = impact.scheme;
    numerics.damping = {0.0, 0.0};
    numerics.refuse_unstable = false;
    Model model(s, {impact.material}, none, weight, {}, numerics);
    const auto overlap = [&] { return 2.0 * impact.radius - (model.spheres.position.x[1] - model.spheres.position.x[0]); };
    const auto approach = [&] { return model.spheres.velocity.x[0] - model.spheres.velocity.x[1]; };

    ImpactPath path;
    for (int n = 0; n < 1000000; ++n) {
        const double now = overlap();
        const double before = approach();
        model.step({}, false);
        // Velocity Verlet's velocities live between the steps.
        const bool between = impact.scheme == Scheme::velocity_verlet && n > 0;
        path.time.push_back(n * impact.dt);
        path.overlap.push_back(now);
        path.approach.push_back(between ? 0.5 * (before + approach()) : before);
        path.deepest = std::max(path.deepest, now);
        if (n > 0 && now <= 0.0) {
            const auto last = path.overlap.size() - 2;
            const double share = path.overlap[last] / (path.overlap[last] - now);
            path.duration = (n - 1 + share) * impact.dt;
            // A contact that may pull would go on as an oscillator: there the speed is that of the passage.
            path.exit_speed = impact.material.contact_tension
                                  ? -(path.approach[last] + share * (path.approach[last + 1] - path.approach[last]))
                                  : -approach();
            break;
        }
    }
    return path;
}

Material linear_material(double stiffness, double radius) {
    Material m;
    m.young_modulus = 2.0 * stiffness / (pi * radius); // k_n = E pi R^2 / 2R
    m.contact_restitution = 1.0;
    return m;
}

namespace {

// From the last two steps of a range.
double order(const std::vector<double>& error, const std::vector<double>& step) {
    const auto n = error.size();
    return std::log(error[n - 2] / error[n - 1]) / std::log(step[n - 2] / step[n - 1]);
}

} // namespace

double Convergence::depth_order(std::size_t scheme) const { return order(depth[scheme], step); }
double Convergence::speed_order(std::size_t scheme) const { return order(speed[scheme], step); }

Convergence convergence(Impact impact, double duration, double depth) {
    Convergence out;
    for (double steps = 10.0; steps <= 320.0; steps *= 2.0) {
        impact.dt = duration / (steps + 0.5);
        out.step.push_back(impact.dt);
        for (std::size_t k = 0; k < schemes.size(); ++k) {
            impact.scheme = schemes[k].scheme;
            const ImpactPath path = collide(impact);
            out.depth[k].push_back(std::fabs(path.deepest / depth - 1.0));
            out.speed[k].push_back(std::fabs(path.exit_speed / impact.speed - 1.0));
        }
    }
    return out;
}

std::vector<report::Plot> impact_plots(Impact impact, double duration, const Convergence& errors, const std::string& law,
                                       const std::array<std::string, 3>& figures, double (*exact_overlap)(double),
                                       double (*exact_speed)(double)) {
    report::Plot depth{"Overlap in an impact, " + law + ", ten steps a contact (" + figures[0] + ")", "time [ms]", "overlap [mm]", {}, {}};
    report::Plot speed{"Speed of approach in the same impact (" + figures[1] + ")", "time [ms]", "speed of approach [m/s]", {}, {}};
    report::Plot error{"Errors over steps (" + figures[2] + ")", "log10 of steps a contact, t_c/dt", "log10 of relative error", {}, {}};
    report::Curve exact_depth{"exact", {}, {}, "#111111"};
    report::Curve exact_rate = exact_depth;
    for (int k = 0; k <= 100; ++k) {
        const double t = 0.01 * k * duration;
        exact_depth.x.push_back(1e3 * t);
        exact_depth.y.push_back(1e3 * exact_overlap(t));
        exact_rate.x.push_back(1e3 * t);
        exact_rate.y.push_back(exact_speed(t));
    }
    depth.curves.push_back(exact_depth);
    speed.curves.push_back(exact_rate);
    impact.dt = duration / 10.0;
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        impact.scheme = schemes[k].scheme;
        const ImpactPath path = collide(impact);
        report::Curve d{schemes[k].name, path.time, path.overlap, schemes[k].colour};
        report::Curve v{schemes[k].name, path.time, path.approach, schemes[k].colour};
        for (std::size_t n = 0; n < d.x.size(); ++n) {
            d.x[n] *= 1e3;
            d.y[n] *= 1e3;
            v.x[n] *= 1e3;
        }
        depth.curves.push_back(d);
        speed.curves.push_back(v);
        for (const bool of_depth : {true, false}) {
            report::Curve e{std::string(schemes[k].name) + (of_depth ? ", overlap" : ", exit speed"), {}, {}, schemes[k].colour};
            for (std::size_t n = 0; n < errors.step.size(); ++n) {
                e.x.push_back(std::log10(duration / errors.step[n]));
                e.y.push_back(std::log10(std::max((of_depth ? errors.depth : errors.speed)[k][n], 1e-16)));
            }
            error.curves.push_back(e);
        }
    }
    return {depth, speed, error};
}

} // namespace proveta::verification
