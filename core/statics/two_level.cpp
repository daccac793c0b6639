#include "core/statics/two_level.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace proveta {

namespace {

constexpr double spheres_a_clump = 64.0;
constexpr double most_clumps = 400.0; // the coarse solve is sequential; more would cost more than they save

// Inverse of a symmetric matrix on the space where it is not zero.
BondNetwork::Mat6 pseudo_inverse(const BondNetwork::Mat6& m) {
    BondNetwork::Vec6 scale = BondNetwork::Vec6::Zero();
    for (int c = 0; c < 6; ++c) {
        scale[c] = m(c, c) > 0.0 ? 1.0 / std::sqrt(m(c, c)) : 0.0;
    }
    const Eigen::SelfAdjointEigenSolver<BondNetwork::Mat6> solver(scale.asDiagonal() * m * scale.asDiagonal());
    BondNetwork::Vec6 inverse = BondNetwork::Vec6::Zero();
    for (int c = 0; c < 6; ++c) {
        inverse[c] = solver.eigenvalues()[c] > 1e-13 ? 1.0 / solver.eigenvalues()[c] : 0.0;
    }
    return scale.asDiagonal() * solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() * scale.asDiagonal();
}

} // namespace

TwoLevel::TwoLevel(const BondNetwork& network, const Eigen::VectorXd& free, const Eigen::VectorXd& added)
    : network_(network), free_(free), inverse_(network.spheres()) {
    constexpr std::size_t part = 128;
    network_.team().run((inverse_.size() + part - 1) / part, [&](std::size_t p) {
        for (std::size_t k = p * part; k < std::min(inverse_.size(), (p + 1) * part); ++k) {
            const auto mask = free_.segment<6>(6 * static_cast<Eigen::Index>(k)).asDiagonal();
            Mat6 own = network_.diagonal(k);
            own.diagonal() += added.segment<6>(6 * static_cast<Eigen::Index>(k));
            inverse_[k] = pseudo_inverse(mask * own * mask);
        }
    });
    gather_clumps();
    assemble_coarse(added);
}

// Clumps are the cells of a grid over the specimen.
void TwoLevel::gather_clumps() {
    const std::size_t n = network_.spheres();
    const auto& x = network_.position();
    Vec3 low = x.at(0);
    Vec3 high = low;
    for (std::size_t k = 1; k < n; ++k) {
        low = low.cwiseMin(x.at(k));
        high = high.cwiseMax(x.at(k));
    }
    const Vec3 size = (high - low).cwiseMax(1e-9 * (high - low).maxCoeff() + 1e-300);
    const double clumps = std::clamp(static_cast<double>(n) / spheres_a_clump, 1.0, most_clumps);
    const double cell = network_.planar() ? std::sqrt(size.x() * size.z() / clumps) : std::cbrt(size.prod() / clumps);
    std::map<std::array<int, 3>, std::uint32_t> number;
    clump_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 at = (x.at(k) - low) / cell;
        const std::array<int, 3> key{static_cast<int>(at.x()), network_.planar() ? 0 : static_cast<int>(at.y()), static_cast<int>(at.z())};
        clump_[k] = number.try_emplace(key, static_cast<std::uint32_t>(number.size())).first->second;
    }
    member_offset_.assign(number.size() + 1, 0);
    centre_.assign(number.size(), Vec3::Zero());
    for (std::size_t k = 0; k < n; ++k) {
        ++member_offset_[clump_[k] + 1];
        centre_[clump_[k]] += x.at(k);
    }
    std::partial_sum(member_offset_.begin(), member_offset_.end(), member_offset_.begin());
    member_.resize(n);
    auto next = member_offset_;
    for (std::size_t k = 0; k < n; ++k) {
        member_[next[clump_[k]]++] = static_cast<std::uint32_t>(k);
    }
    for (std::size_t c = 0; c < centre_.size(); ++c) {
        centre_[c] /= member_offset_[c + 1] - member_offset_[c];
    }
}

TwoLevel::Mat6 TwoLevel::modes(std::size_t sphere) const {
    const Vec3 r = network_.position().at(sphere) - centre_[clump_[sphere]];
    Mat6 m = Mat6::Identity();
    m.topRightCorner<3, 3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0; // rotation x r
    return free_.segment<6>(6 * static_cast<Eigen::Index>(sphere)).asDiagonal() * m;
}

