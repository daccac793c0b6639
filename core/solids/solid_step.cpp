// The step that a deformable body's elements are stable with (thesis 4.70 and 4.74).
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/solids/solid.hpp"
#include "core/solids/solid_law.hpp"

namespace proveta {

namespace {

// First constant of an isotropic law in D dimensions: a membrane bears no stress across.
double lambda_of(const Lame& c, int dimensions) { return dimensions == 3 ? c.lambda : 2.0 * c.lambda * c.mu / (c.lambda + 2.0 * c.mu); }

// Largest eigenvalue of M^-1 K of an element at small strain.
template <int N, int D, class Points> double square_frequency(const Points& points, const double* mass, const Lame& c) {
    Eigen::Matrix<double, N * D, N* D> matrix = Eigen::Matrix<double, N * D, N * D>::Zero();
    const double lambda = lambda_of(c, D);
    for (const auto& p : points) {
        for (int a = 0; a < N; ++a) {
            for (int b = 0; b < N; ++b) {
                const auto ga = p.gradient.row(a).transpose();
                const auto gb = p.gradient.row(b).transpose();
                matrix.template block<D, D>(D * a, D * b) += p.weight / std::sqrt(mass[a] * mass[b]) *
                                                             (lambda * ga * gb.transpose() + c.mu * gb * ga.transpose() +
                                                              c.mu * ga.dot(gb) * Eigen::Matrix<double, D, D>::Identity());
            }
        }
    }
    // Of dynamic size: a solver for each size of its own takes the compiler longer than all the rest of this room.
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

template <int D> using Square = Eigen::Matrix<double, D, D>;

template <int D> Eigen::Matrix<double, D, 1> eigenvalues(const Square<D>& of) {
    Eigen::SelfAdjointEigenSolver<Square<D>> solver;
    solver.computeDirect(of, Eigen::EigenvaluesOnly);
    return solver.eigenvalues(); // ascending
}

// Largest value of lambda tr(L s)^2 + 2 mu |sym L s|^2 for |L| = 1, s the root of W: that of L's diagonal in the axes of W, or of a pair of
// entries beside it.
template <int D> double largest_of(const Eigen::Matrix<double, D, 1>& w, double lambda, double mu) {
    const Eigen::Matrix<double, D, 1> root = w.cwiseMax(0.0).cwiseSqrt();
    const Square<D> straight = lambda * root * root.transpose() + Square<D>((2.0 * mu * w).asDiagonal());
    return std::max(eigenvalues<D>(straight)[D - 1], mu * (w[D - 1] + w[D - 2]));
}

// A bound on what a point adds to the same under deformation, from the tangent of its law; in the reference it is exact. With v_a the
// nodes' vectors, g_a the gradients and W = sum g_a g_a^T / m_a, sum v_a x g_a is L W^(1/2), |L|^2 <= v M v.
//
//   Kirchhoff    lambda (F:dF)^2 + 2 mu |sym F^T dF|^2 + S:(dF^T dF)      by the gradients of the reference
//   Neo-Hooke    lambda (tr l)^2 + 2 (mu - lambda ln J) |sym l|^2 + tau:(l^T l), l = dF F^-1, by those of space; j2 alike
//
// stress: of j2, the norm of the first Piola-Kirchhoff stress, Pa.
template <int N, int D>
double bound_at(const SolidMaterial& m, const ElementPoint<N, D>& p, const double* mass, const Nodal<N>& x, double stress) {
    Eigen::Matrix<double, N, D> weighted = p.gradient;
    for (int a = 0; a < N; ++a) {
        weighted.row(a) /= std::sqrt(mass[a]);
    }
    const Square<D> w = weighted.transpose() * weighted;
    const Eigen::Matrix<double, 3, D> F = x * p.gradient;
    const Square<D> C = F.transpose() * F;
    const double stretch = eigenvalues<D>(C)[D - 1]; // square of the largest
    const Lame c = m.lame();
    double mu = c.mu;
    double lambda = lambda_of(c, D);
    if (m.law == SolidLaw::kirchhoff) {
        const double tension = std::max(0.5 * lambda * (C.trace() - D) + mu * (stretch - 1.0), 0.0);
        const auto values = eigenvalues<D>(w);
        return p.weight * (stretch * largest_of<D>(values, lambda, mu) + tension * values[D - 1]);
    }
    double tension = stress * std::sqrt(stretch);
    if (m.law == SolidLaw::neo_hookean) {
        const double area = std::sqrt(C.determinant());
        const double log_j = std::log(area) + (D == 2 ? 0.5 * std::log(neo_hookean::square_of_stretch_across(c, area)) : 0.0);
        tension = std::max(mu * (stretch - 1.0) + c.lambda * log_j, 0.0);
        mu = std::max(mu - c.lambda * log_j, 0.0);
        lambda = lambda_of({c.lambda, mu}, D);
    }
    const Square<D> back = C.llt().matrixL().solve(Square<D>::Identity());
    const auto values = eigenvalues<D>(back * w * back.transpose());
    return p.weight * (largest_of<D>(values, lambda, mu) + tension * values[D - 1]);
}

} // namespace

double Solid::reference_frequency(std::size_t e) const {
    const Lame c = material.lame();
    const std::size_t nt = tetrahedra_.size();
    const std::size_t nh = hexahedra_.size();
    if (e < nt) {
        return square_frequency<4, 3>(std::array{tetrahedra_[e]}, &corner_mass_[4 * e], c);
    }
    if (e < nt + nh) {
        return square_frequency<8, 3>(hexahedra_[e - nt], &corner_mass_[4 * nt + 8 * (e - nt)], c);
    }
    return square_frequency<3, 2>(std::array{membranes_[e - nt - nh]}, &corner_mass_[4 * nt + 8 * nh + 3 * (e - nt - nh)], c);
}

double Solid::bound(std::size_t e, bool deformed) const {
    const std::size_t nt = tetrahedra_.size();
    const std::size_t nh = hexahedra_.size();
    const auto& from = deformed ? position : mesh_.node;
    const double stress = deformed ? stress_[e] : 0.0;
    const auto sum = [&]<std::size_t N>(const std::array<std::uint32_t, N>& nodes, const auto& points, const double* mass) {
        Nodal<static_cast<int>(N)> x;
        for (std::size_t a = 0; a < N; ++a) {
            x.col(static_cast<Eigen::Index>(a)) = from[nodes[a]];
        }
        double out = 0.0;
        for (const auto& p : points) {
            out += bound_at(material, p, mass, x, stress);
        }
        return out;
    };
    if (e < nt) {
        return sum(mesh_.tetrahedra[e], std::array{tetrahedra_[e]}, &corner_mass_[4 * e]);
    }
    if (e < nt + nh) {
        return sum(mesh_.hexahedra[e - nt], hexahedra_[e - nt], &corner_mass_[4 * nt + 8 * (e - nt)]);
    }
    const std::size_t s = e - nt - nh;
    return sum(mesh_.membranes[s], std::array{membranes_[s]}, &corner_mass_[4 * nt + 8 * nh + 3 * s]);
}

std::vector<Solid::NodeDemand> Solid::demands() const {
    std::vector<double> square(mesh_.elements());
    for (std::size_t e = 0; e < square.size(); ++e) {
        square[e] = frequency_[e] * std::max(1.0, bound(e, true) / frequency_bound_[e]);
    }
    // Corners know their element by their place.
    std::vector<double> of_corner;
    of_corner.reserve(corner_mass_.size());
    std::size_t element = 0;
    each_corner_list([&](const std::uint32_t*, std::size_t n) { of_corner.insert(of_corner.end(), n, square[element++]); });
    std::vector<NodeDemand> out(nodes());
    for (std::size_t k = 0; k < nodes(); ++k) {
        double sum = 0.0;
        for (auto e = offset_[k]; e < offset_[k + 1]; ++e) {
            sum += of_corner[from_[e]] * corner_mass_[from_[e]];
        }
        out[k].stiffness = sum / mass_[k];
        out[k].damping = material.mass_damping + material.stiffness_damping * out[k].stiffness;
    }
    return out;
}

} // namespace proveta
