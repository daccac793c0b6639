#include "core/particles/clusters.hpp"

#include <algorithm>
#include <stdexcept>

namespace proveta {

// Gives the spheres from `begin` on the numbers of their bodies.
void Clusters::number(std::size_t spheres) {
    const std::size_t bodies = mass.size();
    const bool whole = bodies == 0 ? first.size() <= 1 && offset.empty()
                                   : first.size() == bodies + 1 && std::is_sorted(first.begin(), first.end()) && first.back() == spheres &&
                                         offset.size() == spheres - first.front();
    if (!whole) {
        throw std::runtime_error("the clusters do not fit the spheres");
    }
    begin = bodies == 0 ? 0 : first.front();
    body_.clear();
    for (std::size_t b = 0; b < bodies; ++b) {
        body_.resize(first[b + 1] - begin, static_cast<std::int32_t>(b));
    }
}

// The first cluster to come fixes where they begin.
void Clusters::open(const Spheres& spheres) {
    if (empty()) {
        begin = spheres.size();
        first.assign(1, static_cast<std::uint32_t>(begin));
    }
}

void Clusters::add(Spheres& spheres, const ClusterShape& shape, double density, const Vec3& centre, const rotation::Quaternion& attitude,
                   int material) {
    open(spheres);
    const auto body = static_cast<std::int32_t>(size());
    mass.push_back(density * shape.volume);
    position.push_back(centre);
    start.push_back(centre);
    velocity.push_back(Vec3::Zero());
    turning.push_back(rotation::start(density * shape.inertia, attitude, Vec3::Zero()));
    for (std::size_t k = 0; k < shape.radius.size(); ++k) {
        offset.push_back(shape.centre[k]);
        body_.push_back(body);
        spheres.add(centre + attitude * shape.centre[k], shape.radius[k], density, 0, material);
        spheres.mass.back() = mass.back();
        spheres.inertia.back() = density * shape.inertia.minCoeff();
    }
    first.push_back(static_cast<std::uint32_t>(spheres.size()));
}

void Clusters::append(Spheres& spheres, const Clusters& from, const Spheres& its, std::size_t other) {
    open(spheres);
    const auto body = static_cast<std::int32_t>(size());
    mass.push_back(from.mass[other]);
    position.push_back(from.position[other]);
    start.push_back(from.start[other]);
    velocity.push_back(from.velocity[other]);
    turning.push_back(from.turning[other]);
    for (std::size_t s = from.first[other]; s < from.first[other + 1]; ++s) {
        offset.push_back(from.offset[s - from.begin]);
        body_.push_back(body);
        spheres.append(its, s);
    }
    first.push_back(static_cast<std::uint32_t>(spheres.size()));
}

void Clusters::place(std::size_t body, double dt, Spheres& spheres) const {
    const Mat3 turn = turning[body].attitude.toRotationMatrix();
    for (std::size_t s = first[body]; s < first[body + 1]; ++s) {
        const Vec3 arm = turn * offset[s - begin];
        const Vec3 to = position[body] + arm;
        spheres.velocity.set(s, dt > 0.0 ? Vec3((to - spheres.position.at(s)) / dt) : Vec3(velocity[body] + turning[body].spin.cross(arm)));
        spheres.position.set(s, to);
        spheres.spin.set(s, turning[body].spin);
    }
}

} // namespace proveta
