#include "core/motion/stable_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/contacts/rolling.hpp"

namespace proveta {

namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// Stiffness and damping of one sphere with its share of every spring.
struct Block {
    Mat6 stiffness = Mat6::Zero();
    Mat6 damping = Mat6::Zero();
    double rolling = 0.0;           // 2 dt C of the rolling resistances, over the inertia
    Mat3 softer = Mat3::Identity(); // of a body: scales torques by the root of its smallest moment over its own

    // A spring with outward normal n: stiffnesses and dashpots, lever arm; `weight` is the sphere's share of it. base: of the sphere's
    // centre against that of the body which it belongs to.
    void add(const Vec3& n, const Stiffness& spring, double lever, double weight, const Vec3& base = Vec3::Zero()) {
        const auto& [k_n, k_t, c_n, c_t] = spring;
        if (!base.isZero()) {
            add_at(base + lever * n, n, spring, weight);
            return;
        }
        const Mat3 nn = n * n.transpose();
        const Mat3 tt = Mat3::Identity() - nn;
        const Mat3 cross = cross_matrix(n);
        stiffness.topLeftCorner<3, 3>() += weight * (k_n * nn + k_t * tt);
        stiffness.bottomRightCorner<3, 3>() += weight * k_t * lever * lever * tt;
        stiffness.topRightCorner<3, 3>() -= weight * k_t * lever * cross;
        stiffness.bottomLeftCorner<3, 3>() += weight * k_t * lever * cross;
        damping.topLeftCorner<3, 3>() += weight * (c_n * nn + c_t * tt);
        if (c_t > 0.0) {
            damping.bottomRightCorner<3, 3>() += weight * c_t * lever * lever * tt;
            damping.topRightCorner<3, 3>() -= weight * c_t * lever * cross;
            damping.bottomLeftCorner<3, 3>() += weight * c_t * lever * cross;
        }
    }

    // The same at any point of a body, `arm` from its centre.
    void add_at(const Vec3& arm, const Vec3& n, const Stiffness& spring, double weight) {
        Eigen::Matrix<double, 6, 3> lift; // force at the point to force and torque at the centre
        lift << Mat3::Identity(), softer * cross_matrix(arm);
        const Mat3 nn = n * n.transpose();
        const Mat3 tt = Mat3::Identity() - nn;
        stiffness += weight * lift * (spring.k_n * nn + spring.k_t * tt) * lift.transpose();
        damping += weight * lift * (spring.c_n * nn + spring.c_t * tt) * lift.transpose();
    }

    // Bending and twisting stiffness of a bond.
    void add_moments(const Vec3& n, double bend, double twist, double weight) {
        const Mat3 nn = n * n.transpose();
        stiffness.bottomRightCorner<3, 3>() += weight * (bend * (Mat3::Identity() - nn) + twist * nn);
    }

    // What the bound asks of the sphere.
    SphereDemand demand(double mass, double inertia) const {
        return demand_by(mass, inertia, [](const Mat6& m) {
            return std::max(Eigen::SelfAdjointEigenSolver<Mat6>(m, Eigen::EigenvaluesOnly).eigenvalues()[5], 0.0);
        });
    }
    // The same or more, in a tenth of the time: no eigenvalue is above the Frobenius norm.
    SphereDemand demand_at_most(double mass, double inertia) const {
        return demand_by(mass, inertia, [](const Mat6& m) { return m.norm(); });
    }

    // Whether a step of dt seconds is stable, where that is quickly said: without dashpots 4 I - dt^2 K must be positive definite.
    bool stable_at(double dt, double mass, double inertia) const {
        if (!damping.isZero()) {
            return false;
        }
        Eigen::Matrix<double, 6, 1> scale;
        scale << Vec3::Constant(dt / std::sqrt(mass)), Vec3::Constant(dt / std::sqrt(inertia));
        const Mat6 left = std::max(4.0 - rolling, 0.04) * Mat6::Identity() - Mat6(scale.asDiagonal() * stiffness * scale.asDiagonal());
        return Eigen::LLT<Mat6>(left).info() == Eigen::Success;
    }

