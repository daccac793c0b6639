// The motion of a step: bodies, spheres, clusters, platens and surfaces.
#include <algorithm>
#include <cmath>

#include "core/model.hpp"

namespace proveta {

// Work of gravity since the start.
double Model::body_work() const {
    double sum = body_gone_;
    for (std::size_t k = 0; k < clusters.alone(spheres); ++k) {
        sum += (scaling_.mass.empty() ? spheres.mass[k] : scaling_.mass[k]) *
               numerics_.gravity.dot(spheres.position.at(k) - spheres.start.at(k));
    }
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        sum += clusters.mass[k] * numerics_.gravity.dot(clusters.position[k] - clusters.start[k]);
    }
    return sum;
}

// Moves the deformable bodies and returns the highest speed of a node.
double Model::move_bodies(const std::vector<double>& speeds, bool measure) {
    std::vector<Vec3> platens;
    for (std::size_t p = 0; p < walls.platens.size() && p < speeds.size(); ++p) {
        platens.emplace_back(speeds[p] * walls.platens[p].face.axis);
    }
    double fastest = 0.0;
    bodies_kinetic_ = 0.0;
    for (auto& body : walls.bodies) {
        const SolidSums sums = body.solid.move(*team_, dt_, steps_ == 0, numerics_.gravity, platens, 0.5 * (last_dt_ + dt_));
        ledger_.platens += sums.held;
        ledger_.pressure += sums.pressure;
        ledger_.dashpots += sums.rayleigh;
        bodies_weighed_ += sums.body;
        bodies_kinetic_ += sums.kinetic;
        fastest = std::isfinite(sums.fastest) ? std::max(fastest, sums.fastest) : sums.fastest;
    }
    if (measure && !numerics_.gravity.isZero()) {
        ledger_.body = body_work() + bodies_weighed_;
    }
    return fastest;
}

// Moves spheres, then clusters, part by part.
MotionSums Model::move(bool measure) {
    const bool first = steps_ == 0;
    const MotionRule rule{numerics_.scheme, numerics_.damping, numerics_.gravity, 0.5 * (last_dt_ + dt_)};
    const auto& blocks = loads.blocks();
    const auto alone = static_cast<std::uint32_t>(clusters.alone(spheres));
    constexpr std::size_t bodies_per_part = 32;
    const std::size_t parts = (clusters.size() + bodies_per_part - 1) / bodies_per_part;
    block_motion_.resize(blocks.size() + parts);
    team_->run(blocks.size() + parts, [&](std::size_t k) {
        if (k >= blocks.size()) {
            const std::size_t begin = (k - blocks.size()) * bodies_per_part;
            block_motion_[k] = move_clusters(clusters, spheres, loads, begin, std::min(begin + bodies_per_part, clusters.size()), rule, dt_,
                                             first, measure);
            return;
        }
        SphereBlock block = blocks[k];
        block.end = std::min(block.end, alone);
        block_motion_[k] = block.begin < block.end ? move_spheres(spheres, loads, block, rule, dt_, first, measure) : MotionSums{};
    });
    MotionSums sums;
    for (const auto& part : block_motion_) {
        sums.damping_work += part.damping_work;
        sums.kinetic += part.kinetic;
        sums.unbalanced += part.unbalanced;
        sums.fastest = std::isnan(part.fastest) ? part.fastest : std::max(sums.fastest, part.fastest);
    }
    return sums;
}

void Model::motion(const std::vector<double>& speeds, bool measure) {
    const bool first = steps_ == 0;
    const double of_bodies = move_bodies(speeds, measure);
    const MotionSums sums = move(measure || first);
    if (first) {
        ledger_.initial = sums.kinetic + bodies_kinetic_ + ledger_.elastic;
    }
    double fastest = std::sqrt(sums.fastest);
    travel_.went(fastest * dt_);
    for (auto& track : tracks_) {
        track.spheres.went(fastest * dt_);
    }
    for (auto& track : body_tracks_) {
        track.went(fastest * dt_);
    }
    fastest = std::isfinite(of_bodies) ? std::max(fastest, of_bodies) : of_bodies;
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        walls.platens[p].move(speeds[p], dt_);
        fastest = std::max(fastest, std::fabs(speeds[p]));
    }
    for (std::size_t p = 0; p < walls.surfaces.size(); ++p) {
        Surface& surface = walls.surfaces[p];
        surface.move(dt_);
        tracks_[p].way += (surface.motion.velocity.norm() + surface.motion.spin.norm() * surface.reach()) * dt_;
    }
    fastest_ = fastest;
    ledger_.background += sums.damping_work;
    if (measure) {
        ledger_.kinetic = sums.kinetic + bodies_kinetic_;
        double forces = 0.0;
        for (std::size_t b = 0; b < bonds.size(); ++b) {
            forces += std::hypot(bonds.normal[b], bonds.shear[b]);
        }
        for (std::size_t k = 0; k < contacts.size() && bonds.size() == 0; ++k) { // of loose matter
            forces += contacts.force.at(k).norm();
        }
        measures_.unbalanced_ratio = forces > 0.0 ? sums.unbalanced / forces : 0.0;
        check();
    }
}

} // namespace proveta