void TwoLevel::assemble_coarse(const Eigen::VectorXd& added) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Mat6> blocks;
    const auto block = [&](std::uint32_t a, std::uint32_t b) -> Mat6& { return blocks.try_emplace({a, b}, Mat6::Zero()).first->second; };
    for (std::size_t k = 0; k < network_.spheres(); ++k) {
        const Mat6 own = modes(k);
        Mat6 stiffness = network_.diagonal(k, false);
        stiffness.diagonal() += added.segment<6>(6 * static_cast<Eigen::Index>(k));
        block(clump_[k], clump_[k]) += own.transpose() * stiffness * own;
        for (const auto* s = network_.begin(k); s != network_.end(k); ++s) {
            block(clump_[k], clump_[s->other]) += own.transpose() * BondNetwork::coupling(*s) * modes(s->other);
        }
        if (!network_.dilatation().empty()) { // theta of this sphere, by the motions of the clumps that it has bonds to
            std::map<std::uint32_t, BondNetwork::Vec6> by;
            const auto add = [&](std::size_t sphere, const Mat6& moves, const Vec3& n) {
                by.try_emplace(clump_[sphere], BondNetwork::Vec6::Zero()).first->second += moves.topRows<3>().transpose() * n;
            };
            for (const auto* s = network_.begin(k); s != network_.end(k); ++s) {
                add(s->other, modes(s->other), s->g * s->n);
                add(k, own, -s->g * s->n);
            }
            for (const auto& [a, of_a] : by) {
                for (const auto& [b, of_b] : by) {
                    block(a, b) += network_.dilatation()[k] * of_a * of_b.transpose();
                }
            }
        }
    }
    std::vector<Eigen::Triplet<double>> entries;
    const auto size = static_cast<int>(6 * centre_.size());
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(size);
    for (const auto& [at, m] : blocks) {
        for (int r = 0; r < 6; ++r) {
            for (int c = 0; c < 6; ++c) {
                const int row = 6 * static_cast<int>(at.first) + r;
                const int column = 6 * static_cast<int>(at.second) + c;
                if (row >= column && m(r, c) != 0.0) {
                    entries.emplace_back(row, column, m(r, c));
                }
                if (row == column) {
                    diagonal[row] = m(r, c);
                }
            }
        }
    }
    for (int r = 0; r < size; ++r) { // modes that move nothing, and nearly those, get something to stand on
        entries.emplace_back(r, r, diagonal[r] > 0.0 ? 1e-9 * diagonal[r] : 1.0);
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    coarse_.compute(matrix);
    has_coarse_ = coarse_.info() == Eigen::Success && coarse_.vectorD().minCoeff() > 0.0;
}

template <int W> void TwoLevel::apply(const NetworkField<W>& r, NetworkField<W>& z) const {
    using Six = Eigen::Matrix<double, 6, W>;
    z.resize(r.rows(), r.cols());
    const auto at = [](std::size_t k) { return 6 * static_cast<Eigen::Index>(k); };
    const std::size_t clumps = centre_.size();
    Eigen::MatrixXd coarse(6 * static_cast<Eigen::Index>(clumps), r.cols());
    network_.team().run(clumps, [&](std::size_t c) {
        Six sum = Six::Zero();
        for (auto m = member_offset_[c]; m < member_offset_[c + 1]; ++m) {
            const std::size_t k = member_[m];
            const Six mine = r.template middleRows<6>(at(k));
            z.template middleRows<6>(at(k)) = inverse_[k] * mine;
            sum += modes(k).transpose() * mine;
        }
        coarse.template middleRows<6>(at(c)) = sum;
    });
    if (!has_coarse_) {
        return;
    }
    const Eigen::MatrixXd moved = coarse_.solve(coarse);
    network_.team().run(clumps, [&](std::size_t c) {
        const Six of_clump = moved.template middleRows<6>(at(c));
        for (auto m = member_offset_[c]; m < member_offset_[c + 1]; ++m) {
            z.template middleRows<6>(at(member_[m])) += modes(member_[m]) * of_clump;
        }
    });
}

template void TwoLevel::apply<1>(const NetworkField<1>&, NetworkField<1>&) const;
template void TwoLevel::apply<6>(const NetworkField<6>&, NetworkField<6>&) const;

} // namespace proveta
