#include "core/statics/elastic.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace proveta {

namespace {

using Vec = Eigen::VectorXd;
using Index = Eigen::Index;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat36 = Eigen::Matrix<double, 3, 6>;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using ColMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor>;

// A bond as a spring: its force on i is K (relative displacement at the contact point), that displacement of_j q_j - of_i q_i.
struct Spring {
    Mat3 stiffness;
    Mat36 of_i, of_j;
};

Spring spring(const Spheres& s, const Bonds& b, std::size_t k, double shear_ratio) {
    const Vec3 to = s.position.at(static_cast<std::size_t>(b.j[k])) - s.position.at(static_cast<std::size_t>(b.i[k]));
    const double d = to.norm();
    const Vec3 n = to / d;
    const double lever_i = b.share[k] * d;
    const Mat3 nn = n * n.transpose();
    Mat3 cross; // n x
    cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
    Spring out;
    out.stiffness = b.stiffness[k] * (nn + shear_ratio * (Mat3::Identity() - nn));
    // u_j - u_i - (l_i w_i + l_j w_j) x n, and w x n = -(n x) w
    out.of_i << Mat3::Identity(), -lever_i * cross;
    out.of_j << Mat3::Identity(), (d - lever_i) * cross;
    return out;
}

class Network {
  public:
    Network(const Spheres& spheres, const Bonds& bonds) : b_(bonds), n_(spheres.size()) {
        springs_.resize(bonds.size());
        for (const auto& block : bonds.blocks) {
            for (std::size_t k = block.begin; k < block.end; ++k) {
                springs_[k] = spring(spheres, bonds, k, bonds.laws[block.law].shear_ratio);
            }
        }
        if (spheres.planar) {
            moving_ = {true, false, true, false, true, false};
        }
    }

    [[nodiscard]] bool moves(int component) const { return moving_[static_cast<std::size_t>(component)]; }

    // Stiffness of each component with everything else held.
    [[nodiscard]] Vec diagonal() const {
        Vec d = Vec::Zero(static_cast<Index>(6 * n_));
        for (std::size_t k = 0; k < b_.size(); ++k) {
            d.segment<6>(at(b_.i[k])) += (springs_[k].of_i.transpose() * springs_[k].stiffness * springs_[k].of_i).diagonal();
            d.segment<6>(at(b_.j[k])) += (springs_[k].of_j.transpose() * springs_[k].stiffness * springs_[k].of_j).diagonal();
        }
        return d;
    }

    // K q, the energy, and each bond's force on its sphere i.
    [[nodiscard]] Vec forces(const Vec& q, double& energy, VectorField& bond) const {
        bond.resize(b_.size());
        Vec f = Vec::Zero(q.size());
        energy = 0.0;
        for (std::size_t k = 0; k < b_.size(); ++k) {
            const auto& e = springs_[k];
            const Vec3 stretch = e.of_j * q.segment<6>(at(b_.j[k])) - e.of_i * q.segment<6>(at(b_.i[k]));
            const Vec3 force = e.stiffness * stretch;
            f.segment<6>(at(b_.j[k])) += e.of_j.transpose() * force;
            f.segment<6>(at(b_.i[k])) -= e.of_i.transpose() * force;
            bond.set(k, force);
            energy += 0.5 * stretch.dot(force);
        }
        return f;
    }

    // Rows and columns of the free components, in the numbering `number` (-1: not free), row by row so that every entry is summed in the
    // order of its sphere's bonds.
    [[nodiscard]] RowMatrix assemble(const std::vector<Index>& number, Index unknowns, const Vec& anchor) const {
        RowMatrix k(unknowns, unknowns);
        std::vector<int> room(static_cast<std::size_t>(unknowns));
        for (std::size_t sphere = 0; sphere < n_; ++sphere) {
            const auto bonds = b_.incidence.offset[sphere + 1] - b_.incidence.offset[sphere];
            for (std::size_t c = 0; c < 6; ++c) {
                if (number[6 * sphere + c] >= 0) {
                    room[static_cast<std::size_t>(number[6 * sphere + c])] = 6 * (static_cast<int>(bonds) + 1);
                }
            }
        }
        k.reserve(room);
        std::vector<std::pair<std::size_t, Mat6>> row;
        for (std::size_t sphere = 0; sphere < n_; ++sphere) {
            row.assign(1, {sphere, Mat6::Zero()});
            for (auto e = b_.incidence.offset[sphere]; e < b_.incidence.offset[sphere + 1]; ++e) {
                const auto bond = b_.incidence.entry[e] >> 1;
                const bool second = (b_.incidence.entry[e] & 1u) != 0;
                const Spring& sp = springs_[bond];
                const Mat36& mine = second ? sp.of_j : sp.of_i;
                const Mat36& other = second ? sp.of_i : sp.of_j;
                row.front().second += mine.transpose() * sp.stiffness * mine;
                row.emplace_back(static_cast<std::size_t>(second ? b_.i[bond] : b_.j[bond]), -mine.transpose() * sp.stiffness * other);
            }
            std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            for (std::size_t r = 0; r < 6; ++r) {
                const Index at_row = number[6 * sphere + r];
                for (std::size_t p = 0; p < row.size() && at_row >= 0; ++p) {
                    for (std::size_t c = 0; c < 6; ++c) {
                        const Index at_column = number[6 * row[p].first + c];
                        if (at_column >= 0) {
                            double value = row[p].second(static_cast<Index>(r), static_cast<Index>(c));
                            value += at_row == at_column ? anchor[static_cast<Index>(6 * sphere + r)] : 0.0;
                            k.insert(at_row, at_column) = value;
                        }
                    }
                }
            }
        }
        k.makeCompressed();
        return k;
    }

