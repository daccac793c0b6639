#include "lab/scene/scene_play.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/deck_doubts.hpp"
#include "lab/scene/scene_bodies.hpp"
#include "lab/scene/scene_samples.hpp"
#include "lab/scene/scene_surfaces.hpp"
#include "lab/scene/vectors.hpp"

namespace proveta {

namespace {

std::vector<Material> materials_of(const Scene& scene) {
    std::vector<Material> out;
    for (const auto& m : scene.materials) {
        out.push_back(to_material(m.material.values));
    }
    return out;
}

constexpr double most_steps = 1e9;  // some hours for a single particle
constexpr double longest_way = 0.5; // of a sphere or a surface in a step, over the mean radius: who goes farther might pass through another

Numerics numerics_of(const Scene& scene, const Feed& feed, const std::vector<Material>& materials) {
    const SceneNumerics& in = scene.numerics;
    Numerics n;
    n.safety = in.safety;
    n.time_step = in.time_step.word.empty() ? in.time_step.number : in.safety * stable_step(feed.kinds(), materials, in.largest_overlap);
    n.skin = in.skin.word.empty() ? in.skin.number : 0.2;
    n.damping = {in.damping, in.damping};
    n.refuse_unstable = in.above_bound == "refuse" || !in.time_step.word.empty();
    n.impacts = true;
    n.impact_steps = in.time_step.word.empty() ? 0.0 : in.impact_steps;
    n.fastest = longest_way; // who is flung out of a pinch is no failure
    n.gravity = vector(scene.gravity);
    n.overlap_growth = in.largest_overlap * mean_radius(feed.kinds());
    return n;
}

// How far a surface's fastest point goes in a step, m.
double way_in_step(const SurfaceVelocity& drive, const Surface& surface, double dt) {
    return (drive.velocity.norm() + drive.spin.norm() * surface.reach()) * dt;
}

} // namespace

ScenePlay::ScenePlay(const Scene& scene) : scene_(scene), feed_(scene), mean_radius_(mean_radius(feed_.kinds())) {
    notes_ = likely_without_unit(input::quantities(scene));
    const auto materials = materials_of(scene);
    auto surfaces = make_surfaces(scene, materials, notes_);
    const Walls walls({}, std::move(surfaces), make_bodies(scene, materials, notes_));
    Population first = feed_.first(walls);
    for (const auto& s : scene.surfaces) {
        motions_.push_back(make_motion(s.motion, scene.folder));
    }
    Numerics numerics = numerics_of(scene, feed_, materials);
    const auto set_up = [&] {
        std::vector<double> weight;
        Bonds none = make_bonds(first.spheres, materials, {}, std::vector<std::uint8_t>(first.spheres.size(), 0), weight);
        model_ = std::make_unique<Model>(first.spheres, materials, std::move(none), std::move(weight), walls, numerics, first.clusters);
    };
    try {
        set_up();
    } catch (const UnstableStep& step) {
        if (scene.numerics.time_step.word.empty()) {
            throw;
        }
        numerics.time_step = scene.numerics.safety * step.stable; // the first particles touch more closely than reckoned
        set_up();
    }
    if (const double steps = scene.stop.time / model_->dt(); steps > most_steps) {
        throw input::InputError(
            {{scene.source, "/stop/time", fmt::format("{:.4g} s, {:.2g} steps of {:.3g} s", scene.stop.time, steps, model_->dt()),
              fmt::format("at most {:.4g} s, {:.0g} steps: no end is in sight of more", most_steps * model_->dt(), most_steps),
              "less time, or a softer young_modulus or larger particles, which make longer steps"}});
    }
    refuse_fast();
    model_->set_skin(numerics.skin * mean_radius_); // the first particles may be none, or the smallest
}

// Particles that come too fast for the step as it is now, and surfaces that will be, seen at a thousand moments; what these miss is seen as
// they move.
void ScenePlay::refuse_fast() const {
    constexpr int moments = 1000;
    input::Problems problems;
    const double most = longest_way * mean_radius_ / model_->dt();
    for (std::size_t k = 0; k < scene_.particles.size(); ++k) {
        if (const double speed = vector(scene_.particles[k].velocity).norm(); speed > most) {
            problems.push_back(
                {scene_.source, fmt::format("/particles/{}/velocity", k),
                 fmt::format("{:.3g} m/s, {:.3g} m in a step of {:.3g} s", speed, speed * model_->dt(), model_->dt()),
                 fmt::format("at most {:.2g} mean radii in a step, {:.3g} m/s: who is faster might pass through others", longest_way, most),
                 "less speed, or a shorter numerics.time_step"});
        }
    }
    for (std::size_t k = 0; k < motions_.size(); ++k) {
        const Surface& surface = model_->walls.surfaces[k];
        double fastest = 0.0;
        double when = 0.0;
        for (int m = 0; m < moments; ++m) {
            const double t = scene_.stop.time * m / moments;
            const double way = way_in_step(motions_[k]->at(t, model_->dt(), surface, model_->spheres), surface, model_->dt());
            if (way > fastest) {
                fastest = way;
                when = t;
            }
        }
        if (fastest > longest_way * mean_radius_) {
            problems.push_back(
                {scene_.source, fmt::format("/surfaces/{}/motion", k),
                 fmt::format("{:.3g} m/s at {:.3g} s, {:.3g} m in a step of {:.3g} s", fastest / model_->dt(), when, fastest, model_->dt()),
                 fmt::format("at most {:.2g} mean radii in a step, {:.3g} m/s: a faster surface might pass through particles", longest_way,
                             longest_way * mean_radius_ / model_->dt()),
                 "let it go slower, or give a shorter numerics.time_step"});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

void ScenePlay::step(bool measure) {
    feed_.look_after(*model_);
    choose_skin();
    for (std::size_t k = 0; k < motions_.size(); ++k) {
        Surface& surface = model_->walls.surfaces[k];
        surface.drive = motions_[k]->at(model_->time(), model_->dt(), surface, model_->spheres);
        const double way = way_in_step(surface.drive, surface, model_->dt());
        if (!(way <= longest_way * mean_radius_)) {
            throw NumericalFailure(
                fmt::format("surface \"{}\" goes {:.3g} m in a step of {:.3g} s, more than {:.2g} mean radii, and might pass "
                            "through particles: let it go slower or give a shorter time_step",
                            surface.name, way, model_->dt(), longest_way));
        }
    }
    drive_bodies(scene_, model_->time(), model_->walls.bodies);
    model_->step({}, measure);
}

// A wide skin lists many pairs that do not touch, a narrow one has them listed often. With s the skin over the mean radius and v the way in
// a step of what moves fastest over that radius, a step costs about 3/4 + (1 + s/2)^3 / 4 + 12 v/s: for the pairs that touch, for those
// that are listed, and for listing. What was searched of late tells v; no clock is read, so that runs repeat themselves.
void ScenePlay::choose_skin() {
    constexpr std::int64_t every = 2048;
    constexpr double listing = 12.0;
    if (scene_.numerics.skin.word.empty() || model_->steps() < chosen_at_ + every) {
        return;
    }
    const double radius = mean_radius_;
    const double way = model_->skin() / radius * static_cast<double>(model_->searches() - searches_) / static_cast<double>(every);
    chosen_at_ = model_->steps();
    searches_ = model_->searches();
    double best = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (const double s : {0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5}) {
        const double cost = 0.75 + 0.25 * std::pow(1.0 + 0.5 * s, 3) + listing * way / s;
        if (cost < least) {
            least = cost;
            best = s;
        }
    }
    if (std::fabs(best * radius - model_->skin()) > 1e-9 * radius) {
        model_->set_skin(best * radius);
        ++searches_; // the one that this asks for
    }
}

// First who is there, so that there is room for what they do.
void ScenePlay::visit_state(StateVisitor& visit) {
    feed_.visit_state(visit);
    visit("skin_chosen_at", chosen_at_);
    visit("searches_until_then", searches_);
    Spheres spheres = model_->spheres;
    Clusters clusters = model_->clusters;
    spheres.visit_members(visit);
    clusters.visit_members(spheres.size(), visit);
    if (spheres.id != model_->spheres.id) { // those that are being restored are others than those of the start
        const std::vector<std::int32_t> all_new(spheres.size(), -1);
        model_->repopulate(std::move(spheres), std::move(clusters), all_new);
    }
    model_->visit_state(visit);
}

std::string ScenePlay::over() const {
    if (model_->time() >= scene_.stop.time) {
        return "its time is over";
    }
    if (scene_.stop.rest <= 0.0 || !feed_.finished()) {
        return "";
    }
    const bool moving = std::any_of(model_->walls.surfaces.begin(), model_->walls.surfaces.end(), [&](const Surface& s) {
        return s.drive.velocity.norm() > scene_.stop.rest || s.drive.spin.norm() * s.reach() > scene_.stop.rest;
    });
    const bool pushed = std::any_of(model_->walls.bodies.begin(), model_->walls.bodies.end(), [&](const Deformable& b) {
        return still_driven(b, model_->time(), scene_, static_cast<std::size_t>(&b - model_->walls.bodies.data()));
    });
    const SceneState state = state_of(*model_);
    // Before anything has fallen everything rests.
    const bool began = model_->time() > 0.02 * scene_.stop.time;
    return !moving && !pushed && began && state.rms_speed < scene_.stop.rest
               ? fmt::format("at rest: root mean square speed below {:.3g} m/s", scene_.stop.rest)
               : "";
}

} // namespace proveta
