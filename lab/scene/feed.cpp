#include "lab/scene/feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/hilbert.hpp"
#include "lab/scene/growing.hpp"
#include "lab/scene/vectors.hpp"
#include "specimens/stones.hpp"

namespace proveta {

Feed::Feed(const Scene& scene)
    : scene_(scene), random_(static_cast<std::uint64_t>(scene.seed), Stream::positions), kinds_(make_kinds(scene)) {
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
        next_look_.push_back(scene.particles[k].begin);
        counts_.push_back({scene.particles[k].name, kinds_[k].plan.size(), 0, 0});
    }
    taken_.assign(scene.outlets.size(), 0);
}

bool Feed::finished() const {
    return std::all_of(counts_.begin(), counts_.end(), [](const FeedCount& c) { return c.placed + c.left_out == c.planned; });
}

void Feed::place(const ParticleKind& kind, std::size_t number, const PlannedParticle& p, const Vec3& at,
                 const rotation::Quaternion& attitude, Population& bodies, Population& alone) {
    const Vec3 velocity = vector(scene_.particles[number].velocity);
    const std::int64_t id = next_id_++;
    const auto mark = [&](Spheres& spheres, std::size_t from) {
        for (std::size_t s = from; s < spheres.size(); ++s) {
            spheres.id[s] = id;
            spheres.group[s] = static_cast<int>(number);
            spheres.velocity.set(s, velocity);
        }
    };
    if (p.form < 0) {
        alone.spheres.add(at, 0.5 * p.size, kind.density, 0, kind.material);
        mark(alone.spheres, alone.spheres.size() - 1);
    } else {
        const std::size_t from = bodies.spheres.size();
        bodies.clusters.add(bodies.spheres, scaled(kind.forms[static_cast<std::size_t>(p.form)], p.size), kind.density, at, attitude,
                            kind.material);
        bodies.clusters.velocity.back() = velocity;
        mark(bodies.spheres, from);
    }
    ++counts_[number].placed;
}

// Spheres around the particles are packed; then those that would reach into a surface or into other particles are left out.
void Feed::grow(std::size_t number, Room& room, Population& bodies, Population& alone) {
    const ParticleKind& kind = kinds_[number];
    const ParticleInput& p = scene_.particles[number];
    const auto box = box_of(p);
    std::vector<double> radii;
    for (const auto& planned : kind.plan) {
        radii.push_back(kind.reach_of(planned));
    }
    if (const double share = filled_share(box, radii); share > densest_share) {
        throw input::InputError({{scene_.source, fmt::format("/particles/{}/count", number), fmt::format("{}", p.count),
                                  fmt::format("at most about {:.0f}: spheres around the particles would fill {:.2f} of the box, where the "
                                              "densest packing fills {}",
                                              usual_share / share * static_cast<double>(radii.size()), share, densest_share),
                                  "fewer or smaller particles, or a larger box"}});
    }
    const Grown grown = grow_in(box, radii, static_cast<std::uint64_t>(scene_.seed) * 1000 + number);
    if (grown.number.size() < radii.size()) {
        throw input::InputError({{scene_.source, fmt::format("/particles/{}/count", number), fmt::format("{}", p.count),
                                  fmt::format("at most about {}: so many of these sizes fit into the box without overlaps above {:.2g} of "
                                              "the smaller radius; spheres around the particles would fill {:.2f} of it",
                                              grown.number.size(), most_grown_overlap, filled_share(box, radii)),
                                  "fewer or smaller particles, or a larger box"}});
    }
    std::vector<std::size_t> placed;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const std::size_t n = grown.number[k];
        if (room.is_free(grown.centre[k], radii[n])) {
            place(kind, number, kind.plan[n], grown.centre[k], any_attitude(random_), bodies, alone);
            placed.push_back(k);
        } else {
            ++counts_[number].left_out;
        }
    }
    for (const auto k : placed) { // those of a kind may touch each other
        room.take(grown.centre[k], radii[grown.number[k]]);
    }
    next_look_[number] = std::numeric_limits<double>::infinity();
}

