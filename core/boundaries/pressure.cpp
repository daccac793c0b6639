#include "core/boundaries/pressure.hpp"

namespace proveta {

namespace {

Vec3 corner(const Spheres& spheres, const Pressure& p, std::uint32_t k) {
    return spheres.position.at(static_cast<std::size_t>(p.sphere[k])) + Vec3(0.0, 0.0, p.raise[k]);
}

// A sphere's share of the area vectors of its facets.
Vec3 area_of(const Spheres& spheres, const Pressure& p, std::uint32_t k) {
    const Vec3 own = corner(spheres, p, k);
    Vec3 sum = Vec3::Zero();
    for (auto e = p.offset[k]; e < p.offset[k + 1]; ++e) {
        const auto [b, c] = p.others[e];
        sum += p.share[e] * (corner(spheres, p, b) - own).cross(corner(spheres, p, c) - own);
    }
    return 0.5 * p.scale * sum;
}

} // namespace

Pressure make_pressure(const Spheres& spheres, std::vector<std::int32_t> sphere, std::vector<double> raise, const VectorField& normal,
                       const std::vector<Facet>& facets, double surface) {
    Pressure p;
    p.sphere = std::move(sphere);
    p.raise = std::move(raise);
    std::vector<std::vector<std::array<std::uint32_t, 2>>> of(p.sphere.size());
    for (const auto& f : facets) {
        for (std::size_t c = 0; c < 3; ++c) {
            of[f[c]].push_back({f[(c + 1) % 3], f[(c + 2) % 3]});
        }
    }
    const auto section = [&](std::uint32_t k) { return spheres.section(static_cast<std::size_t>(p.sphere[k])); };
    p.offset.push_back(0);
    for (std::uint32_t k = 0; k < of.size(); ++k) {
        for (const auto& other : of[k]) {
            p.others.push_back(other);
            p.share.push_back(section(k) / (section(k) + section(other[0]) + section(other[1])));
        }
        p.offset.push_back(static_cast<std::uint32_t>(p.others.size()));
    }
    p.force.resize(p.sphere.size());
    double net = 0.0;
    for (std::uint32_t k = 0; k < p.sphere.size(); ++k) {
        net += area_of(spheres, p, k).dot(normal.at(k));
    }
    p.scale = net > 0.0 ? surface / net : 1.0;
    return p;
}

double pressure_forces(const Spheres& spheres, Pressure& p, const SphereBlock& block, double dt, Loads& loads) {
    double work = 0.0;
    const ListedRange range = listed_in(p.sphere, block);
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        const Vec3 force = -p.value * area_of(spheres, p, static_cast<std::uint32_t>(k));
        work += 0.5 * dt * (force + p.force.at(k)).dot(spheres.velocity.at(s));
        p.force.set(k, force);
        loads.add(s, force, Vec3::Zero());
    }
    return work;
}

} // namespace proveta
