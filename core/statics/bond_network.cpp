#include "core/statics/bond_network.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

constexpr std::size_t part = 128; // spheres a part of the work

// a x B column by column.
template <int W, class B> Eigen::Matrix<double, 3, W> cross(const Vec3& a, const B& b) {
    Eigen::Matrix<double, 3, W> out;
    out.row(0) = a.y() * b.row(2) - a.z() * b.row(1);
    out.row(1) = a.z() * b.row(0) - a.x() * b.row(2);
    out.row(2) = a.x() * b.row(1) - a.y() * b.row(0);
    return out;
}

} // namespace

BondNetwork::BondNetwork(const Spheres& s, const Bonds& b, std::vector<Bearing> bearings, int threads)
    : position_(s.position), planar_(s.planar), bearings_(std::move(bearings)), offset_(b.incidence.offset),
      dilatation_(b.dilatation.stiffness), team_(std::make_unique<Team>(threads)) {
    std::vector<std::uint32_t> group(b.size());
    for (const auto& block : b.blocks) {
        std::fill(group.begin() + block.begin, group.begin() + block.end, block.group);
    }
    sides_.resize(b.incidence.entry.size());
    for (std::size_t e = 0; e < sides_.size(); ++e) {
        const auto k = b.incidence.entry[e] >> 1;
        const bool second = (b.incidence.entry[e] & 1u) != 0;
        const auto mine = static_cast<std::size_t>(second ? b.j[k] : b.i[k]);
        const auto other = static_cast<std::size_t>(second ? b.i[k] : b.j[k]);
        const Vec3 to = s.position.at(other) - s.position.at(mine);
        const double d = to.norm();
        const BondBeams& l = b.groups[group[k]].beams;
        const double share = second ? 1.0 - b.share[k] : b.share[k];
        Side& side = sides_[e];
        side = {static_cast<std::uint32_t>(other),
                static_cast<std::uint32_t>(k),
                to / d,
                b.stiffness[k],
                l.shear_ratio * b.stiffness[k],
                share * d,
                (1.0 - share) * d,
                0.0,
                0.0,
                0.0,
                0.0};
        if (b.dilatation.active()) {
            side.g = second ? b.dilatation.g_j[k] : b.dilatation.g_i[k];
            side.other_g = second ? b.dilatation.g_i[k] : b.dilatation.g_j[k];
        }
        if (b.moments) {
            side.bend = l.bending_stiffness(b.stiffness[k], b.area[k]);
            side.twist = l.twisting_stiffness(b.stiffness[k], b.area[k]);
        }
    }
    std::stable_sort(bearings_.begin(), bearings_.end(), [](const Bearing& x, const Bearing& y) { return x.sphere < y.sphere; });
    bearing_offset_.assign(s.size() + 1, 0);
    for (const auto& bearing : bearings_) {
        ++bearing_offset_[bearing.sphere + 1];
    }
    for (std::size_t k = 0; k < s.size(); ++k) {
        bearing_offset_[k + 1] += bearing_offset_[k];
    }
}

template <int W> void BondNetwork::apply(const NetworkField<W>& q, NetworkField<W>& f, NetworkField<W>& theta) const {
    using Three = Eigen::Matrix<double, 3, W>;
    const std::size_t n = spheres();
    const std::size_t parts = (n + part - 1) / part;
    const auto at = [](std::size_t sphere) { return 6 * static_cast<Eigen::Index>(sphere); };
    f.resize(q.rows(), q.cols());
    const bool averaged = !dilatation_.empty();
    if (averaged) {
        theta.resize(static_cast<Eigen::Index>(n), q.cols());
        team_->run(parts, [&](std::size_t p) {
            for (std::size_t k = p * part; k < std::min(n, (p + 1) * part); ++k) {
                auto sum = theta.row(static_cast<Eigen::Index>(k));
                sum.setZero();
                for (const Side* s = begin(k); s != end(k); ++s) {
                    sum += s->g * (s->n.transpose() * (q.template middleRows<3>(at(s->other)) - q.template middleRows<3>(at(k))));
                }
            }
        });
    }
    team_->run(parts, [&](std::size_t p) {
        for (std::size_t k = p * part; k < std::min(n, (p + 1) * part); ++k) {
            const Three u = q.template middleRows<3>(at(k));
            const Three w = q.template middleRows<3>(at(k) + 3);
            Three force = Three::Zero();
            Three moment = Three::Zero();
            for (const Side* s = begin(k); s != end(k); ++s) {
                const auto w_other = q.template middleRows<3>(at(s->other) + 3);
                // u_j - u_i - (l_i w_i + l_j w_j) x n
                const Three turned = s->arm * w + s->other_arm * w_other;
                Three stretch = q.template middleRows<3>(at(s->other)) - u;
                stretch += cross<W>(s->n, turned);
                const Eigen::Matrix<double, 1, W> along = s->n.transpose() * stretch;
                Eigen::Matrix<double, 1, W> pull = (s->k_n - s->k_t) * along;
                if (averaged) {
                    pull += dilatation_[k] * s->g * theta.row(static_cast<Eigen::Index>(k)) +
                            dilatation_[s->other] * s->other_g * theta.row(static_cast<Eigen::Index>(s->other));
                }
                const Three of_bond = s->k_t * stretch + s->n * pull;
                force -= of_bond;
                moment -= s->arm * cross<W>(s->n, of_bond);
                if (s->bend > 0.0 || s->twist > 0.0) {
                    const Three rolled = w_other - w;
                    moment -= s->bend * rolled + (s->twist - s->bend) * s->n * (s->n.transpose() * rolled);
                }
            }
            for (auto r = bearing_offset_[k]; r < bearing_offset_[k + 1]; ++r) {
                const Bearing& bearing = bearings_[r];
                const Three held = bearing.stiffness * (u - cross<W>(bearing.arm, w)); // w x arm = -arm x w
                force += held;
                moment += cross<W>(bearing.arm, held);
            }
            f.template middleRows<3>(at(k)) = force;
            f.template middleRows<3>(at(k) + 3) = moment;
        }
    });
}

