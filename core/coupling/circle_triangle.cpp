#include "core/coupling/circle_triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace proveta {

// The piece is convex. Its boundary follows the edges where they lie within the circle and the circle between them, so that it is the
// polygon through the ends of these stretches and one circular segment beyond every side of the polygon that is a chord. The sum has
// positive terms only: nothing cancels if circle and triangle differ much in size, as it would in a sum of sectors seen from the centre.

namespace {

using Vec2 = Eigen::Vector2d;

constexpr double tiny = 1e-300; // m, instead of a length that is zero

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// The triangle in its plane, counter-clockwise, with its first corner in the origin and its longest edge on the x axis: across a sliver
// coordinates are small numbers then, not differences of large ones.
struct Flat {
    Vec3 origin, x, y;
    std::array<Vec2, 3> corner;
    Vec2 centre; // of the circle
};

// From the first corner, the edges away from it and the centre as seen from it. A triangle without area gets no third corner off the x
// axis.
Flat flatten(const Vec3& origin, const Vec3& to_second, const Vec3& to_third, const Vec3& to_centre) {
    const double length = to_second.norm();
    const Vec3 x = to_second / std::max(length, tiny);
    Vec3 y = to_third - to_third.dot(x) * x;
    y -= y.dot(x) * x; // once more for slivers, whose first difference is mostly rounding
    y /= std::max(y.norm(), tiny);
    return {
        origin, x, y, {Vec2(0.0, 0.0), Vec2(length, 0.0), Vec2(to_third.dot(x), to_third.dot(y))}, {to_centre.dot(x), to_centre.dot(y)}};
}

// The part of an edge within the circle, in the direction of the edge.
struct Stretch {
    Vec2 from, to;
    double depth;     // of the centre within the triangle as seen from this edge, m; negative outside
    std::size_t edge; // 0 to 2
};

// False if the edge has nothing within the circle. Whether its ends do is decided once for both edges that meet there.
bool within(Stretch& s, const Vec2& from, const Vec2& to, const Vec2& centre, double radius, bool from_inside, bool to_inside) {
    const Vec2 edge = to - from;
    const double length = edge.norm();
    const Vec2 along = edge / length;
    const Vec2 to_centre = centre - from;
    s.from = from;
    s.to = to;
    s.depth = cross(along, to_centre);
    if (from_inside && to_inside) {
        return true;
    }
    const double foot = to_centre.dot(along);
    const double square = (radius - s.depth) * (radius + s.depth);
    if (!from_inside && !to_inside && (square <= 0.0 || foot <= 0.0 || foot >= length)) {
        return false;
    }
    const double half = std::sqrt(std::max(0.0, square));
    if (!from_inside) {
        s.from += std::clamp(foot - half, 0.0, length) * along;
    }
    if (!to_inside) {
        s.to = from + std::clamp(foot + half, 0.0, length) * along;
    }
    return true;
}

// t - sin(t), t >= 0, to rounding.
double less_sine(double t, double sine) {
    if (t > 0.5) {
        return t - sine;
    }
    const double s = t * t;
    return t * s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0 * (1.0 - s / 210.0))))));
}

struct Sum {
    double area = 0.0;
    Vec2 moment{0.0, 0.0}; // first, about a point of the piece

    // The triangle of that point and two more, seen from it.
    void add_triangle(const Vec2& p, const Vec2& q) {
        const double a = 0.5 * std::max(0.0, cross(p, q));
        area += a;
        moment += a / 3.0 * (p + q);
    }

    // What lies between a chord and the arc that goes counter-clockwise from its one end p to the other; all seen from the circle's centre.
    // apothem: of the centre on the left of the chord, m, negative on its right, where the arc is more than half the circle.
    void add_segment(const Vec2& p, const Vec2& q, double chord, double apothem, double radius, const Vec2& about) {
        const double half = 0.5 * chord;
        const double square = radius * radius;
        const double a = 0.5 * square * less_sine(2.0 * std::atan2(half, apothem), chord * apothem / square);
        if (a <= 0.0) {
            return;
        }
        area += a;
        moment -= a * about;
        // The centroid lies chord^3 / (12 a) from the centre along the normal of the chord. A short chord's direction is mostly rounding:
        // it must not turn the way from the centre, so that flat segments are put on the middle of their chord.
        const Vec2 normal(q.y() - p.y(), p.x() - q.x()); // as long as the chord
        if (apothem <= 0.0) {
            moment += chord * chord / 12.0 * normal;
        } else {
            const double height = half * half / (radius + apothem);
            const double above = std::clamp(chord * chord * chord / (12.0 * a) - apothem, 0.0, height);
            moment += a * (0.5 * (p + q) + above / chord * normal);
        }
    }
};

