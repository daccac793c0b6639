// A rigid surface that meets spheres: a loading platen, a curved jaw, a ring around the specimen, or a wall that loose spheres meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/boundaries/wall_contact.hpp"
#include "core/contacts/loads.hpp"
#include "core/laws/material.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// The form of a surface that moves along `axis`. Flat, its plane stands across the axis at a position along it; hollow, it is the inside
/// of a cylinder about a line along z, whose nearest point to what it presses on the way along the axis is at that position. A ring about
/// the specimen is hollow with its position at minus its radius: its line is then the z axis.
struct Face {
    static constexpr double boundless = std::numeric_limits<double>::infinity();

    Vec3 axis = Vec3::UnitZ();     ///< unit vector; of a hollow face across z
    double inward = 1.0;           ///< the specimen lies on this side of the position, +1 or -1
    double curvature = 0.0;        ///< of a hollow face: 1 / radius, 1/m; 0: flat
    double half_width = boundless; ///< reach on both sides of the axis, along z x axis, m
    double edge = 0.0; ///< of a sphere's radius: how far inside the reach its centre lies when it is under the face, see `reaches`

    /// Where a point is seen from the face.
    struct Foot {
        double distance; ///< from the face, positive on the specimen's side, m
        Vec3 normal;     ///< unit vector from the face to the specimen
        double aside;    ///< from the middle of the face's width, m; of a bounded hollow face's other side, infinity
    };
    [[nodiscard]] Foot foot(double position, const Vec3& point) const {
        const auto beside = [&](const Vec3& p) { return half_width == boundless ? 0.0 : std::fabs(Vec3::UnitZ().cross(axis).dot(p)); };
        if (curvature == 0.0) {
            return {(point.dot(axis) - position) * inward, inward * axis, beside(point)};
        }
        const Vec3 line = (position + inward / curvature) * axis;
        const Vec3 out(point.x() - line.x(), point.y() - line.y(), 0.0);
        const double r = out.norm();
        const bool behind = half_width != boundless && out.dot(axis) * inward > 0.0;
        return {1.0 / curvature - r, r > 0.0 ? Vec3(-out / r) : Vec3(inward * axis), behind ? boundless : beside(out)};
    }
    /// Whether a sphere of radius r lies under the face. A sphere hands its load on over its own breadth, so that a strip presses on more
    /// than its width where spheres are large, unless those at its edges are left out. At most half of the width is given up.
    [[nodiscard]] bool reaches(const Foot& foot, double r) const { return foot.aside <= half_width - std::min(edge * r, 0.5 * half_width); }
};

/// The inside of a ring of the given radius about the z axis, and the position that goes with it.
inline Face ring_face(double radius) { return {Vec3::UnitX(), 1.0, 1.0 / radius, Face::boundless}; }

/// A rigid surface. Without a wall material it caps a piece of the specimen's surface: spheres meet it by LS+D without dashpot: stiffness
/// E A / R over the half sphere between surface and centre, the areas of the first contacts sharing out the capped piece, so that the
/// platen adds no compliance of its own. Spheres that lie within `capping` of the surface at the start touch it then, without force, as
/// under a ground or capped end. With a wall material spheres meet it by their loose law with the equivalents of a wall (2.41), rolling
/// resistance included.
struct Platen {
    Face face;
    double position = 0.0;                ///< along the face's axis, m
    double velocity = 0.0;                ///< of the last move, m/s
    double friction = 0.0;                ///< mu; infinity: glued sideways
    bool bonded = false;                  ///< holds the capped spheres in tension too; with infinite friction they are glued on
    std::vector<std::int32_t> sphere;     ///< listed spheres, ascending
    std::optional<Material> wall;         ///< material of a wall
    std::vector<double> contact_distance; ///< m
    std::vector<LooseContact> law;        ///< constants of each contact
    VectorField slip;                     ///< elastic tangential displacement, m
    VectorField viscous;                  ///< force of the dashpots on the sphere at the last step, N
    VectorField force;                    ///< on each listed sphere at the last step, N
    std::vector<double> capped;           ///< per sphere of the specimen: contact distance from the start, m; 0: none
    double area_weight = 1.0;             ///< contact area over the sphere's section
    Vec3 reaction = Vec3::Zero();         ///< force of the specimen on the platen, N
    double thrust = 0.0;                  ///< sum of the normal forces on it, N
    int touching = 0;

    [[nodiscard]] Face::Foot foot(const Vec3& point) const { return face.foot(position, point); }
    /// Force of the specimen against the platen's way inward, N: positive in compression.
    [[nodiscard]] double load() const { return -face.inward * face.axis.dot(reaction); }

    /// Moves the surface by velocity dt.
    void move(double speed, double dt) {
        velocity = speed;
        position += speed * dt;
    }
};

constexpr double glued = std::numeric_limits<double>::infinity();

/// A platen that caps a piece of the specimen's surface. area: of that piece, m2, 0 for contacts as large as the spheres' sections;
/// capping: reach of the first contacts beyond the surface over the sphere's radius.
Platen make_platen(const Spheres& spheres, const Face& face, double position, double friction, double area, double capping);

/// A wall with a material; its friction is that of the spheres' surface against this one.
Platen make_wall(const Spheres& spheres, const Face& face, double position, const Material& material, double friction);

/// Lists anew the spheres within `skin` metres of touching, keeping tangential histories.
void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& platen);

/// Fills in what follows from the listed spheres: contact distances and laws.
void set_up_platen(const Spheres& spheres, const std::vector<Material>& materials, Platen& platen);

/// Advances the platen's contacts with one block of spheres and adds their forces to the loads.
WallSums platen_forces(const Spheres& spheres, Platen& platen, const SphereBlock& block, const ContactStep& step, Loads& loads);

} // namespace proveta
