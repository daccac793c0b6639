#include "core/boundaries/pressure.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Eigenvalues>

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

// Of each facet's force, what each of its spheres takes.
using Shares = std::array<double, 3>;

// In proportion to sections, then moved for a moment that is that of the pressure: a facet's force -p a (a: area vector) that acts at d
// beside its middle has the moment -p d x a. Shares that grow by b_c.m / l, with b_c the side across from corner c, l the longest side and
// the same m for all facets, sum to one as before, change by |m| at most, and add -p 2/l (a.a m - (a.m) a): three equations for m.
std::vector<Shares> balanced_shares(const Spheres& spheres, const Pressure& p, const std::vector<SurfaceTriangle>& facets) {
    const auto sides = [&](const SurfaceTriangle& f) {
        const std::array at = {corner(spheres, p, f[0]), corner(spheres, p, f[1]), corner(spheres, p, f[2])};
        return std::array<Vec3, 3>{at[2] - at[1], at[0] - at[2], at[1] - at[0]};
    };
    const auto longest = [](const std::array<Vec3, 3>& side) { return std::max({side[0].norm(), side[1].norm(), side[2].norm()}); };
    std::vector<Shares> shares(facets.size());
    Vec3 moment = Vec3::Zero();
    Mat3 added = Mat3::Zero(); // by the components of m
    for (std::size_t k = 0; k < facets.size(); ++k) {
        const auto section = [&](std::size_t c) { return spheres.section(static_cast<std::size_t>(p.sphere[facets[k][c]])); };
        const double sum = section(0) + section(1) + section(2);
        Vec3 beside = Vec3::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            shares[k][c] = section(c) / sum;
            beside += (shares[k][c] - 1.0 / 3.0) * corner(spheres, p, facets[k][c]);
        }
        const auto side = sides(facets[k]);
        const Vec3 area = 0.5 * side[0].cross(side[1]);
        moment += beside.cross(area);
        added += 2.0 / longest(side) * (area.squaredNorm() * Mat3::Identity() - area * area.transpose());
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(added);
    Vec3 m = Vec3::Zero();
    for (int k = 0; k < 3; ++k) { // but about the normal of a net that is nearly flat, where the facets have no lever
        if (axes.eigenvalues()[k] > 1e-3 * axes.eigenvalues()[2]) {
            m -= axes.eigenvectors().col(k) * (axes.eigenvectors().col(k).dot(moment) / axes.eigenvalues()[k]);
        }
    }
    for (std::size_t k = 0; k < facets.size(); ++k) {
        const auto side = sides(facets[k]);
        for (std::size_t c = 0; c < 3; ++c) {
            shares[k][c] += side[c].dot(m) / longest(side);
        }
    }
    return shares;
}

} // namespace

Pressure make_pressure(const Spheres& spheres, std::vector<std::int32_t> sphere, std::vector<double> raise, const VectorField& normal,
                       const std::vector<SurfaceTriangle>& facets, double surface) {
    Pressure p;
    p.sphere = std::move(sphere);
    p.raise = std::move(raise);
    const std::vector<Shares> shares = balanced_shares(spheres, p, facets);
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> of(p.sphere.size()); // facets, and which corner of them
    for (std::size_t k = 0; k < facets.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            of[facets[k][c]].emplace_back(k, c);
        }
    }
    p.offset.push_back(0);
    for (const auto& corners : of) {
        for (const auto& [k, c] : corners) {
            p.others.push_back({facets[k][(c + 1) % 3], facets[k][(c + 2) % 3]});
            p.share.push_back(shares[k][c]);
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

double side_stress(const Spheres& spheres, const Pressure& p) {
    double inward = 0.0;
    double twice_volume = 0.0;
    for (std::uint32_t k = 0; k < p.sphere.size(); ++k) {
        const Vec3 at = corner(spheres, p, k);
        const Vec3 area = area_of(spheres, p, k);
        inward -= p.force.x[k] * at.x() + p.force.y[k] * at.y();
        twice_volume += area.x() * at.x() + area.y() * at.y();
    }
    return twice_volume > 0.0 ? inward / twice_volume : 0.0;
}

} // namespace proveta
