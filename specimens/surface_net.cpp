#include "specimens/surface_net.hpp"

#include <vtkCellArray.h>
#include <vtkDelaunay2D.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace proveta {

namespace {

constexpr double reach = 1.2; // radii: as for the skin of the specimen

struct Flat {
    double u, v;
};

// Delaunay triangulation of points in a plane, counterclockwise.
std::vector<SurfaceTriangle> triangulate(const std::vector<Flat>& points) {
    vtkNew<vtkPoints> all;
    all->SetDataTypeToDouble();
    for (const auto& p : points) {
        all->InsertNextPoint(p.u, p.v, 0.0);
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(all);
    vtkNew<vtkDelaunay2D> delaunay;
    delaunay->SetInputData(cloud);
    delaunay->SetTolerance(1e-9);
    delaunay->SetOffset(10.0); // a far bounding triangulation, so that no facet at the rim is missing
    delaunay->Update();
    std::vector<SurfaceTriangle> facets;
    vtkNew<vtkIdList> ids;
    auto* cells = delaunay->GetOutput()->GetPolys();
    for (cells->InitTraversal(); cells->GetNextCell(ids) != 0;) {
        SurfaceTriangle f{};
        for (std::size_t c = 0; c < 3; ++c) {
            f[c] = static_cast<std::uint32_t>(ids->GetId(static_cast<vtkIdType>(c)));
        }
        const auto& [a, b, c] = std::array{points[f[0]], points[f[1]], points[f[2]]};
        const double twice = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
        if (twice < 0.0) {
            std::swap(f[1], f[2]);
        }
        if (twice != 0.0) {
            facets.push_back(f);
        }
    }
    return facets;
}

bool held(const Bonds& bonds, std::size_t sphere) { return bonds.incidence.offset[sphere + 1] - bonds.incidence.offset[sphere] >= 4; }

double girth(const Shape& shape) {
    return shape.kind == ShapeKind::cylinder ? std::numbers::pi * shape.diameter : 2.0 * (shape.width + shape.depth);
}

// Way around the side, counterclockwise seen from above, from 0 to the girth, m.
double way_around(const Shape& shape, const Vec3& p) {
    if (shape.kind == ShapeKind::cylinder) {
        const double angle = std::atan2(p.y(), p.x());
        return 0.5 * shape.diameter * (angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle);
    }
    const double to_x = 0.5 * shape.width - std::fabs(p.x());
    const double to_y = 0.5 * shape.depth - std::fabs(p.y());
    if (to_x < to_y) {
        return p.x() > 0.0 ? 0.5 * shape.depth + p.y() : shape.depth + shape.width + 0.5 * shape.depth - p.y();
    }
    return p.y() > 0.0 ? shape.depth + 0.5 * shape.width - p.x() : 2.0 * shape.depth + shape.width + 0.5 * shape.width + p.x();
}

Vec3 side_normal(const Shape& shape, const Vec3& p) {
    if (shape.kind == ShapeKind::cylinder) {
        return Vec3(p.x(), p.y(), 0.0).normalized();
    }
    const bool along_x = 0.5 * shape.width - std::fabs(p.x()) < 0.5 * shape.depth - std::fabs(p.y());
    return along_x ? Vec3(std::copysign(1.0, p.x()), 0.0, 0.0) : Vec3(0.0, std::copysign(1.0, p.y()), 0.0);
}

} // namespace

SurfaceNet side_net(const Shape& shape, const Spheres& s, const Bonds& bonds) {
    SurfaceNet net;
    net.surface = girth(shape) * shape.height;
    std::vector<Flat> points;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Vec3 at = s.position.at(k);
        if (shape.depth_below_side(at) >= reach * s.radius[k] || !held(bonds, k)) {
            continue;
        }
        const bool upper = shape.height - at.z() < reach * s.radius[k];
        const bool lower = at.z() < reach * s.radius[k];
        const double level = upper ? shape.height : lower ? 0.0 : at.z();
        net.sphere.push_back(static_cast<std::int32_t>(k));
        net.raise.push_back(level - at.z());
        net.normal.push_back(side_normal(shape, at));
        points.push_back({way_around(shape, at), level});
    }
    // The side closes in itself: half of the points once more on either side, and of equal facets the one whose middle is on the first
    // round.
    const std::size_t n = points.size();
    const double round = girth(shape);
    for (std::size_t k = 0; k < n; ++k) {
        points.push_back({points[k].u + (points[k].u < 0.5 * round ? round : -round), points[k].v});
    }
    for (const auto& f : triangulate(points)) {
        const double middle = (points[f[0]].u + points[f[1]].u + points[f[2]].u) / 3.0;
        if (middle >= 0.0 && middle < round) {
            net.facets.push_back(
                {f[0] % static_cast<std::uint32_t>(n), f[1] % static_cast<std::uint32_t>(n), f[2] % static_cast<std::uint32_t>(n)});
        }
    }
    if (shape.planar() || net.facets.size() < 12) {
        throw std::invalid_argument("too few spheres at the side for a pressure on it");
    }
    return net;
}

SurfaceNet end_net(const Shape& shape, const Spheres& s, const Bonds& bonds, double outward) {
    SurfaceNet net;
    net.surface = shape.section();
    const double level = outward > 0.0 ? shape.height : 0.0;
    std::vector<Flat> points;
    for (std::size_t k = 0; k < s.size(); ++k) {
        const Vec3 at = s.position.at(k);
        if (std::fabs(level - at.z()) < reach * s.radius[k] && held(bonds, k)) {
            net.sphere.push_back(static_cast<std::int32_t>(k));
            net.raise.push_back(level - at.z());
            net.normal.push_back(outward * Vec3::UnitZ());
            points.push_back({at.x(), outward * at.y()}); // mirrored below, so that facets face outwards
        }
    }
    net.facets = triangulate(points);
    return net;
}

} // namespace proveta