    template <class Largest> SphereDemand demand_by(double mass, double inertia, const Largest& largest) const {
        Eigen::Matrix<double, 6, 1> scale;
        scale << Vec3::Constant(1.0 / std::sqrt(mass)), Vec3::Constant(1.0 / std::sqrt(inertia));
        const auto scaled = [&](const Mat6& m) -> Mat6 { return scale.asDiagonal() * m * scale.asDiagonal(); };
        // More than seventy neighbours that all roll on one sphere are out of reach.
        return {largest(scaled(stiffness)), damping.isZero() ? 0.0 : largest(scaled(damping)), std::max(4.0 - rolling, 0.04)};
    }
};

// Adds every spring of a sphere; spring(p, d) are the stiffnesses of pair p at distance d, rolling(p) its inertia against rolling or 0.
template <class Pairs, class Spring, class Rolling>
void add_pairs(const Spheres& s, const Pairs& pairs, const Spring& spring, const Rolling& rolling, std::size_t sphere,
               const std::vector<double>& g, Block& block, const Vec3& base = Vec3::Zero()) {
    const auto& in = pairs.incidence;
    for (auto e = in.offset[sphere]; e < in.offset[sphere + 1]; ++e) {
        const auto p = in.entry[e] >> 1;
        const bool second = (in.entry[e] & 1u) != 0;
        const auto other = static_cast<std::size_t>(second ? pairs.i[p] : pairs.j[p]);
        const Vec3 to = s.position.at(other) - s.position.at(sphere);
        const double d = to.norm();
        const Stiffness acting = spring(p, d);
        if (acting.k_n == 0.0) { // out of reach
            continue;
        }
        const double share = second ? 1.0 - pairs.share[p] : pairs.share[p];
        const double weight = 1.0 + g[other] / g[sphere];
        block.add(to / d, acting, share * d, weight, base);
        block.rolling += weight * 2.0 * rolling::share * rolling(p) / s.inertia[sphere];
    }
}

// Law of each bond, when some have moments.
std::vector<std::uint32_t> laws_of(const Bonds& bonds) {
    std::vector<std::uint32_t> law(bonds.moments ? bonds.size() : 0);
    for (const auto& block : bonds.blocks) {
        for (auto b = block.begin; b < block.end && bonds.moments; ++b) {
            law[b] = block.group;
        }
    }
    return law;
}

// Stiffness of each bond along its line, with its averaged part, and across.
struct Springs {
    std::vector<double> k_n, k_t;

    explicit Springs(const Bonds& bonds) : k_n(stiffening(bonds)), k_t(bonds.size()) {
        for (const auto& block : bonds.blocks) {
            for (auto b = block.begin; b < block.end; ++b) {
                k_n[b] *= bonds.stiffness[b];
                k_t[b] = bonds.groups[block.group].shear_ratio() * bonds.stiffness[b];
            }
        }
    }
};

// The springs of one sphere's bonds and, with the same split, their moments. law: of each bond, as `laws_of`. Failed bonds that are farther
// apart than the skin cannot act before the next search.
void add_bonds(const Spheres& s, const Bonds& bonds, const Springs& springs, const std::vector<std::uint32_t>& law, std::size_t sphere,
               const std::vector<double>& g, double skin, Block& block) {
    add_pairs(
        s, bonds,
        [&](std::size_t p, double d) {
            if (bonds.mode[p] != 0 && d > bonds.length[p] - bonds.plastic()[p] + skin) {
                return Stiffness{0.0, 0.0, 0.0, 0.0};
            }
            return Stiffness{springs.k_n[p], springs.k_t[p], bonds.dashpot[p], 0.0};
        },
        [](std::size_t) { return 0.0; }, sphere, g, block);
    for (auto e = bonds.incidence.offset[sphere]; bonds.moments && e < bonds.incidence.offset[sphere + 1]; ++e) {
        const auto b = bonds.incidence.entry[e] >> 1;
        const auto other = static_cast<std::size_t>((bonds.incidence.entry[e] & 1u) != 0 ? bonds.i[b] : bonds.j[b]);
        const BondBeams& l = bonds.groups[law[b]].beams;
        block.add_moments((s.position.at(other) - s.position.at(sphere)).normalized(),
                          l.bending_stiffness(bonds.stiffness[b], bonds.area[b]), l.twisting_stiffness(bonds.stiffness[b], bonds.area[b]),
                          1.0 + g[other] / g[sphere]);
    }
}

} // namespace

double SphereDemand::step() const { return stiffness > 0.0 ? left / (damping + std::sqrt(damping * damping + left * stiffness)) : 1e300; }