void Feed::pour(std::size_t number, double time, Room& room, Population& bodies, Population& alone) {
    constexpr int tries = 200; // in vain, one after the other, before the box counts as full
    const ParticleKind& kind = kinds_[number];
    const ParticleInput& p = scene_.particles[number];
    const auto box = box_of(p);
    std::size_t& placed = counts_[number].placed;
    std::size_t due = kind.plan.size();
    if (p.rate.word.empty()) {
        due = static_cast<std::size_t>(std::min(static_cast<double>(due), std::floor(p.rate.number * (time - p.begin)) + 1.0));
    }
    for (int left = tries; placed < due && left > 0; --left) {
        const PlannedParticle& next = kind.plan[placed];
        const double reach = kind.reach_of(next);
        const Vec3 room_for = (box.sizes() - Vec3::Constant(2.0 * reach)).cwiseMax(0.0);
        const Vec3 share(random_.uniform(), random_.uniform(), random_.uniform());
        const Vec3 at = box.center() + (share - Vec3::Constant(0.5)).cwiseProduct(room_for);
        if (room.is_free(at, reach)) {
            room.take(at, reach);
            place(kind, number, next, at, next.form < 0 ? rotation::Quaternion::Identity() : any_attitude(random_), bodies, alone);
            left = tries;
        }
    }
    // Room comes as those before have gone on by a particle's size.
    const double size = 2.0 * kind.reach_of(kind.plan[std::min(placed, kind.plan.size() - 1)]);
    const double speed = vector(p.velocity).norm();
    const double falling = vector(scene_.gravity).norm();
    const double wait = std::min(speed > 0.0 ? size / speed : std::numeric_limits<double>::infinity(),
                                 falling > 0.0 ? std::sqrt(2.0 * size / falling) : std::numeric_limits<double>::infinity());
    next_look_[number] = time + wait;
}

bool Feed::anyone_due(double time) const {
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
        if (time >= next_look_[k] && counts_[k].placed < counts_[k].planned) {
            return true;
        }
    }
    return false;
}

void Feed::put_in(double time, const Walls& walls, const Spheres& there, Population& bodies, Population& alone) {
    double widest = 0.0;
    for (const auto& kind : kinds_) {
        for (const auto& planned : kind.plan) {
            widest = std::max(widest, kind.reach_of(planned));
        }
    }
    Room room(walls, there, widest);
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
        if (time >= next_look_[k] && counts_[k].placed < counts_[k].planned) {
            if (scene_.particles[k].place == "grow") {
                grow(k, room, bodies, alone);
            } else {
                pour(k, time, room, bodies, alone);
            }
        }
    }
}

Population Feed::first(const Walls& walls) {
    for (const auto& p : scene_.particles) {
        domain_.extend(box_of(p));
    }
    for (const auto& o : scene_.outlets) {
        domain_.extend(box_of(o));
    }
    for (const auto& body : walls.bodies) {
        for (const Vec3& v : body.solid.position) {
            domain_.extend(v);
        }
    }
    for (const auto& surface : walls.surfaces) {
        for (const auto& v : surface.geometry.mesh.vertex) {
            domain_.extend(surface.to_space(v));
        }
    }
    const Vec3 around = Vec3::Constant(domain_.diagonal().norm());
    domain_ = {domain_.min() - around, domain_.max() + around};

    Population bodies;
    Population alone;
    put_in(0.0, walls, Spheres{}, bodies, alone);
    Population out;
    out.spheres = std::move(alone.spheres);
    out.spheres.packed = false;
    for (std::size_t b = 0; b < bodies.clusters.size(); ++b) {
        out.clusters.append(out.spheres, bodies.clusters, bodies.spheres, b);
    }
    return out;
}