template void BondNetwork::apply<1>(const NetworkField<1>&, NetworkField<1>&, NetworkField<1>&) const;
template void BondNetwork::apply<6>(const NetworkField<6>&, NetworkField<6>&, NetworkField<6>&) const;

namespace {

// Motion of a contact point by a sphere's motion: u - arm n x ... = [I, -arm x].
Eigen::Matrix<double, 3, 6> point_motion(const Vec3& arm) {
    Eigen::Matrix<double, 3, 6> m;
    m << Mat3::Identity(), -cross_matrix(arm);
    return m;
}

Mat3 springs(const BondNetwork::Side& s) { return s.k_t * Mat3::Identity() + (s.k_n - s.k_t) * s.n * s.n.transpose(); }

} // namespace

BondNetwork::Mat6 BondNetwork::diagonal(std::size_t sphere, bool averaged) const {
    averaged = averaged && !dilatation_.empty();
    Mat6 m = Mat6::Zero();
    Vec3 own = Vec3::Zero(); // change of theta with the sphere's own displacement
    for (const Side* s = begin(sphere); s != end(sphere); ++s) {
        const auto of = point_motion(s->arm * s->n);
        m += of.transpose() * springs(*s) * of;
        m.bottomRightCorner<3, 3>() += s->bend * Mat3::Identity() + (s->twist - s->bend) * s->n * s->n.transpose();
        if (averaged) {
            own -= s->g * s->n;
            m.topLeftCorner<3, 3>() += dilatation_[s->other] * s->other_g * s->other_g * s->n * s->n.transpose();
        }
    }
    if (averaged) {
        m.topLeftCorner<3, 3>() += dilatation_[sphere] * own * own.transpose();
    }
    for (auto r = bearing_offset_[sphere]; r < bearing_offset_[sphere + 1]; ++r) {
        const auto of = point_motion(bearings_[r].arm);
        m += of.transpose() * bearings_[r].stiffness * of;
    }
    return m;
}

BondNetwork::Mat6 BondNetwork::coupling(const Side& s) {
    Mat6 m = -point_motion(s.arm * s.n).transpose() * springs(s) * point_motion(-s.other_arm * s.n);
    m.bottomRightCorner<3, 3>() -= s.bend * Mat3::Identity() + (s.twist - s.bend) * s.n * s.n.transpose();
    return m;
}

double largest_eigenvalue(const Spheres& s, const Bonds& bonds, int iterations) {
    const BondNetwork network(s, bonds, {}, 1);
    const auto n = static_cast<Eigen::Index>(s.size());
    NetworkField<1> scale(6 * n);
    for (Eigen::Index k = 0; k < n; ++k) {
        scale.segment<3>(6 * k).setConstant(1.0 / std::sqrt(s.mass[static_cast<std::size_t>(k)]));
        scale.segment<3>(6 * k + 3).setConstant(1.0 / std::sqrt(s.inertia[static_cast<std::size_t>(k)]));
    }
    NetworkField<1> x(6 * n);
    for (Eigen::Index k = 0; k < 6 * n; ++k) {
        x[k] = std::sin(12.9898 * static_cast<double>(k + 1)); // any start that is not orthogonal to the mode sought
    }
    NetworkField<1> f;
    NetworkField<1> theta;
    double lambda = 0.0;
    for (int it = 0; it < iterations; ++it) {
        const NetworkField<1> q = scale.cwiseProduct(x.normalized());
        network.apply<1>(q, f, theta);
        x = scale.cwiseProduct(f);
        lambda = x.norm();
    }
    return lambda;
}

} // namespace proveta
