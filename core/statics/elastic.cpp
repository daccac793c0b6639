#include "core/statics/elastic.hpp"

#include <omp.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <string>

#include "core/statics/two_level.hpp"

namespace proveta {

namespace {

using Vec = Eigen::VectorXd;
using Index = Eigen::Index;
using Matrix = Eigen::SparseMatrix<double>;

// What holds each component of motion by itself.
Vec diagonals(const BondNetwork& network) {
    Vec own(6 * static_cast<Index>(network.spheres()));
    for (std::size_t k = 0; k < network.spheres(); ++k) {
        own.segment<6>(6 * static_cast<Index>(k)) = network.diagonal(k).diagonal();
    }
    return own;
}

// Where the supports hold the components they name; with `free`, these are taken out of it. In a plane only x, z and turns about y move.
Vec prescribe(const std::vector<Support>& supports, const Spheres& spheres, Vec* free = nullptr) {
    const bool moving[6] = {true, !spheres.planar, true, !spheres.planar, true, !spheres.planar};
    Vec prescribed = Vec::Zero(6 * static_cast<Index>(spheres.size()));
    for (const auto& support : supports) {
        if (support.sphere >= spheres.size() || support.component < 0 || support.component > 5 || !moving[support.component]) {
            throw std::invalid_argument("a support of a sphere or component that is not there");
        }
        const auto at = 6 * static_cast<Index>(support.sphere) + support.component;
        prescribed[at] = support.value;
        if (free != nullptr) {
            (*free)[at] = 0.0;
        }
    }
    return prescribed;
}

// Which components may move, 1 or 0. Those that nothing holds stay where they are: a shear stiffness of zero leaves round-off of the normal
// one.
Vec movable(const Vec& own, const Spheres& spheres) {
    const bool moving[6] = {true, !spheres.planar, true, !spheres.planar, true, !spheres.planar};
    Vec free(own.size());
    for (Index k = 0; k < own.size(); k += 6) {
        const double stiffest = own.segment<3>(k).maxCoeff();
        const double r = spheres.radius[static_cast<std::size_t>(k / 6)];
        for (int c = 0; c < 6; ++c) {
            free[k + c] = moving[c] && own[k + c] > 1e-14 * stiffest * (c < 3 ? 1.0 : r * r) ? 1.0 : 0.0;
        }
    }
    return free;
}

// Forces of what bearings rest on, where that moves.
Vec bearing_loads(const BondNetwork& network) {
    Vec f = Vec::Zero(6 * static_cast<Index>(network.spheres()));
    for (const auto& bearing : network.bearings()) {
        const Vec3 push = bearing.stiffness * bearing.motion;
        f.segment<3>(6 * static_cast<Index>(bearing.sphere)) += push;
        f.segment<3>(6 * static_cast<Index>(bearing.sphere) + 3) += bearing.arm.cross(push);
    }
    return f;
}

// Bending the free components' rows and columns out of the network, numbered one after the other.
Matrix assemble(const BondNetwork& network, const Vec& free, const Vec& added, std::vector<int>& number) {
    int unknowns = 0;
    number.assign(static_cast<std::size_t>(free.size()), -1);
    for (Index k = 0; k < free.size(); ++k) {
        if (free[k] > 0.0) {
            number[static_cast<std::size_t>(k)] = unknowns++;
        }
    }
    std::vector<Eigen::Triplet<double>> entries;
    const auto put = [&](std::size_t a, std::size_t b, const BondNetwork::Mat6& m) {
        for (std::size_t r = 0; r < 6; ++r) {
            for (std::size_t c = 0; c < 6; ++c) {
                if (number[6 * a + r] >= number[6 * b + c] && number[6 * b + c] >= 0) {
                    entries.emplace_back(number[6 * a + r], number[6 * b + c], m(static_cast<Index>(r), static_cast<Index>(c)));
                }
            }
        }
    };
    for (std::size_t k = 0; k < network.spheres(); ++k) {
        BondNetwork::Mat6 own = network.diagonal(k);
        own.diagonal() += added.segment<6>(6 * static_cast<Index>(k));
        put(k, k, own);
        for (const auto* s = network.begin(k); s != network.end(k); ++s) {
            put(k, s->other, BondNetwork::coupling(*s));
        }
    }
    Matrix matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Vec solve_directly(const BondNetwork& network, const Vec& free, const Vec& added, const Vec& load) {
    std::vector<int> number;
    const Matrix lower = assemble(network, free, added, number);
    Vec right(lower.rows());
    for (std::size_t k = 0; k < number.size(); ++k) {
        if (number[k] >= 0) {
            right[number[k]] = load[static_cast<Index>(k)];
        }
    }
    // Unit diagonal first: translations and rotations have different units, and a pivot must tell a mechanism in either.
    const Vec scale = lower.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * lower * scale.asDiagonal();
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factors{scaled};
    if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 1e-12) {
        throw NotSolvable("the network is a mechanism, or is not held against rigid motion");
    }
    Vec x = scale.cwiseProduct(factors.solve(scale.cwiseProduct(right)));
    const Vec left = right - lower.selfadjointView<Eigen::Lower>() * x;
    x += scale.cwiseProduct(factors.solve(scale.cwiseProduct(left)));
    Vec q = Vec::Zero(free.size());
    for (std::size_t k = 0; k < number.size(); ++k) {
        if (number[k] >= 0) {
            q[static_cast<Index>(k)] = x[number[k]];
        }
    }
    return q;
}

// Column sums of a .* b, in an order that does not depend on threads.
template <int W> Eigen::Array<double, 1, W> dots(const BondNetwork& network, const NetworkField<W>& a, const NetworkField<W>& b) {
    constexpr Index part = 2048;
    const Index parts = (a.rows() + part - 1) / part;
    std::vector<Eigen::Array<double, 1, W>> sums(static_cast<std::size_t>(parts));
    network.team().run(static_cast<std::size_t>(parts), [&](std::size_t p) {
        const Index from = static_cast<Index>(p) * part;
        const Index rows = std::min(part, a.rows() - from);
        sums[p] = (a.middleRows(from, rows).array() * b.middleRows(from, rows).array()).colwise().sum();
    });
    Eigen::Array<double, 1, W> sum = Eigen::Array<double, 1, W>::Zero();
    for (const auto& s : sums) {
        sum += s;
    }
    return sum;
}

// Conjugate gradients, each column its own. q: start and result; only free components change.
template <int W>
int solve_iteratively(const BondNetwork& network, const Vec& free, const Vec& added, const NetworkField<W>& load, NetworkField<W>& q,
                      const ElasticOptions& options) {
    const TwoLevel inverse(network, free, added);
    using Row = Eigen::Array<double, 1, W>;
    NetworkField<W> theta;
    NetworkField<W> kp;
    const auto stiff = [&](const NetworkField<W>& x) {
        network.apply<W>(x, kp, theta);
        kp = (free.asDiagonal() * (kp + added.asDiagonal() * x)).eval();
    };
    stiff(q);
    NetworkField<W> r = free.asDiagonal() * load;
    const Row target = options.tolerance * options.tolerance * dots<W>(network, r, r);
    r -= kp;
    NetworkField<W> z;
    inverse.apply<W>(r, z);
    NetworkField<W> p = z;
    Row rz = dots<W>(network, r, z);
    int iteration = 0;
    for (; iteration < options.most_iterations && (dots<W>(network, r, r) > target).any(); ++iteration) {
        stiff(p);
        const Row pk = dots<W>(network, p, kp);
        const Row step = (pk > 0.0).select(rz / pk, Row::Zero()); // a column that is done stands still
        q += p * step.matrix().asDiagonal();
        r -= kp * step.matrix().asDiagonal();
        inverse.apply<W>(r, z);
        const Row next = dots<W>(network, r, z);
        const Row ratio = (rz > 0.0).select(next / rz, Row::Zero());
        rz = next;
        p = (z + p * ratio.matrix().asDiagonal()).eval();
    }
    if (iteration == options.most_iterations || !q.allFinite()) {
        throw NotSolvable("conjugate gradients did not converge in " + std::to_string(iteration) +
                          " iterations; the network may be a mechanism, or is not held against rigid motion");
    }
    return std::max(iteration, 1);
}

VectorField column(const Vec& q, Index from) {
    VectorField f;
    for (Index k = from; k < q.size(); k += 6) {
        f.push_back(q.segment<3>(k));
    }
    return f;
}

// Everything that follows from the motions.
ElasticSolution evaluate(const BondNetwork& network, const Bonds& bonds, const NetworkField<1>& q) {
    ElasticSolution out;
    NetworkField<1> f;
    NetworkField<1> theta;
    network.apply<1>(q, f, theta);
    const Vec push = bearing_loads(network);
    out.energy = 0.5 * q.dot(f) - q.dot(push);
    for (const auto& bearing : network.bearings()) {
        out.energy += 0.5 * bearing.motion.dot(bearing.stiffness * bearing.motion);
    }
    const Vec held = f - push;
    out.displacement = column(q, 0);
    out.rotation = column(q, 3);
    out.force = column(held, 0);
    out.moment = column(held, 3);
    out.bond.resize(bonds.size());
    for (std::size_t k = 0; k < network.spheres(); ++k) {
        const auto mine = q.segment<6>(6 * static_cast<Index>(k));
        for (const auto* s = network.begin(k); s != network.end(k); ++s) {
            if (bonds.i[s->bond] != static_cast<std::int32_t>(k)) {
                continue;
            }
            const auto other = q.segment<6>(6 * static_cast<Index>(s->other));
            const Vec3 turned = s->arm * mine.tail<3>() + s->other_arm * other.tail<3>();
            const Vec3 stretch = other.head<3>() - mine.head<3>() + s->n.cross(turned);
            Vec3 force = s->k_t * stretch + (s->k_n - s->k_t) * s->n * s->n.dot(stretch);
            if (!network.dilatation().empty()) {
                force += s->n * (network.dilatation()[k] * s->g * theta[static_cast<Index>(k)] +
                                 network.dilatation()[s->other] * s->other_g * theta[static_cast<Index>(s->other)]);
            }
            out.bond.set(s->bond, force);
        }
    }
    return out;
}

} // namespace

ElasticSolution solve_elastic(const Spheres& spheres, const Bonds& bonds, const std::vector<Support>& supports,
                              const ElasticOptions& options, const std::vector<Bearing>& bearings, const ElasticSolution* start) {
    const BondNetwork network(spheres, bonds, bearings, omp_get_max_threads());
    const Vec own = diagonals(network);
    const Vec added = options.anchor * own;
    Vec free = movable(own, spheres);
    const Vec prescribed = prescribe(supports, spheres, &free);
    NetworkField<1> theta;
    NetworkField<1> load;
    network.apply<1>(prescribed, load, theta);
    load = free.cwiseProduct(bearing_loads(network) - load);
    NetworkField<1> q = NetworkField<1>::Zero(free.size());
    int iterations = 0;
    const auto unknowns = static_cast<std::size_t>(free.sum());
    if (unknowns > 0 && load.squaredNorm() > 0.0) {
        const std::size_t most = network.dilatation().empty() ? (spheres.planar ? options.direct_in_plane : options.direct_in_space) : 0;
        if (unknowns <= most) {
            q = solve_directly(network, free, added, load);
        } else {
            for (std::size_t k = 0; start != nullptr && k < spheres.size(); ++k) {
                q.segment<3>(6 * static_cast<Index>(k)) = start->displacement.at(k);
                q.segment<3>(6 * static_cast<Index>(k) + 3) = start->rotation.at(k);
            }
            q = free.cwiseProduct(q);
            iterations = solve_iteratively<1>(network, free, added, load, q, options);
        }
    }
    q += prescribed;
    ElasticSolution out = evaluate(network, bonds, q);
    out.iterations = iterations;
    return out;
}

std::vector<ElasticSolution> solve_elastic(const Spheres& spheres, const Bonds& bonds, const std::vector<std::vector<Support>>& cases,
                                           const ElasticOptions& options) {
    constexpr int width = 6;
    if (cases.empty() || cases.size() > width) {
        throw std::invalid_argument("one to six cases");
    }
    const BondNetwork network(spheres, bonds, {}, omp_get_max_threads());
    const Vec own = diagonals(network);
    const Vec added = options.anchor * own;
    Vec free = movable(own, spheres);
    NetworkField<width> prescribed = NetworkField<width>::Zero(free.size(), width);
    for (std::size_t c = 0; c < cases.size(); ++c) {
        prescribed.col(static_cast<Index>(c)) = prescribe(cases[c], spheres, c == 0 ? &free : nullptr);
    }
    NetworkField<width> theta;
    NetworkField<width> load;
    network.apply<width>(prescribed, load, theta);
    load = (free.asDiagonal() * -load).eval();
    NetworkField<width> q = NetworkField<width>::Zero(load.rows(), width);
    const int iterations = load.squaredNorm() > 0.0 ? solve_iteratively<width>(network, free, added, load, q, options) : 0;
    q += prescribed;
    std::vector<ElasticSolution> out;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        out.push_back(evaluate(network, bonds, q.col(static_cast<Index>(c))));
        out.back().iterations = iterations;
    }
    return out;
}

} // namespace proveta
