// What a circle and a triangle have in common by integrating chords, in extended precision: the independent answer to
// core/coupling/circle_triangle.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/coupling/circle_triangle.hpp"

namespace proveta::verification {

/// A circle and a triangle a, b, c in one plane, m.
struct CircleAndTriangle {
    Vec3 centre;
    double radius = 0.0;
    std::array<Vec3, 3> corner;

    [[nodiscard]] Piece piece() const { return proveta::circle_triangle(centre, radius, corner[0], corner[1], corner[2]); }
};

namespace chords {

using Real = long double;
using Real2 = Eigen::Matrix<Real, 2, 1>;
using Real3 = Eigen::Matrix<Real, 3, 1>;

// In the triangle's plane, as seen from the circle's centre.
struct Plane {
    Real3 origin, x, y;
    Real radius = 0;
    std::array<Real2, 3> corner;

    explicit Plane(const CircleAndTriangle& s) : origin(s.centre.cast<Real>()), radius(s.radius) {
        const std::array<Real3, 3> v{s.corner[0].cast<Real>(), s.corner[1].cast<Real>(), s.corner[2].cast<Real>()};
        x = (v[1] - v[0]).normalized();
        y = (v[2] - v[0] - (v[2] - v[0]).dot(x) * x).normalized();
        y = (y - y.dot(x) * x).normalized();
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = {(v[k] - origin).dot(x), (v[k] - origin).dot(y)};
        }
    }
};

// Where the circle crosses the edge from p to q.
inline std::vector<Real2> crossings(const Real2& p, const Real2& q, Real radius) {
    const Real2 along = (q - p).normalized();
    const Real foot = -p.dot(along);
    const Real2 nearest = p + foot * along;
    const Real square = (radius - nearest.norm()) * (radius + nearest.norm());
    std::vector<Real2> found;
    if (square > 0) {
        for (const Real t : {foot - std::sqrt(square), foot + std::sqrt(square)}) {
            if (t > 0 && t < (q - p).norm()) {
                found.push_back(p + t * along);
            }
        }
    }
    return found;
}

// Lowest and highest point of the triangle on the line of constant x; the first above the second if there is none.
inline std::pair<Real, Real> across(const std::array<Real2, 3>& corner, Real x) {
    std::pair<Real, Real> found{1e300L, -1e300L};
    for (std::size_t k = 0; k < 3; ++k) {
        const Real2 &p = corner[k], &q = corner[(k + 1) % 3];
        if (std::min(p.x(), q.x()) <= x && x <= std::max(p.x(), q.x()) && p.x() != q.x()) {
            const Real y = p.y() + (x - p.x()) / (q.x() - p.x()) * (q.y() - p.y());
            found = {std::min(found.first, y), std::max(found.second, y)};
        }
    }
    return found;
}

// Points and weights of Gauss and Legendre on [-1, 1].
inline std::vector<std::pair<Real, Real>> gauss(std::size_t n) {
    std::vector<std::pair<Real, Real>> rule;
    for (std::size_t i = 0; i < n; ++i) {
        Real z = std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + 0.75L) / (static_cast<Real>(n) + 0.5L));
        Real slope = 0;
        for (int step = 0; step < 8; ++step) {
            Real before = 1, p = z;
            for (std::size_t k = 2; k <= n; ++k) {
                const auto m = static_cast<Real>(k);
                before = std::exchange(p, ((2 * m - 1) * z * p - (m - 1) * before) / m);
            }
            slope = static_cast<Real>(n) * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        rule.emplace_back(z, 2 / ((1 - z * z) * slope * slope));
    }
    return rule;
}

} // namespace chords

/// Area, m2, and centroid, m, by integrating the chord's length over the lines x = radius sin(t). Between corners and crossings the
/// integrand is a polynomial in sin(t) and cos(t), which 24 points integrate to rounding.
inline Piece chord_integral(const CircleAndTriangle& s) {
    using namespace chords;
    static const auto rule = gauss(24);
    const Plane plane(s);
    const Real half_turn = std::numbers::pi_v<Real> / 2;
    std::vector<Real> breaks{-half_turn, half_turn};
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::fabs(plane.corner[k].x()) < plane.radius) {
            breaks.push_back(std::asin(plane.corner[k].x() / plane.radius));
        }
        for (const Real2& p : crossings(plane.corner[k], plane.corner[(k + 1) % 3], plane.radius)) {
            breaks.push_back(std::atan2(p.x(), std::fabs(p.y())));
        }
    }
    std::sort(breaks.begin(), breaks.end());
    Real area = 0;
    Real2 moment(0, 0);
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
        const Real half = (breaks[k + 1] - breaks[k]) / 2;
        for (const auto& [z, weight] : rule) {
            const Real t = breaks[k] + half * (1 + z);
            const Real x = plane.radius * std::sin(t), y = plane.radius * std::cos(t);
            const auto [low, high] = across(plane.corner, x);
            const Real bottom = std::max(low, -y), top = std::min(high, y);
            if (bottom < top) {
                const Real strip = weight * half * y * (top - bottom);
                area += strip;
                moment += strip * Real2(x, (bottom + top) / 2);
            }
        }
    }
    if (area <= 0) {
        return {};
    }
    const Real3 at = plane.origin + moment.x() / area * plane.x + moment.y() / area * plane.y;
    return {static_cast<double>(area), at.cast<double>()};
}

/// The row of the thesis's table C.4: a to h, or '-' if circle and triangle have nothing in common.
inline char case_of_table(const CircleAndTriangle& s) {
    const chords::Plane plane(s);
    std::size_t inside = 0, crossed = 0;
    bool around_centre = true; // both edges' ends seen counter-clockwise from the centre
    for (std::size_t k = 0; k < 3; ++k) {
        const auto &p = plane.corner[k], &q = plane.corner[(k + 1) % 3];
        inside += p.norm() <= plane.radius ? 1U : 0U;
        crossed += chords::crossings(p, q, plane.radius).empty() ? 0U : 1U;
        around_centre = around_centre && p.x() * q.y() - p.y() * q.x() > 0;
    }
    switch (inside) {
    case 0: return crossed > 0 ? "-bcd"[crossed] : around_centre ? 'a' : '-';
    case 1: return crossed > 2 ? 'f' : 'e';
    case 2: return 'g';
    default: return 'h';
    }
}

} // namespace proveta::verification
