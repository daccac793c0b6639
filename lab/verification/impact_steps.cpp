// Impacts under the automatic step of scenes: restitution and largest overlap, sphere on plane and sphere on sphere, against closed forms.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "lab/scene/scene_play.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace impact_steps_case {

using std::numbers::pi;

constexpr double young = 50e6; // Pa
constexpr double poisson = 0.2;
constexpr double apart = 0.0537; // of a radius, at the start: so that contacts begin in any part of a step

struct Stroke {
    ContactLaw law = ContactLaw::hertz;
    bool pair = false; // two spheres, or one and a plane
    double speed = 1.0;
    double restitution = 1.0;
    double radius = 0.005;
    double density = 2500.0;

    [[nodiscard]] double reduced_mass() const { return (pair ? 0.5 : 1.0) * density * 4.0 / 3.0 * pi * std::pow(radius, 3); }
    // Without damping: v sqrt(m/k) with k = E pi R / 2 of the linear law; (A.17) of Hertz's.
    [[nodiscard]] double depth() const {
        if (law == ContactLaw::linear) {
            return speed * std::sqrt(reduced_mass() / (0.5 * pi * young * radius));
        }
        const double stiff = young / (2.0 * (1.0 - poisson * poisson)) * std::sqrt(pair ? 0.5 * radius : radius);
        return std::pow(15.0 / 16.0 * reduced_mass() * speed * speed / stiff, 0.4);
    }
};

ParticleInput ball(const Stroke& stroke, double height, double speed) {
    ParticleInput p;
    p.size = 2.0 * stroke.radius;
    p.count = 1;
    const double room = stroke.radius * (1.0 + 1e-9);
    p.from = {-room, -room, height - room};
    p.to = {room, room, height + room};
    p.velocity = {0.0, 0.0, speed};
    return p;
}

Scene scene_of(const Stroke& stroke) {
    Scene scene;
    scene.gravity = {0.0, 0.0, 0.0};
    NamedMaterial m;
    m.material.values.density = stroke.density;
    m.material.values.young_modulus = young;
    m.material.values.poisson_ratio = poisson;
    m.material.values.contact_law = stroke.law == ContactLaw::linear ? "linear" : "hertz";
    m.material.values.contact_restitution = stroke.restitution;
    m.material.values.mu_d = 0.0;
    scene.materials = {m};
    const double r = stroke.radius;
    if (stroke.pair) {
        scene.particles = {ball(stroke, 0.0, 0.0), ball(stroke, (2.0 + apart) * r, -stroke.speed)};
    } else {
        SurfaceInput plane;
        plane.size = {20.0 * r, 20.0 * r};
        scene.surfaces = {plane};
        scene.particles = {ball(stroke, (1.0 + apart) * r, -stroke.speed)};
    }
    scene.stop.time = 1e3 * stroke.depth() / stroke.speed;
    return scene;
}

struct Found {
    double restitution = 0.0;
    double depth = 0.0;    // over the closed form of an impact without damping
    double residual = 0.0; // of the energy ledger
};

Found play(const Stroke& stroke) {
    const Scene scene = scene_of(stroke);
    ScenePlay play(scene);
    const Model& m = play.model();
    const auto parting = [&] {
        const auto& v = m.spheres.velocity.z;
        return v.size() > 1 ? v[1] - v[0] : v[0];
    };
    const auto overlaps = [&] {
        const auto& z = m.spheres.position.z;
        return z.size() > 1 ? std::fabs(z[1] - z[0]) < 2.0 * stroke.radius : z[0] < stroke.radius;
    };
    for (int k = 0; k < 100000 && (parting() < 0.0 || overlaps()); ++k) {
        play.step(false);
    }
    play.step(true);
    return {parting() / stroke.speed, m.largest_overlap() * stroke.radius / stroke.depth(), std::fabs(m.ledger().relative_residual())};
}

Outcome compute() {
    Outcome out;
    constexpr double of_restitution = 5e-3; // what scenes promise, of the restitution asked for
    constexpr double of_depth = 0.02;
    for (const auto law : {ContactLaw::linear, ContactLaw::hertz}) {
        for (const bool pair : {false, true}) {
            const std::string name =
                fmt::format("{}, sphere on {}", law == ContactLaw::linear ? "LS+D" : "HM+D", pair ? "sphere" : "plane");
            report::Plot plot{name + ": restitution found over that asked for", "speed [m/s]", "ratio", {}, {}};
            double worst_depth = 0.0;
            double worst_residual = 0.0;
            for (const double asked : {1.0, 0.9, 0.6, 0.3, 0.1}) {
                report::Curve curve{fmt::format("{}", asked), {}, {}, "#1f4e79"};
                double worst = 0.0;
                for (double speed = 0.1; speed < 41.0; speed *= 1.82) { // 11 speeds up to 40 m/s
                    for (const auto& [radius, density] : {std::pair{0.005, 2500.0}, {0.0004, 900.0}, {0.15, 7800.0}}) {
                        const Stroke stroke{law, pair, speed, asked, radius, density};
                        if (stroke.depth() > 0.9 * radius) {
                            continue; // the sphere would be squashed flat
                        }
                        const Found found = play(stroke);
                        worst = std::max(worst, std::fabs(found.restitution / asked - 1.0));
                        worst_residual = std::max(worst_residual, found.residual);
                        worst_depth = asked == 1.0 ? std::max(worst_depth, std::fabs(found.depth - 1.0)) : worst_depth;
                        if (radius == 0.005) {
                            curve.x.push_back(speed);
                            curve.y.push_back(found.restitution / asked);
                        }
                    }
                }
                out.checks.push_back(
                    {fmt::format("{}, e = {}: worst error", name, asked), 0.0, worst, of_restitution, Compare::absolute, "", ""});
                plot.curves.push_back(curve);
            }
            out.checks.push_back(
                {name + ", e = 1: worst error of the largest overlap", 0.0, worst_depth, of_depth, Compare::absolute, "", ""});
            out.checks.push_back({name + ": worst residual of the energy", 0.01, worst_residual, 0.0, Compare::at_most, "", ""});
            out.plots.push_back(plot);
        }
    }
    out.notes = {"Speeds of 0.1 to 40 m/s, radii of 0.4, 5 and 150 mm, densities of 900 to 7,800 kg/m3, as far as the overlap stays below "
                 "0.9 radii. The time step is the automatic one of scenes, which looks at how fast contacts close."};
    return out;
}

} // namespace impact_steps_case

Case impact_steps() {
    using namespace impact_steps_case;
    return {"impact-steps", "2.5.1, 2.5.2, A", "Restitution, largest overlap and energy of impacts under the automatic step of scenes.",
            false, compute};
}

} // namespace proveta::verification
