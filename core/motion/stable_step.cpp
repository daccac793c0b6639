#include "core/motion/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// Stiffness and damping of one sphere with its share of every spring.
struct Block {
    Mat6 stiffness = Mat6::Zero();
    Mat6 damping = Mat6::Zero();

    // A spring with outward normal n: normal and tangential stiffness, dashpot, lever arm; `weight` is the sphere's share of it.
    void add(const Vec3& n, double k_n, double k_t, double c_n, double lever, double weight) {
        const Mat3 nn = n * n.transpose();
        const Mat3 tt = Mat3::Identity() - nn;
        Mat3 cross;
        cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
        stiffness.topLeftCorner<3, 3>() += weight * (k_n * nn + k_t * tt);
        stiffness.bottomRightCorner<3, 3>() += weight * k_t * lever * lever * tt;
        stiffness.topRightCorner<3, 3>() -= weight * k_t * lever * cross;
        stiffness.bottomLeftCorner<3, 3>() += weight * k_t * lever * cross;
        damping.topLeftCorner<3, 3>() += weight * c_n * nn;
    }

    // Bending and twisting stiffness of a bond.
    void add_moments(const Vec3& n, double bend, double twist, double weight) {
        const Mat3 nn = n * n.transpose();
        stiffness.bottomRightCorner<3, 3>() += weight * (bend * (Mat3::Identity() - nn) + twist * nn);
    }

    // Step at which lambda(K) dt^2 + 2 lambda(C) dt = 4, and the stiffness eigenvalue.
    std::pair<double, double> limit(double mass, double inertia, bool damped) const {
        Eigen::Matrix<double, 6, 1> scale;
        scale << Vec3::Constant(1.0 / std::sqrt(mass)), Vec3::Constant(1.0 / std::sqrt(inertia));
        auto largest = [&](const Mat6& m) {
            const Mat6 scaled = scale.asDiagonal() * m * scale.asDiagonal();
            return std::max(Eigen::SelfAdjointEigenSolver<Mat6>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[5], 0.0);
        };
        const double k = largest(stiffness);
        const double c = damped ? largest(damping) : 0.0;
        if (k <= 0.0) {
            return {1e300, k};
        }
        return {4.0 / (c + std::sqrt(c * c + 4.0 * k)), k};
    }
};

template <class Pairs>
void add_pairs(const Spheres& s, const Pairs& pairs, const std::vector<double>& k_t, std::size_t sphere, const std::vector<double>& g,
               Block& block) {
    const auto& in = pairs.incidence;
    for (auto e = in.offset[sphere]; e < in.offset[sphere + 1]; ++e) {
        const auto p = in.entry[e] >> 1;
        const bool second = (in.entry[e] & 1u) != 0;
        const auto other = static_cast<std::size_t>(second ? pairs.i[p] : pairs.j[p]);
        const Vec3 to = s.position.at(other) - s.position.at(sphere);
        const double d = to.norm();
        const double share = second ? 1.0 - pairs.forces[p].share_i : pairs.forces[p].share_i;
        block.add(to / d, pairs.stiffness[p], k_t[p], pairs.dashpot[p], share * d, 1.0 + g[other] / g[sphere]);
    }
}

// The moments of the bonds of one sphere, with the same split as their springs.
void add_moments(const Spheres& s, const Bonds& bonds, const std::vector<std::uint32_t>& law, std::size_t sphere,
                 const std::vector<double>& g, Block& block) {
    for (auto e = bonds.incidence.offset[sphere]; e < bonds.incidence.offset[sphere + 1]; ++e) {
        const auto b = bonds.incidence.entry[e] >> 1;
        const auto other = static_cast<std::size_t>((bonds.incidence.entry[e] & 1u) != 0 ? bonds.i[b] : bonds.j[b]);
        const BondLaw& l = bonds.laws[law[b]];
        block.add_moments((s.position.at(other) - s.position.at(sphere)).normalized(),
                          l.bending_stiffness(bonds.stiffness[b], bonds.area[b]), l.twisting_stiffness(bonds.stiffness[b], bonds.area[b]),
                          1.0 + g[other] / g[sphere]);
    }
}

// Law of each bond, when some have moments.
std::vector<std::uint32_t> laws_of(const Bonds& bonds) {
    std::vector<std::uint32_t> law(bonds.moments ? bonds.size() : 0);
    for (const auto& block : bonds.blocks) {
        for (auto b = block.begin; b < block.end && bonds.moments; ++b) {
            law[b] = block.law;
        }
    }
    return law;
}

std::vector<double> shear_stiffness(const Bonds& bonds) {
    std::vector<double> k_t(bonds.size());
    for (const auto& block : bonds.blocks) {
        for (auto b = block.begin; b < block.end; ++b) {
            k_t[b] = bonds.laws[block.law].shear_ratio * bonds.stiffness[b];
        }
    }
    return k_t;
}

} // namespace