// Adds what the circle bounds between the end of a stretch and the start of the next one.
void add_arc(Sum& sum, const Stretch& here, const Stretch& next, const Vec2& centre, double radius, const Vec2& about) {
    const Vec2 p = here.to - centre;
    const Vec2 way = next.from - here.to;
    const double chord = way.norm();
    // A short chord can stand for next to nothing or for nearly all of the circle, and rounding must not decide which. The arc around one
    // corner outside the circle is never more than half of it; any other of more than 300 degrees leaves the centre deep within both
    // edges, and one of less than 60 degrees never does.
    const bool around_corner = next.edge == (here.edge + 1) % 3;
    const bool most = !around_corner && std::min(here.depth, next.depth) > 0.5 * radius;
    double apothem = 0.0;
    if (chord < radius) {
        apothem = std::sqrt((radius - 0.5 * chord) * (radius + 0.5 * chord)) * (most ? -1.0 : 1.0);
    } else {
        apothem = cross(p, way) / chord;
    }
    sum.add_segment(p, next.from - centre, chord, apothem, radius, about);
}

// Neither is all of the triangle within the circle nor is it without area. `inside`: which corners are in the circle.
Piece cut(const Flat& flat, const std::array<bool, 3>& inside, const Vec3& centre, double radius) {
    std::array<Stretch, 3> stretch;
    std::size_t count = 0;
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        Stretch& s = stretch[count];
        s.edge = k;
        count += within(s, flat.corner[k], flat.corner[next], flat.centre, radius, inside[k], inside[next]) ? 1U : 0U;
        depth = std::min(depth, s.depth);
    }
    if (count == 0) {
        return depth > 0.0 ? Piece{std::numbers::pi * radius * radius, centre} : Piece{};
    }
    const Vec2 about = stretch[0].from;
    Sum sum;
    for (std::size_t k = 0; k < count; ++k) {
        const Stretch& next = stretch[(k + 1) % count];
        sum.add_triangle(stretch[k].from - about, stretch[k].to - about);
        sum.add_triangle(stretch[k].to - about, next.from - about);
        if (!inside[(stretch[k].edge + 1) % 3]) {
            add_arc(sum, stretch[k], next, flat.centre, radius, about - flat.centre);
        }
    }
    if (sum.area <= 0.0) {
        return {};
    }
    const Vec2 at = about + sum.moment / sum.area;
    return {sum.area, flat.origin + at.x() * flat.x + at.y() * flat.y};
}

} // namespace

Piece circle_triangle(const Vec3& centre, double radius, const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<const Vec3*, 3> corner{&a, &b, &c};
    const std::array<Vec3, 3> seen{a - centre, b - centre, c - centre};
    const double square = radius * radius;
    const std::array<bool, 3> inside{seen[0].squaredNorm() <= square, seen[1].squaredNorm() <= square, seen[2].squaredNorm() <= square};
    const std::array<Vec3, 3> edge{b - a, c - b, a - c};
    const Vec3 sum = seen[0] + seen[1] + seen[2];
    if (inside[0] && inside[1] && inside[2]) {
        return {0.5 * edge[0].cross(edge[2]).norm(), (a + b + c) / 3.0};
    }
    // All of the triangle beyond the tangent to the circle on the side of the triangle's centroid.
    const double nearest = std::min({seen[0].dot(sum), seen[1].dot(sum), seen[2].dot(sum)});
    if (radius <= 0.0 || (nearest > 0.0 && nearest * nearest >= square * sum.squaredNorm())) {
        return {};
    }
    const std::array<double, 3> length{edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm()};
    const auto i = static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Flat flat = flatten(*corner[i], edge[i], -edge[k], -seen[i]);
    return flat.corner[2].y() > 0.0 ? cut(flat, {inside[i], inside[j], inside[k]}, centre, radius) : Piece{};
}

} // namespace proveta
