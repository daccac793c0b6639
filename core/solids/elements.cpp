#include "core/solids/element_point.hpp"

#include <Eigen/LU>
#include <cmath>

namespace proveta {

ElementPoint<4> tetrahedron_point(const Nodal<4>& x) {
    ElementPoint<4> p;
    Mat3 edges;
    for (int k = 0; k < 3; ++k) {
        edges.col(k) = x.col(k + 1) - x.col(0);
    }
    const Mat3 inverse = edges.inverse();
    p.gradient.bottomRows<3>() = inverse;
    p.gradient.row(0) = -inverse.colwise().sum();
    p.weight = edges.determinant() / 6.0;
    return p;
}

std::array<ElementPoint<8>, 8> hexahedron_points(const Nodal<8>& x) {
    constexpr std::array<std::array<double, 3>, 8> sign{
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
    const double at = 1.0 / std::sqrt(3.0);
    std::array<ElementPoint<8>, 8> points;
    for (std::size_t q = 0; q < 8; ++q) {
        Eigen::Matrix<double, 8, 3> natural;
        for (int a = 0; a < 8; ++a) {
            const auto& s = sign[static_cast<std::size_t>(a)];
            const double along[3] = {1.0 + s[0] * sign[q][0] * at, 1.0 + s[1] * sign[q][1] * at, 1.0 + s[2] * sign[q][2] * at};
            natural.row(a) << s[0] * along[1] * along[2] / 8.0, along[0] * s[1] * along[2] / 8.0, along[0] * along[1] * s[2] / 8.0;
        }
        const Mat3 jacobian = x * natural;
        points[q].weight = jacobian.determinant();
        points[q].gradient = natural * jacobian.inverse();
    }
    return points;
}

ElementPoint<3, 2> membrane_point(const Nodal<3>& x, double thickness) {
    const Vec3 first = x.col(1) - x.col(0);
    const Vec3 second = x.col(2) - x.col(0);
    const Vec3 e1 = first.normalized();
    const Vec3 e2 = (second - e1.dot(second) * e1).normalized();
    Eigen::Matrix2d edges;
    edges << first.norm(), e1.dot(second), 0.0, e2.dot(second);
    const Eigen::Matrix2d inverse = edges.inverse();
    ElementPoint<3, 2> p;
    p.gradient.bottomRows<2>() = inverse;
    p.gradient.row(0) = -inverse.colwise().sum();
    p.weight = 0.5 * edges.determinant() * thickness;
    return p;
}

} // namespace proveta