StepBound::StepBound(const Spheres& s, const Bonds& bonds) : share_(s.size(), 1.0) {
    const Springs springs(bonds);
    const auto law = laws_of(bonds);
    std::vector<double> best = share_;
    single_ = share_;
    double lowest = 1e300;
    const double mean_stiffness =
        bonds.size() > 0 ? std::accumulate(bonds.stiffness.begin(), bonds.stiffness.end(), 0.0) / static_cast<double>(bonds.size()) : 1.0;
    std::vector<double> eigenvalue(s.size());
    for (int sweep = 0; sweep < 12; ++sweep) {
#pragma omp parallel for schedule(static) if (s.size() > 256)
        for (std::size_t k = 0; k < s.size(); ++k) {
            Block block;
            add_bonds(s, bonds, springs, law, k, share_, 0.0, block);
            eigenvalue[k] = block.demand(s.mass[k], s.inertia[k]).stiffness;
        }
        const double largest = eigenvalue.empty() ? 0.0 : *std::max_element(eigenvalue.begin(), eigenvalue.end());
        for (std::size_t k = 0; k < s.size() && sweep == 0; ++k) {
            // A sphere without bonds has no frequency of its own yet: that of one mean bond.
            single_[k] = std::sqrt(eigenvalue[k] > 0.0 ? eigenvalue[k] : mean_stiffness / s.mass[k]);
        }
        if (largest < lowest) {
            lowest = largest;
            best = share_;
        }
        for (std::size_t k = 0; k < s.size() && largest > 0.0; ++k) {
            share_[k] = std::clamp(share_[k] * std::sqrt(eigenvalue[k] / largest), 1e-6, 1e6);
        }
    }
    share_ = best;
}

void StepBound::hand_over(const std::vector<double>& factor) {
    for (std::size_t k = 0; k < share_.size(); ++k) {
        share_[k] = std::clamp(share_[k] * std::sqrt(factor[k]), 1e-3, 1.0);
    }
}

namespace {

// Which walls each sphere is near: their numbers, platens before surfaces, and where it stands in their lists.
using NearWalls = std::vector<std::vector<std::pair<std::size_t, std::size_t>>>;

NearWalls near_walls(const Spheres& s, const Walls& walls) {
    NearWalls near(s.size());
    const auto list = [&](std::size_t wall, const std::vector<std::int32_t>& spheres) {
        for (std::size_t e = 0; e < spheres.size(); ++e) {
            near[static_cast<std::size_t>(spheres[e])].emplace_back(wall, e);
        }
    };
    for (std::size_t p = 0; p < walls.platens.size(); ++p) {
        list(p, walls.platens[p].sphere);
    }
    for (std::size_t p = 0; p < walls.surfaces.size(); ++p) {
        list(walls.platens.size() + p, walls.surfaces[p].sphere);
    }
    for (std::size_t p = 0; p < walls.bodies.size(); ++p) {
        list(walls.platens.size() + walls.surfaces.size() + p, walls.bodies[p].sphere);
    }
    return near;
}

void add_platen(const Platen& platen, std::size_t e, const Vec3& centre, double skin, const Vec3& base, Block& block) {
    const auto foot = platen.foot(centre);
    block.add(-foot.normal, stiffness_at(platen.law[e], platen.contact_distance[e] - foot.distance + skin), platen.contact_distance[e], 1.0,
              base);
    block.rolling += platen.law[e].rolling_arm > 0.0 ? 2.0 * rolling::share : 0.0;
}

// Every contact that the sphere would have if it were larger by the skin counts.
void add_surface(const Surface& surface, std::size_t e, const Vec3& centre, double radius, double skin, const Vec3& base, Block& block) {
    std::vector<FaceContact> found;
    double_hierarchy(surface.geometry, surface.faces_near(e), surface.to_own(centre), radius + skin, found);
    for (const auto& contact : found) {
        const Vec3 to = surface.to_space(contact.point) - centre;
        const double distance = to.norm();
        block.add(surface.normal_at(contact, to, distance), stiffness_at(surface.law[e], radius - distance + skin), radius, 1.0, base);
        block.rolling += surface.law[e].rolling_arm > 0.0 ? 2.0 * rolling::share : 0.0;
    }
}

// A sphere's contacts with a deformable body together are no stiffer than the stiffest alone, by their shares; that one's direction is
// known only where there is one. The nodes bear the rest (`sphere_share`).
void add_body(const Deformable& body, std::size_t e, const Vec3& centre, const LooseBody& sphere, double skin, const Vec3& base,
              Block& block) {
    std::vector<FaceContact> found;
    double_hierarchy(body.skin.geometry(), body.faces_near(e), centre, sphere.radius + skin, found);
    if (found.empty()) {
        return;
    }
    const double share = sphere_share(body, sphere.mass);
    const bool by_area = body.coupling == Coupling::area_distributed;
    for (const auto& contact : found) {
        const double distance = std::sqrt(contact.square);
        const Vec3 normal = distance > 0.0 ? Vec3((contact.point - centre) / distance) : body.skin.geometry().plane[contact.face].normal;
        Stiffness spring = stiffness_at(body.law[e], sphere.radius - distance + skin);
        if (by_area && found.size() > 1) {
            spring.k_n = spring.k_t = std::max(spring.k_n, spring.k_t);
            spring.c_n = spring.c_t = std::max(spring.c_n, spring.c_t);
        }
        block.add(normal, spring, sphere.radius, share, base);
        block.rolling += body.law[e].rolling_arm > 0.0 ? 2.0 * rolling::share : 0.0;
        if (by_area) { // the nearest is the stiffest
            break;
        }
    }
}

} // namespace

