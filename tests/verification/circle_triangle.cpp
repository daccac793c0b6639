// Pieces of circles and triangles: random ones in random planes against the integral of chords, closed forms in degenerate positions, and
// what holds without knowing the answer.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "lab/verification/chord_integral.hpp"

using namespace proveta;
using namespace proveta::verification;

namespace {

// Random numbers and planes.
struct Draw {
    std::mt19937_64 generator;

    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
    double power(double low, double high) { return std::pow(10.0, (*this)(low, high)); }
    Vec3 flat() {
        const double x = (*this)(-1.0, 1.0);
        return {x, (*this)(-1.0, 1.0), 0.0};
    }
    Vec3 away(double distance) {
        const double angle = (*this)(-std::numbers::pi, std::numbers::pi);
        return {distance * std::cos(angle), distance * std::sin(angle), 0.0};
    }
    Eigen::Isometry3d plane() {
        Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
        const Vec3 axis = (flat() + (*this)(-1.0, 1.0) * Vec3::UnitZ()).normalized();
        t.rotate(Eigen::AngleAxisd((*this)(-std::numbers::pi, std::numbers::pi), axis));
        t.pretranslate(flat());
        return t;
    }
};

CircleAndTriangle moved(const Eigen::Isometry3d& t, const CircleAndTriangle& s) {
    return {t * s.centre, s.radius, {t * s.corner[0], t * s.corner[1], t * s.corner[2]}};
}

double triangle_area(const CircleAndTriangle& s) { return 0.5 * (s.corner[1] - s.corner[0]).cross(s.corner[2] - s.corner[0]).norm(); }
double longest(const CircleAndTriangle& s) {
    return std::max({(s.corner[1] - s.corner[0]).norm(), (s.corner[2] - s.corner[1]).norm(), (s.corner[0] - s.corner[2]).norm()});
}
double smaller(const CircleAndTriangle& s) { return std::min(triangle_area(s), std::numbers::pi * s.radius * s.radius); }

// How far a point lies outside the circle or the triangle, m; not positive within both.
double distance_outside(const CircleAndTriangle& s, const Vec3& p) {
    double most = (p - s.centre).norm() - s.radius;
    const Vec3 normal = (s.corner[1] - s.corner[0]).cross(s.corner[2] - s.corner[0]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = (s.corner[(k + 1) % 3] - s.corner[k]).normalized();
        most = std::max(most, (p - s.corner[k]).dot(edge.cross(normal)));
    }
    return most;
}

// The largest errors met, and how often each row of the thesis's table came up.
struct Errors {
    double area = 0.0;     // over the smaller of circle and triangle
    double centroid = 0.0; // over the smaller size; of a piece below 1e-4 of the smaller area in proportion to its area
    double outside = 0.0;  // of the centroid, over the smaller size
    double least = 0.0;    // area, m2
    std::map<char, int> count;

    void add(const CircleAndTriangle& s) {
        const Piece found = s.piece(), known = chord_integral(s);
        const double size = std::min(longest(s), s.radius);
        const double part = known.area / smaller(s);
        ++count[case_of_table(s)];
        least = std::min(least, found.area);
        area = std::max(area, std::fabs(found.area - known.area) / smaller(s));
        if (found.area > 0.0) {
            outside = std::max(outside, distance_outside(s, found.centroid) / size);
            centroid = std::max(centroid, std::min(1.0, 1e4 * part) * (found.centroid - known.centroid).norm() / size);
        }
    }

    void check() const {
        CHECK(least >= 0.0);
        CHECK(area <= 1e-10);
        CHECK(centroid <= 1e-10);
        CHECK(outside <= 1e-10);
    }
};

CircleAndTriangle of_a_size(Draw& draw) {
    const Vec3 a = draw.flat(), b = draw.flat(), c = draw.flat(), centre = 1.2 * draw.flat();
    return {centre, draw.power(-1.5, 0.5), {a, b, c}};
}

// No less than 0.01 high: the coordinates' rounding is that of the large radius, and a share of the smallest width.
CircleAndTriangle stout(Draw& draw) {
    CircleAndTriangle s = of_a_size(draw);
    while (2.0 * triangle_area(s) < 0.01 * longest(s)) {
        s = of_a_size(draw);
    }
    return s;
}

} // namespace

