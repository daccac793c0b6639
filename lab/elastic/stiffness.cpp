#include "lab/elastic/stiffness.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/geometry/linear_field.hpp"

namespace proveta {

namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};

Vec6 strain_of(const Mat3& m) {
    Vec6 v;
    for (int k = 0; k < 6; ++k) {
        v[k] = (k < 3 ? 0.5 : 1.0) * (m(pairs[k][0], pairs[k][1]) + m(pairs[k][1], pairs[k][0]));
    }
    return v;
}

Vec6 stress_of(const Mat3& m) {
    Vec6 v;
    for (int k = 0; k < 6; ++k) {
        v[k] = 0.5 * (m(pairs[k][0], pairs[k][1]) + m(pairs[k][1], pairs[k][0]));
    }
    return v;
}

// Voigt's averages of a stiffness; of a compliance in engineering strains these are Reuss's, with other weights.
double bulk_voigt(const Mat6& c) { return c.topLeftCorner<3, 3>().sum() / 9.0; }
double shear_voigt(const Mat6& c) {
    const double trace = c(0, 0) + c(1, 1) + c(2, 2);
    const double off = c(0, 1) + c(1, 2) + c(2, 0);
    return (trace - off + 3.0 * (c(3, 3) + c(4, 4) + c(5, 5))) / 15.0;
}
double bulk_reuss(const Mat6& s) { return 1.0 / s.topLeftCorner<3, 3>().sum(); }
double shear_reuss(const Mat6& s) {
    const double trace = s(0, 0) + s(1, 1) + s(2, 2);
    const double off = s(0, 1) + s(1, 2) + s(2, 0);
    return 15.0 / (4.0 * (trace - off) + 3.0 * (s(3, 3) + s(4, 4) + s(5, 5)));
}

// Norm of a stiffness as a tensor of fourth order: shear entries stand for two or four components.
double norm(const Mat6& c) {
    double sum = 0.0;
    for (int r = 0; r < 6; ++r) {
        for (int k = 0; k < 6; ++k) {
            sum += (r < 3 ? 1.0 : 2.0) * (k < 3 ? 1.0 : 2.0) * c(r, k) * c(r, k);
        }
    }
    return std::sqrt(sum);
}

Mat6 isotropic(double bulk, double shear) {
    Mat6 c = Mat6::Zero();
    c.topLeftCorner<3, 3>().setConstant(bulk - 2.0 * shear / 3.0);
    for (int k = 0; k < 3; ++k) {
        c(k, k) += 2.0 * shear;
        c(k + 3, k + 3) = shear;
    }
    return c;
}

} // namespace

StiffnessTensor isotropic_figures(const Mat6& voigt) {
    StiffnessTensor t;
    t.voigt = voigt;
    const Mat6 compliance = voigt.inverse();
    t.bulk_modulus = 0.5 * (bulk_voigt(voigt) + bulk_reuss(compliance));
    t.shear_modulus = 0.5 * (shear_voigt(voigt) + shear_reuss(compliance));
    t.young_modulus = 9.0 * t.bulk_modulus * t.shear_modulus / (3.0 * t.bulk_modulus + t.shear_modulus);
    t.poisson_ratio = (3.0 * t.bulk_modulus - 2.0 * t.shear_modulus) / (2.0 * (3.0 * t.bulk_modulus + t.shear_modulus));
    t.anisotropy = 5.0 * shear_voigt(voigt) / shear_reuss(compliance) + bulk_voigt(voigt) / bulk_reuss(compliance) - 6.0;
    t.from_isotropic = norm(voigt - isotropic(bulk_voigt(voigt), shear_voigt(voigt))) / norm(voigt);
    return t;
}

StiffnessTensor stiffness_tensor(const Shape& shape, const Spheres& s, const Bonds& bonds, const std::vector<std::uint8_t>& skin,
                                 double tolerance) {
    if (shape.planar()) {
        throw std::invalid_argument("a plate has no stiffness tensor in space");
    }
    const Vec3 centre(0.0, 0.0, 0.5 * shape.height);
    std::vector<std::vector<Support>> cases(6);
    std::vector<Mat3> gradient(6, Mat3::Zero());
    for (int c = 0; c < 6; ++c) {
        auto& g = gradient[static_cast<std::size_t>(c)];
        g(pairs[c][0], pairs[c][1]) += 0.5e-6;
        g(pairs[c][1], pairs[c][0]) += 0.5e-6;
        for (std::size_t k = 0; k < s.size(); ++k) {
            if (skin[k] != 0) {
                const Vec3 u = g * (s.position.at(k) - centre);
                for (int d = 0; d < 3; ++d) {
                    cases[static_cast<std::size_t>(c)].push_back({k, d, u[d]});
                }
            }
        }
    }
    const auto solutions = solve_elastic(s, bonds, cases, {.tolerance = tolerance, .anchor = 1e-10});

    const Shape::Region inner = shape.inner(0.6, 0.6);
    std::vector<std::size_t> inside;
    for (std::size_t k = 0; k < s.size(); ++k) {
        if (inner.contains(s.position.at(k)) && bonds.incidence.degree(k) >= 4) { // others may swing
            inside.push_back(k);
        }
    }
    if (inside.size() < 8) {
        throw std::invalid_argument("too few spheres inside");
    }
    Mat6 strains;
    Mat6 stresses;
    for (Eigen::Index c = 0; c < 6; ++c) {
        const auto& solution = solutions[static_cast<std::size_t>(c)];
        LinearField field;
        for (const auto k : inside) {
            field.add(s.position.at(k) - centre, solution.displacement.at(k));
        }
        strains.col(c) = strain_of(field.slopes(false));
        Mat3 stress = Mat3::Zero();
        for (std::size_t b = 0; b < bonds.size(); ++b) {
            const Vec3 at_i = s.position.at(static_cast<std::size_t>(bonds.i[b]));
            const Vec3 at_j = s.position.at(static_cast<std::size_t>(bonds.j[b]));
            stress += inner.fraction_inside(at_i, at_j) * solution.bond.at(b) * (at_j - at_i).transpose();
        }
        stresses.col(c) = stress_of(stress / inner.volume());
    }
    const Mat6 c = stresses * strains.inverse();
    StiffnessTensor t = isotropic_figures(0.5 * (c + c.transpose()));
    t.iterations = solutions.front().iterations;
    return t;
}

} // namespace proveta
