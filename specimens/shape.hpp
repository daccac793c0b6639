// The solid that a specimen fills: a cylinder or a prism standing on the plane z = 0, or a plate of discs.
#pragma once

#include <string>

#include "core/geometry/vector_field.hpp"

namespace proveta {

enum class ShapeKind { cylinder, prism, plate };

/// A right cylinder or rectangular prism with axis z, centred on it, from z = 0 to z = height; or a plate in the plane y = 0, width along
/// x, 1 m thick (its section is width x 1 m). Lengths in m.
struct Shape {
    ShapeKind kind = ShapeKind::cylinder;
    double diameter = 0.15; ///< of a cylinder
    double width = 0.15;    ///< of a prism or plate, along x
    double depth = 0.15;    ///< of a prism, along y
    double height = 0.30;

    [[nodiscard]] double section() const;      ///< area across z, m2
    [[nodiscard]] double volume() const;       ///< m3
    [[nodiscard]] double lateral_size() const; ///< diameter, the smaller side, or the width
    [[nodiscard]] std::string name() const;
    [[nodiscard]] std::string text() const; ///< name and size in mm
    [[nodiscard]] bool planar() const { return kind == ShapeKind::plate; }

    /// Distance from p to the lateral surface, positive inside, m.
    [[nodiscard]] double depth_below_side(const Vec3& p) const;
    /// Distance from p to the nearer end, positive inside, m.
    [[nodiscard]] double depth_below_end(const Vec3& p) const;
    /// Distance from p to the surface, positive inside, m.
    [[nodiscard]] double depth_below_surface(const Vec3& p) const;

    /// The point nearest to p that keeps a sphere of radius r inside. r must fit into the shape.
    [[nodiscard]] Vec3 keep_inside(Vec3 p, double r) const;

    /// The same shape, scaled by `lateral` across and by `along` along z, about the centre of the original; used for inner regions.
    /// Returned as a shape and the height of its base.
    struct Region;
    [[nodiscard]] Region inner(double lateral, double along) const;
};

/// A shape lifted to z = base.
struct Shape::Region {
    double base = 0.0;   ///< m
    double height = 0.0; ///< m
    double size_x = 0.0, size_y = 0.0;
    bool round = true;

    [[nodiscard]] double volume() const;
    [[nodiscard]] bool contains(const Vec3& p) const;
    /// Part of the segment from a to b that lies inside, 0 to 1.
    [[nodiscard]] double fraction_inside(const Vec3& a, const Vec3& b) const;
};

} // namespace proveta