  private:
    static Index at(std::int32_t sphere) { return 6 * static_cast<Index>(sphere); }

    const Bonds& b_;
    std::size_t n_;
    std::vector<Spring> springs_;
    std::array<bool, 6> moving_{true, true, true, true, true, true};
};

Vec solve_directly(const RowMatrix& k, const Vec& load) {
    // Unit diagonal first: translations and rotations have different units, and a pivot must tell a mechanism in either.
    const Vec scale = k.diagonal().cwiseSqrt().cwiseInverse();
    const ColMatrix scaled = scale.asDiagonal() * ColMatrix(k) * scale.asDiagonal();
    const Eigen::SimplicialLDLT<ColMatrix, Eigen::Lower> factors{scaled};
    if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 1e-12) {
        throw NotSolvable("the network is a mechanism, or is not held against rigid motion");
    }
    Vec x = scale.cwiseProduct(factors.solve(scale.cwiseProduct(load)));
    x += scale.cwiseProduct(factors.solve(scale.cwiseProduct(load - k * x)));
    return x;
}

Vec solve_iteratively(const RowMatrix& k, const Vec& load, const ElasticOptions& options, int& iterations) {
    Eigen::ConjugateGradient<RowMatrix, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(options.tolerance);
    solver.setMaxIterations(options.most_iterations);
    solver.compute(k);
    const Vec x = solver.solve(load);
    iterations = static_cast<int>(solver.iterations());
    if (solver.info() != Eigen::Success || !x.allFinite()) {
        throw NotSolvable("conjugate gradients did not converge in " + std::to_string(iterations) +
                          " iterations; the network may be a mechanism");
    }
    return x;
}

VectorField part(const Vec& q, Index from) {
    VectorField f;
    for (Index k = from; k < q.size(); k += 6) {
        f.push_back(q.segment<3>(k));
    }
    return f;
}

} // namespace

ElasticSolution solve_elastic(const Spheres& spheres, const Bonds& bonds, const std::vector<Support>& supports,
                              const ElasticOptions& options) {
    const Network network(spheres, bonds);
    const auto n = static_cast<Index>(6 * spheres.size());
    Vec q = Vec::Zero(n);
    std::vector<char> held(static_cast<std::size_t>(n), 0);
    for (const auto& support : supports) {
        if (support.sphere >= spheres.size() || support.component < 0 || support.component > 5 || !network.moves(support.component)) {
            throw std::invalid_argument("a support of a sphere or component that is not there");
        }
        const std::size_t k = 6 * support.sphere + static_cast<std::size_t>(support.component);
        held[k] = 1;
        q[static_cast<Index>(k)] = support.value;
    }
    // Components that no bond holds stay where they are. A shear stiffness of zero leaves round-off of the normal one.
    const Vec diagonal = network.diagonal();
    std::vector<Index> number(static_cast<std::size_t>(n), -1);
    Index unknowns = 0;
    for (Index k = 0; k < n; ++k) {
        const int component = static_cast<int>(k % 6);
        const Index sphere = k - component;
        const double r = spheres.radius[static_cast<std::size_t>(sphere / 6)];
        const double stiffest = diagonal.segment<3>(sphere).maxCoeff() * (component < 3 ? 1.0 : r * r);
        if (!held[static_cast<std::size_t>(k)] && network.moves(component) && diagonal[k] > 1e-14 * stiffest) {
            number[static_cast<std::size_t>(k)] = unknowns++;
        }
    }
    ElasticSolution out;
    Vec load(unknowns);
    const Vec from_supports = network.forces(q, out.energy, out.bond);
    for (Index k = 0; k < n; ++k) {
        if (number[static_cast<std::size_t>(k)] >= 0) {
            load[number[static_cast<std::size_t>(k)]] = -from_supports[k];
        }
    }
    if (unknowns > 0 && load.squaredNorm() > 0.0) {
        const RowMatrix k = network.assemble(number, unknowns, options.anchor * diagonal);
        const std::size_t most = spheres.planar ? options.direct_in_plane : options.direct_in_space;
        const Vec x =
            static_cast<std::size_t>(unknowns) <= most ? solve_directly(k, load) : solve_iteratively(k, load, options, out.iterations);
        for (std::size_t at = 0; at < number.size(); ++at) {
            if (number[at] >= 0) {
                q[static_cast<Index>(at)] = x[number[at]];
            }
        }
    }
    const Vec f = network.forces(q, out.energy, out.bond);
    out.displacement = part(q, 0);
    out.rotation = part(q, 3);
    out.force = part(f, 0);
    out.moment = part(f, 3);
    return out;
}

} // namespace proveta
