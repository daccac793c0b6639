#include "lab/surface_pressure.hpp"

#include <cmath>
#include <numbers>

namespace proveta {

namespace {

constexpr double reach = 1.2; // radii: as for the skin of the specimen

void add(Pressure& p, const Spheres& s, std::size_t k, const Vec3& normal) {
    p.sphere.push_back(static_cast<std::int32_t>(k));
    p.area.push_back(s.radius[k] * s.radius[k]);
    p.normal.push_back(normal);
}

void share_out(Pressure& p, double surface) {
    double sum = 0.0;
    for (const double a : p.area) {
        sum += a;
    }
    for (double& a : p.area) {
        a *= surface / sum;
    }
}

} // namespace

Pressure lateral_pressure(const Shape& shape, const Spheres& s) {
    Pressure p;
    p.radial = shape.kind == ShapeKind::cylinder;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Vec3 at = s.position.at(k);
        if (shape.depth_below_side(at) >= reach * s.radius[k]) {
            continue;
        }
        if (p.radial) {
            add(p, s, k, Vec3(at.x(), at.y(), 0.0).normalized());
        } else {
            const bool across_x = 0.5 * shape.width - std::fabs(at.x()) < 0.5 * shape.depth - std::fabs(at.y());
            add(p, s, k, across_x ? Vec3(std::copysign(1.0, at.x()), 0, 0) : Vec3(0, std::copysign(1.0, at.y()), 0));
        }
    }
    const double girth = p.radial ? std::numbers::pi * shape.diameter : 2.0 * (shape.width + shape.depth);
    share_out(p, girth * shape.height);
    return p;
}

Pressure end_pressure(const Shape& shape, const Spheres& s, double outward) {
    Pressure p;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const double below = outward > 0.0 ? shape.height - s.position.z[k] : s.position.z[k];
        if (below < reach * s.radius[k]) {
            add(p, s, k, Vec3(0, 0, outward));
        }
    }
    share_out(p, shape.section());
    return p;
}

} // namespace proveta
