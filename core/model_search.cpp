// Which pairs are near each other, and which step they leave stable.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/model.hpp"

namespace proveta {

// Lists neighbours anew once two spheres, or a sphere and a wall, may have come nearer by more than the skin. Surfaces may be faster than
// any sphere and are listed by themselves. Where impacts count, a contact is listed before it begins, however far a step goes.
void Model::search() {
    const bool first = searches_ == 0;
    const double ahead = way_of_step();
    double platens_way = 0.0;
    for (std::size_t p = 0; p < platens_at_.size(); ++p) {
        platens_way = std::max(platens_way, std::fabs(walls.platens[p].position - platens_at_[p]));
    }
    const bool neighbours = search_anew_ || 2.0 * platens_way > skin_ || travel_.beyond(0.5 * (skin_ - ahead), spheres.position);
    if (neighbours) {
        check_places();
        look_ahead();
        contacts = search_contacts(spheres, bonds, clusters, materials, weight_, skin_, contacts, team_.get());
        platens_at_.resize(walls.platens.size());
        for (std::size_t p = 0; p < walls.platens.size(); ++p) {
            search_platen(spheres, materials, skin_, walls.platens[p]);
            platens_at_[p] = walls.platens[p].position;
        }
        arrange();
        travel_.restart(spheres.position);
        ++searches_;
    }
    bool surfaces = false;
    tracks_.resize(walls.surfaces.size());
    for (std::size_t p = 0; p < tracks_.size(); ++p) {
        SurfaceTrack& track = tracks_[p];
        if (search_anew_ || track.way > skin_ || track.spheres.beyond(skin_ - track.way - ahead, spheres.position)) {
            search_surface(spheres, materials, skin_, walls.surfaces[p], team_.get());
            track.spheres.restart(spheres.position);
            track.way = 0.0;
            surfaces = true;
        }
    }
    body_tracks_.resize(walls.bodies.size());
    for (std::size_t p = 0; p < body_tracks_.size(); ++p) {
        Deformable& body = walls.bodies[p];
        if (const double way = body.way(); search_anew_ || way > skin_ || body_tracks_[p].beyond(skin_ - way - ahead, spheres.position)) {
            search_deformable(spheres, materials, skin_, body, *team_);
            body_tracks_[p].restart(spheres.position);
            surfaces = true;
        }
    }
    search_anew_ = false;
    if (neighbours || surfaces) {
        follow_bodies(); // the bound looks at the skin as it is now
        keep_stable(first);
        if (numerics_.impact_steps > 0.0 && !first) {
            dt_ = std::min(dt_, impact_step(spheres, contacts, walls, skin_, numerics_.impact_steps));
        }
    }
}

// How far two bodies may approach each other in a step, m; 0 where impacts do not count.
double Model::way_of_step() const {
    if (numerics_.impact_steps <= 0.0) {
        return 0.0;
    }
    double speed = 2.0 * fastest_;
    for (const auto& surface : walls.surfaces) {
        speed = std::max(speed, fastest_ + surface.drive.velocity.norm() + surface.drive.spin.norm() * surface.reach());
    }
    return speed * dt_;
}

// The skin must be wide enough for pairs to be listed a step before they can meet.
void Model::look_ahead() {
    if (numerics_.impact_steps <= 0.0) {
        return;
    }
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        fastest_ = std::max(fastest_, spheres.velocity.at(k).norm());
    }
    if (const double least = 2.0 * way_of_step(); skin_ < least) {
        set_skin(least);
    }
}

// What was stable stays the bound, unless new contacts have made the network too stiff for the step. Then the spheres that they press on
// get more mass, as far as that is allowed, and only beyond that the step is shortened.
void Model::keep_stable(bool first) {
    const double share = damping_share();
    if (first) {
        stable_ = std::min(share * bound_.limit({spheres, bonds, contacts, walls, clusters}, growth()), stable_step_of_bodies());
        return;
    }
    if (!numerics_.refuse_unstable) {
        return; // the step stays as it is
    }
    const double bodies = stable_step_of_bodies();
    const double lowest = std::min(share * bound_.limit({spheres, bonds, contacts, walls, clusters}, growth(), dt_ / share), bodies);
    if (lowest >= dt_) {
        return;
    }
    stable_ = lowest;
    if (!scaling_.mass.empty()) {
        const double whole = std::accumulate(scaling_.mass.begin(), scaling_.mass.end(), 0.0);
        const double left = (numerics_.mass_scaling - scaling_.added_later) * whole;
        const double wanted = dt_ / (numerics_.safety * share);
        const Easing eased = ease_step(spheres, bonds, materials, weight_, contacts, walls, clusters, skin_, wanted, left, bound_);
        scaling_.added_later += eased.added / whole;
        ledger_.background += eased.energy;
        stable_ = std::min(share * eased.dt, bodies);
    }
    dt_ = std::min(dt_, numerics_.safety * stable_);
    constexpr double crushed = 0.01; // of the first step: whoever asks for less has lost its form
    if (bodies <= stable_ && dt_ < crushed * first_dt_) {
        std::ostringstream out;
        out.precision(4);
        out << "at step " << steps_ << " (time " << time_
            << " s) a deformable body has been stretched or crushed so far that its stable step fell from " << first_dt_ << " s to " << dt_
            << " s: a membrane that bursts is too thin or too soft for its pressure";
        throw NumericalFailure(out.str());
    }
}

// Share of the stable step that non-viscous damping leaves. Its force may point along the spring force and is alpha times as large, so that
// in the fastest mode it acts like springs stiffened by 1 + alpha.
double Model::damping_share() const {
    const BackgroundDamping& damping = numerics_.damping;
    return damping.viscous ? 1.0 : 1.0 / std::sqrt(1.0 + std::max(damping.translation, damping.rotation));
}

double Model::stable_step_of_bodies() const {
    double lowest = 1e300;
    for (const auto& body : walls.bodies) {
        lowest = std::min(lowest, proveta::stable_step(body, spheres, growth(), skin_));
    }
    return lowest;
}

void Model::follow_bodies() {
    for (auto& body : walls.bodies) {
        body.skin.follow(body.solid.position, body.solid.velocity, *team_);
    }
}

// The rows of the loads follow the lists of pairs.
void Model::arrange() { loads.arrange({{bonds.i, bonds.j, bonds.row_j}, {contacts.i, contacts.j, contacts.row_j}}); }

} // namespace proveta