TEST_CASE("circle and triangle: random ones in random planes, all eight cases") {
    Draw draw{std::mt19937_64(1)};
    Errors errors;
    for (int k = 0; k < 40000; ++k) {
        errors.add(moved(draw.plane(), of_a_size(draw)));
    }
    errors.check();
    for (const char row : {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h', '-'}) {
        INFO(row);
        CHECK(errors.count[row] >= 10);
    }
}

TEST_CASE("circle and triangle: circles of a 1e-4th of the triangle on its edges and corners") {
    Draw draw{std::mt19937_64(2)};
    Errors errors;
    for (int k = 0; k < 20000; ++k) {
        CircleAndTriangle s = stout(draw);
        s.radius = draw.power(-4.0, 0.0);
        const double along = k % 2 == 0 ? 0.0 : draw(0.0, 1.0);
        s.centre = s.corner[0] + along * (s.corner[1] - s.corner[0]) + 1.5 * s.radius * draw.flat();
        errors.add(moved(draw.plane(), s));
    }
    errors.check();
}

TEST_CASE("circle and triangle: circles of up to 1e4 times the triangle that pass it") {
    Draw draw{std::mt19937_64(3)};
    Errors errors;
    for (int k = 0; k < 20000; ++k) {
        CircleAndTriangle s = stout(draw);
        s.radius = draw.power(0.0, 4.0);
        s.centre = draw.away(s.radius + draw(-1.0, 1.0));
        errors.add(moved(draw.plane(), s));
    }
    errors.check();
}

TEST_CASE("circle and triangle: slivers down to a 1e-5th of their length") {
    Draw draw{std::mt19937_64(4)};
    Errors errors;
    for (int k = 0; k < 20000; ++k) {
        CircleAndTriangle s = stout(draw);
        const double width = draw.power(-3.0, 0.0); // of what is 0.01 high at least
        for (Vec3* p : {&s.corner[0], &s.corner[1], &s.corner[2], &s.centre}) {
            p->y() *= width;
        }
        errors.add(moved(draw.plane(), s));
    }
    errors.check();
}

TEST_CASE("circle and triangle: corners and edges on the circle, the centre on corners and edges, and hardly off them") {
    Draw draw{std::mt19937_64(5)};
    Errors errors;
    for (int k = 0; k < 40000; ++k) {
        CircleAndTriangle s = stout(draw);
        if (k % 4 == 0) {
            s.centre = s.corner[0];
        } else if (k % 4 == 1) {
            s.centre = s.corner[0] + draw(0.0, 1.0) * (s.corner[1] - s.corner[0]);
        } else if (k % 4 == 2) { // as far from two corners
            const Vec3 edge = s.corner[2] - s.corner[1];
            s.centre = 0.5 * (s.corner[1] + s.corner[2]) + draw(-1.0, 1.0) * Vec3(-edge.y(), edge.x(), 0.0);
        }
        const Vec3 edge = (s.corner[2] - s.corner[1]).normalized();
        const bool touches = k % 8 < 4;
        s.radius = touches ? edge.cross(s.centre - s.corner[1]).norm() : (s.centre - s.corner[1]).norm();
        s.radius *= 1.0 + (k % 3 - 1) * draw.power(-17.0, -6.0);
        if (s.radius > 1e-4) {
            errors.add(k % 5 == 0 ? s : moved(draw.plane(), s));
        }
    }
    errors.check();
}

TEST_CASE("circle and triangle: exact positions") {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    const double inscribed = 1.0 - std::sqrt(0.5);
    const auto area = [&](const Vec3& centre, double radius) { return circle_triangle(centre, radius, a, b, c).area; };
    CHECK(area({inscribed, inscribed, 0.0}, inscribed) == Approx(std::numbers::pi * inscribed * inscribed).epsilon(1e-14));
    CHECK(area({0.5, 0.5, 0.0}, std::sqrt(0.5)) == Approx(0.5).epsilon(1e-14)); // all corners on the circle
    CHECK(area(a, 0.3) == Approx(0.25 * std::numbers::pi * 0.09).epsilon(1e-14));
    CHECK(area(b, 0.3) == Approx(0.125 * std::numbers::pi * 0.09).epsilon(1e-14));
    CHECK(area({0.5, 0.0, 0.0}, 0.1) == Approx(0.5 * std::numbers::pi * 0.01).epsilon(1e-14));
    CHECK(area({0.5, 0.5, 0.0}, 0.1) == Approx(0.5 * std::numbers::pi * 0.01).epsilon(1e-14));
    CHECK(area(a, 1.0) == Approx(0.5).epsilon(1e-14));                               // the legs' ends on the circle
    CHECK(area(a, std::sqrt(0.5)) == Approx(std::numbers::pi / 8.0).epsilon(1e-14)); // the hypotenuse touches it
    // From outside: a corner, an edge and nothing at all.
    CHECK(area({-1.0, 0.0, 0.0}, 1.0) == 0.0);
    CHECK(area({0.5, -0.25, 0.0}, 0.25) == 0.0);
    CHECK(area({100.0, 70.0, 0.0}, 1.0) == 0.0);
    // Without extent.
    CHECK(area({0.2, 0.2, 0.0}, 0.0) == 0.0);
    CHECK(circle_triangle({0.2, 0.0, 0.0}, 0.1, a, b, 0.5 * b).area == 0.0);
    CHECK(circle_triangle(a, 0.1, a, a, b).area == 0.0);
    CHECK(circle_triangle(b, 0.1, a, a, a).area == 0.0);
    CHECK(circle_triangle(a, 0.1, a, a, a).area == 0.0);
}

TEST_CASE("circle and triangle: tiles of a quadrilateral add up, whichever they are") {
    Draw draw{std::mt19937_64(6)};
    double area = 0.0, moment = 0.0;
    for (int k = 0; k < 20000; ++k) {
        const Eigen::Isometry3d t = draw.plane();
        // A quarter of the unit square has one corner each: convex with the origin well inside.
        const std::array corner{Vec3(draw(0.3, 1), draw(0.3, 1), 0), Vec3(draw(-1, -0.3), draw(0.3, 1), 0),
                                Vec3(draw(-1, -0.3), draw(-1, -0.3), 0), Vec3(draw(0.3, 1), draw(-1, -0.3), 0)};
        const Vec3 centre = t * Vec3(1.5 * draw.flat());
        const double radius = draw.power(-1.5, 0.5);
        std::array<double, 2> sum{};
        std::array<Vec3, 2> first{Vec3(0, 0, 0), Vec3(0, 0, 0)};
        for (std::size_t way = 0; way < 2; ++way) {
            const Vec3 meet = t * Vec3(way == 0 ? Vec3(0, 0, 0) : Vec3(0.1 * draw.flat()));
            for (std::size_t e = 0; e < 4; ++e) {
                const Piece piece = circle_triangle(centre, radius, meet, t * corner[e], t * corner[(e + 1) % 4]);
                sum[way] += piece.area;
                first[way] += piece.area > 0.0 ? Vec3(piece.area * (piece.centroid - centre)) : Vec3(0, 0, 0);
            }
        }
        area = std::max(area, std::fabs(sum[0] - sum[1]) / std::min(radius * radius, 1.0));
        moment = std::max(moment, (first[0] - first[1]).norm() / std::min(radius * radius, 1.0));
    }
    CHECK(area <= 1e-13); // a thousand roundings of coordinates of size 1 over the least radius
    CHECK(moment <= 1e-13);
}

TEST_CASE("circle and triangle: turned, shifted, scaled, and with the corners in any order") {
    Draw draw{std::mt19937_64(7)};
    double worst = 0.0;
    const auto compare = [&](const CircleAndTriangle& s, const Piece& known, const Piece& found) {
        worst = std::max(worst, std::fabs(found.area - known.area) / smaller(s));
        if (known.area > 1e-4 * smaller(s)) {
            worst = std::max(worst, (found.centroid - known.centroid).norm() / std::min(longest(s), s.radius));
        }
    };
    for (int k = 0; k < 20000; ++k) {
        const CircleAndTriangle s = stout(draw);
        const auto& [a, b, c] = s.corner;
        const Piece known = s.piece();
        compare(s, known, circle_triangle(s.centre, s.radius, b, c, a));
        compare(s, known, circle_triangle(s.centre, s.radius, c, b, a));
        const Eigen::Isometry3d t = draw.plane();
        const Piece there = moved(t, s).piece();
        compare(s, known, {there.area, t.inverse() * there.centroid});
        const Piece large = circle_triangle(1024.0 * s.centre, 1024.0 * s.radius, 1024.0 * a, 1024.0 * b, 1024.0 * c);
        CHECK(large.area == 1048576.0 * known.area); // powers of two change no digit
    }
    CHECK(worst <= 1e-10);
}
