// Three-component fields over many items, stored as a structure of arrays.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace proveta {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// The matrix that takes w to v x w.
inline Mat3 cross_matrix(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// One vector per item, each component in an array of its own so that loops over items vectorise.
/// Shape: three arrays of equal length; the unit is the quantity's.
struct VectorField {
    std::vector<double> x, y, z;

    VectorField() = default;
    explicit VectorField(std::size_t n) { resize(n); }

    [[nodiscard]] std::size_t size() const { return x.size(); }

    void resize(std::size_t n, double value = 0.0) {
        x.resize(n, value);
        y.resize(n, value);
        z.resize(n, value);
    }

    void fill(double value) {
        x.assign(x.size(), value);
        y.assign(y.size(), value);
        z.assign(z.size(), value);
    }

    void push_back(const Vec3& v) {
        x.push_back(v.x());
        y.push_back(v.y());
        z.push_back(v.z());
    }

    [[nodiscard]] Vec3 at(std::size_t k) const { return {x[k], y[k], z[k]}; }

    void set(std::size_t k, const Vec3& v) {
        x[k] = v.x();
        y[k] = v.y();
        z[k] = v.z();
    }

    void add(std::size_t k, const Vec3& v) {
        x[k] += v.x();
        y[k] += v.y();
        z[k] += v.z();
    }
};

} // namespace proveta