bool Feed::stays(const Vec3& at) {
    for (std::size_t o = 0; o < scene_.outlets.size(); ++o) {
        if (box_of(scene_.outlets[o]).contains(at)) {
            ++taken_[o];
            return false;
        }
    }
    if (!domain_.contains(at)) {
        ++lost_;
        return false;
    }
    return true;
}

void Feed::visit_state(StateVisitor& visit) {
    const auto count = [&](const std::string& name, auto& value) {
        auto whole = static_cast<std::int64_t>(value);
        visit("feed_" + name, whole);
        value = static_cast<std::remove_reference_t<decltype(value)>>(whole);
    };
    random_.visit_state("feed_random", visit);
    visit("feed_next_look", next_look_);
    for (std::size_t k = 0; k < counts_.size(); ++k) {
        count(fmt::format("placed_{}", k), counts_[k].placed);
        count(fmt::format("left_out_{}", k), counts_[k].left_out);
    }
    for (std::size_t k = 0; k < taken_.size(); ++k) {
        count(fmt::format("taken_{}", k), taken_[k]);
    }
    count("lost", lost_);
    count("next_id", next_id_);
    count("looked_at", looked_at_);
    count("sorted_at", sorted_at_);
}

// By sphere; of a cluster its first sphere tells.
std::vector<char> Feed::who_stays(const Spheres& spheres, const Clusters& clusters) {
    std::vector<char> out(spheres.size(), 1);
    for (std::size_t k = 0; k < clusters.alone(spheres); ++k) {
        out[k] = static_cast<char>(stays(spheres.position.at(k)));
    }
    for (std::size_t b = 0; b < clusters.size(); ++b) {
        out[clusters.first[b]] = static_cast<char>(stays(clusters.position[b]));
    }
    return out;
}

void Feed::look_after(Model& model) {
    constexpr std::int64_t look_every = 64;
    constexpr std::int64_t sort_every = 4096;
    if (model.steps() < looked_at_ + look_every) {
        return;
    }
    looked_at_ = model.steps();
    const bool sort = model.steps() >= sorted_at_ + sort_every;
    Population bodies;
    Population alone;
    if (anyone_due(model.time())) {
        model.follow_bodies();
        put_in(model.time(), model.walls, model.spheres, bodies, alone);
    }
    const auto stay = who_stays(model.spheres, model.clusters);
    const bool gone = std::find(stay.begin(), stay.end(), 0) != stay.end();
    if (!sort && !gone && alone.spheres.size() + bodies.spheres.size() == 0) {
        return;
    }
    Population next;
    next.spheres.packed = false;
    const Spheres& now = model.spheres;
    const Clusters& clusters = model.clusters;
    VectorField singles(clusters.alone(now));
    for (std::size_t k = 0; k < singles.size(); ++k) {
        singles.set(k, now.position.at(k));
    }
    for (const auto k : hilbert_order(singles)) {
        if (stay[k] != 0) {
            next.spheres.append(now, k);
            next.origin.push_back(static_cast<std::int32_t>(k));
        }
    }
    for (std::size_t k = 0; k < alone.spheres.size(); ++k) {
        next.spheres.append(alone.spheres, k);
    }
    next.origin.resize(next.spheres.size(), -1);
    VectorField centres(clusters.size());
    for (std::size_t b = 0; b < clusters.size(); ++b) {
        centres.set(b, clusters.position[b]);
    }
    for (const auto b : hilbert_order(centres)) {
        if (stay[clusters.first[b]] != 0) {
            next.clusters.append(next.spheres, clusters, now, b);
            for (auto s = clusters.first[b]; s < clusters.first[b + 1]; ++s) {
                next.origin.push_back(static_cast<std::int32_t>(s));
            }
        }
    }
    for (std::size_t b = 0; b < bodies.clusters.size(); ++b) {
        next.clusters.append(next.spheres, bodies.clusters, bodies.spheres, b);
    }
    next.origin.resize(next.spheres.size(), -1);
    model.repopulate(std::move(next.spheres), std::move(next.clusters), next.origin);
    sorted_at_ = model.steps();
}

} // namespace proveta
