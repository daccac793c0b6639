#include "specimens/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace proveta {

using std::numbers::pi;

double Shape::section() const {
    if (kind == ShapeKind::cylinder) {
        return 0.25 * pi * diameter * diameter;
    }
    return planar() ? width : width * depth;
}

double Shape::volume() const { return section() * height; }

double Shape::lateral_size() const {
    if (kind == ShapeKind::cylinder) {
        return diameter;
    }
    return planar() ? width : std::min(width, depth);
}

std::string Shape::name() const {
    if (kind == ShapeKind::cylinder) {
        return "cylinder";
    }
    return planar() ? "plate" : "prism";
}

std::string Shape::text() const {
    if (kind == ShapeKind::prism) {
        return fmt::format("{} {:.5g} x {:.5g} x {:.5g} mm", name(), 1e3 * width, 1e3 * depth, 1e3 * height);
    }
    return fmt::format("{} {:.5g} x {:.5g} mm", name(), 1e3 * (planar() ? width : diameter), 1e3 * height);
}

double Shape::depth_below_side(const Vec3& p) const {
    if (kind == ShapeKind::cylinder) {
        return 0.5 * diameter - std::hypot(p.x(), p.y());
    }
    const double across = 0.5 * width - std::fabs(p.x());
    return planar() ? across : std::min(across, 0.5 * depth - std::fabs(p.y()));
}

double Shape::depth_below_end(const Vec3& p) const { return std::min(p.z(), height - p.z()); }

double Shape::depth_below_surface(const Vec3& p) const { return std::min(depth_below_side(p), depth_below_end(p)); }

Vec3 Shape::keep_inside(Vec3 p, double r) const {
    p.z() = std::clamp(p.z(), r, height - r);
    if (kind == ShapeKind::cylinder) {
        const double limit = 0.5 * diameter - r;
        const double out = std::hypot(p.x(), p.y());
        if (out > limit) {
            p.x() *= limit / out;
            p.y() *= limit / out;
        }
    } else {
        p.x() = std::clamp(p.x(), -0.5 * width + r, 0.5 * width - r);
        p.y() = planar() ? 0.0 : std::clamp(p.y(), -0.5 * depth + r, 0.5 * depth - r);
    }
    return p;
}

Shape::Region Shape::inner(double lateral, double along) const {
    Region r;
    r.round = kind == ShapeKind::cylinder;
    r.size_x = lateral * (r.round ? diameter : width);
    r.size_y = planar() ? 1.0 : lateral * (r.round ? diameter : depth);
    r.height = along * height;
    r.base = 0.5 * (height - r.height);
    return r;
}

double Shape::Region::volume() const { return (round ? 0.25 * pi * size_x * size_x : size_x * size_y) * height; }

bool Shape::Region::contains(const Vec3& p) const {
    if (p.z() < base || p.z() > base + height) {
        return false;
    }
    if (round) {
        return p.x() * p.x() + p.y() * p.y() <= 0.25 * size_x * size_x;
    }
    return std::fabs(p.x()) <= 0.5 * size_x && std::fabs(p.y()) <= 0.5 * size_y;
}

double Shape::Region::fraction_inside(const Vec3& a, const Vec3& b) const {
    double from = 0.0;
    double to = 1.0;
    const Vec3 d = b - a;
    auto slab = [&](double start, double slope, double low, double high) {
        if (slope == 0.0) {
            if (start < low || start > high) {
                to = -1.0;
            }
            return;
        }
        const double t0 = (low - start) / slope;
        const double t1 = (high - start) / slope;
        from = std::max(from, std::min(t0, t1));
        to = std::min(to, std::max(t0, t1));
    };
    slab(a.z(), d.z(), base, base + height);
    if (round) {
        const double qa = d.x() * d.x() + d.y() * d.y();
        const double qb = a.x() * d.x() + a.y() * d.y();
        const double qc = a.x() * a.x() + a.y() * a.y() - 0.25 * size_x * size_x;
        if (qa == 0.0) {
            to = qc > 0.0 ? -1.0 : to;
        } else {
            const double root = qb * qb - qa * qc;
            if (root <= 0.0) {
                return 0.0;
            }
            from = std::max(from, (-qb - std::sqrt(root)) / qa);
            to = std::min(to, (-qb + std::sqrt(root)) / qa);
        }
    } else {
        slab(a.x(), d.x(), -0.5 * size_x, 0.5 * size_x);
        slab(a.y(), d.y(), -0.5 * size_y, 0.5 * size_y);
    }
    return std::max(0.0, to - from);
}

} // namespace proveta