// Calls use(k, block) for every sphere, with everything that may act on it before the next search. What acts on a cluster counts as one
// with its first sphere.
template <class Use> void StepBound::each_block(const Assembly& a, double skin, const Use& use) const {
    const Spheres& s = a.spheres;
    const Springs springs(a.bonds);
    const auto law = laws_of(a.bonds);
    const NearWalls near = near_walls(s, a.walls);
    const auto add = [&](std::size_t k, const Vec3& base, Block& block) {
        add_bonds(s, a.bonds, springs, law, k, share_, skin, block);
        if (a.contacts.size() > 0) {
            add_pairs(
                s, a.contacts,
                [&](std::size_t p, double d) { return stiffness_at(a.contacts.law[p], a.contacts.contact_distance[p] - d + skin); },
                [&](std::size_t p) { return a.contacts.law[p].rolling_arm > 0.0 ? a.contacts.law[p].reduced_inertia : 0.0; }, k, single_,
                block, base);
        }
        for (const auto& [wall, e] : near[k]) {
            if (wall < a.walls.platens.size()) {
                add_platen(a.walls.platens[wall], e, s.position.at(k), skin, base, block);
            } else if (const std::size_t later = wall - a.walls.platens.size(); later < a.walls.surfaces.size()) {
                add_surface(a.walls.surfaces[later], e, s.position.at(k), s.radius[k], skin, base, block);
            } else {
                add_body(a.walls.bodies[later - a.walls.surfaces.size()], e, s.position.at(k), {s.radius[k], s.mass[k], s.inertia[k]}, skin,
                         base, block);
            }
        }
    };
#pragma omp parallel for schedule(static) if (s.size() > 256)
    for (std::size_t k = 0; k < s.size(); ++k) {
        Block block;
        const std::int32_t body = a.clusters.of(k);
        if (body < 0) {
            add(k, Vec3::Zero(), block);
        } else if (const auto b = static_cast<std::size_t>(body); a.clusters.first[b] == k) {
            const rotation::State& turning = a.clusters.turning[b];
            const Mat3 axes = turning.attitude.toRotationMatrix();
            const Vec3 share = (turning.inertia.minCoeff() * turning.inertia.cwiseInverse()).cwiseSqrt();
            block.softer = axes * share.asDiagonal() * axes.transpose();
            for (std::size_t member = k; member < a.clusters.first[b + 1]; ++member) {
                add(member, s.position.at(member) - a.clusters.position[b], block);
            }
        }
        use(k, block);
    }
}

std::vector<SphereDemand> StepBound::demands(const Assembly& a, double skin) const {
    const Spheres& s = a.spheres;
    std::vector<SphereDemand> out(s.size());
    each_block(a, skin, [&](std::size_t k, const Block& block) { out[k] = block.demand(s.mass[k], s.inertia[k]); });
    return out;
}

double StepBound::limit(const Assembly& a, double skin, double enough) const {
    const Spheres& s = a.spheres;
    std::atomic<double> lowest{enough};
    each_block(a, skin, [&](std::size_t k, const Block& block) {
        // Eigenvalues are only worked out where cheaper tests do not settle the matter: what is left out could not be the lowest.
        double known = lowest.load(std::memory_order_relaxed);
        const double beyond = known * (1.0 + 1e-9); // a margin over rounding, so that the lowest does not depend on who comes first
        if (block.demand_at_most(s.mass[k], s.inertia[k]).step() >= beyond || block.stable_at(beyond, s.mass[k], s.inertia[k])) {
            return;
        }
        const double step = block.demand(s.mass[k], s.inertia[k]).step();
        while (step < known && !lowest.compare_exchange_weak(known, step, std::memory_order_relaxed)) {
        }
    });
    return lowest.load();
}

std::vector<StepBound::Offender> StepBound::offenders(const Assembly& a, double skin, double dt) const {
    const Spheres& s = a.spheres;
    std::vector<double> factor(s.size(), 0.0);
    each_block(a, skin, [&](std::size_t k, const Block& block) {
        if (block.demand_at_most(s.mass[k], s.inertia[k]).factor(dt) > 1.0 && !block.stable_at(dt, s.mass[k], s.inertia[k])) {
            factor[k] = block.demand(s.mass[k], s.inertia[k]).factor(dt);
        }
    });
    std::vector<Offender> out;
    for (std::size_t k = 0; k < s.size(); ++k) {
        if (factor[k] > 1.0) {
            out.push_back({static_cast<std::uint32_t>(k), factor[k]});
        }
    }
    return out;
}

} // namespace proveta
