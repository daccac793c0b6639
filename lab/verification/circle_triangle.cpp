// A circle and a triangle in one plane: the eight cases by closed forms, and anything else by integrating chords (thesis, appendix C).
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "lab/verification/cases.hpp"
#include "lab/verification/chord_integral.hpp"

namespace proveta::verification {

namespace circle_triangle_case {

using std::numbers::pi;

// What a line at distance h from the centre, |h| < r, cuts off a circle: area, m2, and first moment about the centre, m3.
double segment(double r, double h) { return r * r * std::acos(h / r) - h * std::sqrt(r * r - h * h); }
double segment_moment(double r, double h) { return 2.0 / 3.0 * std::pow(r * r - h * h, 1.5); }

// One row of table C.4 and its answer, all in the plane z = 0.
struct Row {
    char letter;
    const char* about;
    CircleAndTriangle setting;
    double area; // m2
    Vec3 centroid;
};

// A tilted plane away from the origin, so that no coordinate is special.
Vec3 tilted(const Vec3& p) {
    static const Mat3 turn = (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::AngleAxisd(-1.1, Vec3::UnitY())).matrix();
    return turn * p + Vec3(0.3, -0.2, 0.5);
}

CircleAndTriangle tilted(const CircleAndTriangle& s) {
    return {tilted(s.centre), s.radius, {tilted(s.corner[0]), tilted(s.corner[1]), tilted(s.corner[2])}};
}

// Equilateral with side 1, symmetric about x = 0; base: the y of its base.
std::array<Vec3, 3> equilateral(double base) {
    return {Vec3(-0.5, base, 0.0), Vec3(0.5, base, 0.0), Vec3(0.0, base + 0.5 * std::sqrt(3.0), 0.0)};
}

// A right angle in the origin between two legs of length 1.
const std::array<Vec3, 3> right{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

Row one_segment_less() {
    const double r = 0.2, h = 0.1;
    const double area = pi * r * r - segment(r, h);
    return {'b', "circle less a segment", {{0.35, h, 0.0}, r, right}, area, {0.35, h + segment_moment(r, h) / area, 0.0}};
}

Row two_segments_less() {
    const double r = 0.24, h = 0.2; // the corner is h sqrt(2) away
    const double area = pi * r * r - 2.0 * segment(r, h);
    const double at = h + segment_moment(r, h) / area;
    return {'c', "circle less two segments", {{h, h, 0.0}, r, right}, area, {at, at, 0.0}};
}

// A circle about the right angle, a quarter of which the hypotenuse may cut.
Row quarter() {
    const double r = 0.5, at = 4.0 * r / (3.0 * pi);
    return {'e', "spike", {{0.0, 0.0, 0.0}, r, right}, 0.25 * pi * r * r, {at, at, 0.0}};
}

Row two_spikes_less() {
    const double r = 0.8, h = std::sqrt(0.5);
    const double area = 0.25 * pi * r * r - segment(r, h);
    const double at = (r * r * r / 3.0 - std::sqrt(0.5) * segment_moment(r, h)) / area;
    return {'f', "triangle less two spikes", {{0.0, 0.0, 0.0}, r, right}, area, {at, at, 0.0}};
}

// About the middle of the base: two triangles below and a sector between the points p and its mirror image on the sides.
Row one_spike_less() {
    const double r = 0.6;
    const double way = 0.25 + std::sqrt(r * r - 3.0 / 16.0); // from the base along a side to p
    const double px = 0.5 - 0.5 * way, py = 0.5 * std::sqrt(3.0) * way;
    const double area = 0.5 * py + r * r * std::atan2(px, py);
    const double moment = 0.5 * py * py / 3.0 + 2.0 / 3.0 * r * r * px;
    return {'g', "triangle less a spike", {{0.0, 0.0, 0.0}, r, equilateral(0.0)}, area, {0.0, moment / area, 0.0}};
}

std::vector<Row> rows_of_table() {
    const Vec3 o(0.0, 0.0, 0.0);
    const double inscribed = std::sqrt(3.0) / 6.0;
    const auto middle = equilateral(-inscribed);
    return {{'a', "full circle", {o, 0.2, middle}, pi * 0.04, o},
            one_segment_less(),
            two_segments_less(),
            {'d', "circle less three segments", {o, 0.4, middle}, pi * 0.16 - 3.0 * segment(0.4, inscribed), o},
            quarter(),
            two_spikes_less(),
            one_spike_less(),
            {'h', "full triangle", {o, 0.6, middle}, 0.25 * std::sqrt(3.0), o}};
}

// Radii from 1/30 of the triangle to 30 times its size, as contacts have them; the tests go further.
CircleAndTriangle random_setting(std::mt19937_64& generator) {
    std::uniform_real_distribution<double> at(-1.0, 1.0), exponent(-1.5, 1.5);
    const auto point = [&] {
        const double x = at(generator);
        return Vec3(x, at(generator), 0.0);
    };
    const double radius = std::pow(10.0, exponent(generator));
    const Vec3 on_edge = point();
    const double angle = pi * at(generator), off = std::fabs(radius + at(generator)); // so that large circles pass the triangle as well
    const Vec3 centre = on_edge + off * Vec3(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 a = point(), b = point(), c = point();
    return tilted({centre, radius, {a, b, c}});
}

void add_random(Outcome& out) {
    std::mt19937_64 generator(41);
    std::set<char> found;
    double area = 0.0, centroid = 0.0;
    for (int k = 0; k < 10000; ++k) {
        const CircleAndTriangle s = random_setting(generator);
        const Piece piece = s.piece(), known = chord_integral(s);
        const Vec3 e = s.corner[1] - s.corner[0], f = s.corner[2] - s.corner[0];
        const double least = std::min(pi * s.radius * s.radius, 0.5 * e.cross(f).norm());
        const double size = std::min(s.radius, std::max(e.norm(), f.norm()));
        found.insert(case_of_table(s));
        area = std::max(area, std::fabs(piece.area - known.area) / least);
        if (known.area > 1e-4 * least) {
            centroid = std::max(centroid, (piece.centroid - known.centroid).norm() / size);
        }
    }
    found.erase('-');
    out.checks.push_back(
        {"cases among 10000 random circles and triangles", 8.0, static_cast<double>(found.size()), 0.0, Compare::absolute});
    out.checks.push_back({"largest error of the area over the smaller of both", 0.0, area, 1e-10, Compare::absolute});
    out.checks.push_back({"largest error of the centroid over the size", 0.0, centroid, 1e-10, Compare::absolute});
}

// Triangles around a point that tile a square: together they have the whole circle.
void add_tiles(Outcome& out) {
    const CircleAndTriangle around{{0.5, 0.5, 0.0}, 0.45, {}};
    const std::array corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        sum += tilted({around.centre, around.radius, {Vec3(0.61, 0.27, 0.0), corner[k], corner[(k + 1) % 4]}}).piece().area;
    }
    out.checks.push_back({"four triangles that tile a square around a circle", pi * 0.45 * 0.45, sum, 1e-14, Compare::relative, "m2"});
}

Outcome compute() {
    Outcome out;
    double same = 0.0;
    for (const Row& row : rows_of_table()) {
        const CircleAndTriangle s = tilted(row.setting);
        const Piece piece = s.piece();
        const std::string name = std::string("case ") + row.letter + ", " + row.about;
        out.checks.push_back({name + ": area", row.area, piece.area, 1e-13, Compare::relative, "m2"});
        const double off = (piece.centroid - tilted(row.centroid)).norm();
        out.checks.push_back({name + ": centroid from its place", 0.0, off, 1e-14, Compare::absolute, "m"});
        same += case_of_table(s) == row.letter ? 1.0 : 0.0;
    }
    out.checks.push_back({"rows of table C.4 met", 8.0, same, 0.0, Compare::absolute});
    add_random(out);
    add_tiles(out);
    out.notes.emplace_back(
        "The centroid is judged where the piece is more than 1e-4 of the smaller of circle and triangle: the coordinates' "
        "rounding over its own size decides the rest.");
    return out;
}

} // namespace circle_triangle_case

Case circle_triangle() {
    using namespace circle_triangle_case;
    return {"circle-triangle", "C", "Area and centroid of what a circle and a triangle in one plane have in common.", false, compute};
}

} // namespace proveta::verification
