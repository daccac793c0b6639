// The linear field that follows displacements best.
#pragma once

#include <Eigen/Dense>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Least squares of u = a + G x over points.
class LinearField {
  public:
    /// x: where, from an origin of the caller's choice near the points; u: what was found there.
    void add(const Vec3& x, const Vec3& u) {
        const Eigen::Vector4d row(1.0, x.x(), x.y(), x.z());
        normal_ += row * row.transpose();
        right_ += row * u.transpose();
    }

    /// Row k of the result: the derivatives of u to x_k, the transpose of G. planar: all y are 0, and so is what is said of them.
    [[nodiscard]] Mat3 slopes(bool planar) const {
        Eigen::Matrix4d normal = normal_;
        if (planar) {
            normal(2, 2) = 1.0;
        }
        return normal.ldlt().solve(right_).bottomRows<3>();
    }

  private:
    Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> right_ = Eigen::Matrix<double, 4, 3>::Zero();
};

} // namespace proveta