StepBound::StepBound(const Spheres& s, const Bonds& bonds) : share_(s.size(), 1.0) {
    const auto k_t = shear_stiffness(bonds);
    const auto law = laws_of(bonds);
    std::vector<double> best = share_;
    single_ = share_;
    double lowest = 1e300;
    std::vector<double> eigenvalue(s.size());
    for (int sweep = 0; sweep < 12; ++sweep) {
#pragma omp parallel for schedule(static)
        for (std::size_t k = 0; k < s.size(); ++k) {
            Block block;
            add_pairs(s, bonds, k_t, k, share_, block);
            if (bonds.moments) {
                add_moments(s, bonds, law, k, share_, block);
            }
            eigenvalue[k] = block.limit(s.mass[k], s.inertia[k], false).second;
        }
        const double largest = eigenvalue.empty() ? 0.0 : *std::max_element(eigenvalue.begin(), eigenvalue.end());
        for (std::size_t k = 0; k < s.size() && sweep == 0; ++k) {
            single_[k] = std::sqrt(std::max(eigenvalue[k], 1e-12 * largest));
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

double StepBound::limit(const Spheres& s, const Bonds& bonds, const Contacts& contacts, const std::vector<Platen>& platens) const {
    const auto k_t = shear_stiffness(bonds);
    const auto law = laws_of(bonds);
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> walls(s.size()); // (platen, entry) of each sphere
    for (std::size_t p = 0; p < platens.size(); ++p) {
        for (std::size_t e = 0; e < platens[p].sphere.size(); ++e) {
            walls[static_cast<std::size_t>(platens[p].sphere[e])].emplace_back(p, e);
        }
    }
    double lowest = 1e300;
#pragma omp parallel for schedule(static) reduction(min : lowest)
    for (std::size_t k = 0; k < s.size(); ++k) {
        Block block;
        add_pairs(s, bonds, k_t, k, share_, block);
        if (bonds.moments) {
            add_moments(s, bonds, law, k, share_, block);
        }
        if (contacts.size() > 0) {
            add_pairs(s, contacts, contacts.shear_stiffness, k, single_, block);
        }
        for (const auto& [p, e] : walls[k]) {
            const auto& platen = platens[p];
            block.add(Vec3(0, 0, -platen.inward), platen.stiffness[e], platen.shear_stiffness[e], 0.0, platen.contact_distance[e], 1.0);
        }
        lowest = std::min(lowest, block.limit(s.mass[k], s.inertia[k], true).first);
    }
    return lowest;
}

double largest_eigenvalue(const Spheres& s, const Bonds& bonds, int iterations) {
    const auto k_t = shear_stiffness(bonds);
    using Vec = Eigen::VectorXd;
    const auto n = static_cast<Eigen::Index>(s.size());
    Vec scale(6 * n);
    for (Eigen::Index k = 0; k < n; ++k) {
        scale.segment<3>(6 * k).setConstant(1.0 / std::sqrt(s.mass[static_cast<std::size_t>(k)]));
        scale.segment<3>(6 * k + 3).setConstant(1.0 / std::sqrt(s.inertia[static_cast<std::size_t>(k)]));
    }
    Vec x(6 * n);
    for (Eigen::Index k = 0; k < 6 * n; ++k) {
        x[k] = std::sin(12.9898 * static_cast<double>(k + 1)); // any start that is not orthogonal to the mode sought
    }
    double lambda = 0.0;
    for (int it = 0; it < iterations; ++it) {
        const Vec q = scale.cwiseProduct(x.normalized());
        Vec f = Vec::Zero(6 * n);
        for (std::size_t b = 0; b < bonds.size(); ++b) {
            const auto i = static_cast<std::size_t>(bonds.i[b]);
            const auto j = static_cast<std::size_t>(bonds.j[b]);
            const auto a = 6 * static_cast<Eigen::Index>(i);
            const auto c = 6 * static_cast<Eigen::Index>(j);
            const Vec3 to = s.position.at(j) - s.position.at(i);
            const double d = to.norm();
            const Vec3 n_ij = to / d;
            const double l_i = bonds.forces[b].share_i * d;
            const double l_j = d - l_i;
            const Vec3 rel = q.segment<3>(c) - q.segment<3>(a) - (l_i * q.segment<3>(a + 3) + l_j * q.segment<3>(c + 3)).cross(n_ij);
            const Vec3 along = n_ij * n_ij.dot(rel);
            const Vec3 force = bonds.stiffness[b] * along + k_t[b] * (rel - along);
            f.segment<3>(a) -= force;
            f.segment<3>(c) += force;
            f.segment<3>(a + 3) -= l_i * n_ij.cross(force);
            f.segment<3>(c + 3) -= l_j * n_ij.cross(force);
        }
        x = scale.cwiseProduct(f);
        lambda = x.norm();
    }
    return lambda;
}

} // namespace proveta
