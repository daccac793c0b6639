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

// In proportion to sections, then moved for a moment that is that of the pressure: forces that act at d beside the middle of a facet of
// area A and normal n have the moment -p A d x n. A shift e = h n x m with the same m for all, h the facet's least height, adds -p A h (m -
// (n.m) n): three equations for m. Shares that act there are those that were plus grad(N_i).e, which is at most |m|.
std::vector<Shares> balanced_shares(const Spheres& spheres, const Pressure& p, const std::vector<Facet>& facets) {
    std::vector<Shares> shares(facets.size());
    Vec3 moment = Vec3::Zero();
    Mat3 turned = Mat3::Zero();
    const auto sides = [&](const Facet& f) {
        const std::array at = {corner(spheres, p, f[0]), corner(spheres, p, f[1]), corner(spheres, p, f[2])};
        return std::array<Vec3, 3>{at[2] - at[1], at[0] - at[2], at[1] - at[0]}; // across from each corner
    };
    const auto least_height = [](const std::array<Vec3, 3>& side, double twice_area) {
        return twice_area / std::max({side[0].norm(), side[1].norm(), side[2].norm()});
    };
    for (std::size_t k = 0; k < facets.size(); ++k) {
        const Facet& f = facets[k];
        Shares& share = shares[k];
        for (std::size_t c = 0; c < 3; ++c) {
            share[c] = spheres.section(static_cast<std::size_t>(p.sphere[f[c]]));
        }
        const double sum = share[0] + share[1] + share[2];
        const auto side = sides(f);
        const Vec3 area = 0.5 * side[0].cross(side[1]);
        Vec3 beside = Vec3::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            share[c] /= sum;
            beside += (share[c] - 1.0 / 3.0) * corner(spheres, p, f[c]);
        }
        if (area.norm() > 0.0) {
            const Vec3 normal = area.normalized();
            moment += beside.cross(area);
            turned += area.norm() * least_height(side, 2.0 * area.norm()) * (Mat3::Identity() - normal * normal.transpose());
        }
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(turned);
    Vec3 m = Vec3::Zero();
    for (int k = 0; k < 3; ++k) { // but about the normal of a net that is nearly flat, where the facets have no lever
        if (axes.eigenvalues()[k] > 1e-3 * axes.eigenvalues()[2]) {
            m -= axes.eigenvectors().col(k) * (axes.eigenvectors().col(k).dot(moment) / axes.eigenvalues()[k]);
        }
    }
    for (std::size_t k = 0; k < facets.size(); ++k) {
        const auto side = sides(facets[k]);
        const Vec3 twice = side[0].cross(side[1]);
        if (twice.norm() > 0.0) {
            const Vec3 shift = least_height(side, twice.norm()) * twice.normalized().cross(m);
            for (std::size_t c = 0; c < 3; ++c) {
                shares[k][c] += twice.normalized().cross(side[c]).dot(shift) / twice.norm();
            }
        }
    }
    return shares;
}

} // namespace

Pressure make_pressure(const Spheres& spheres, std::vector<std::int32_t> sphere, std::vector<double> raise, const VectorField& normal,
                       const std::vector<Facet>& facets, double surface) {
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

} // namespace proveta
