// The tangential force of a sphere led over elements, convex and concave corners (thesis 3.5.2).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace tangential_continuity_case {

constexpr double lift = 0.1, speed = 0.5, dt = 5e-5; // of the centre over the surface, m; m/s; s
constexpr int search_every = 100;

double degrees(double angle) { return angle * std::numbers::pi / 180.0; }

// The surface's profile in x and z: level, down by 30 degrees, level, down by 40.
std::vector<Vec3> profile() {
    std::vector<Vec3> p{{-1, 0, 0}, {0.3, 0, 0}};
    p.push_back(p.back() + 0.5 * Vec3(std::cos(degrees(30)), 0, -std::sin(degrees(30))));
    p.push_back(p.back() + Vec3(0.7, 0, 0));
    p.push_back(p.back() + 0.8 * Vec3(std::cos(degrees(40)), 0, -std::sin(degrees(40))));
    return p;
}

// Triangles of about 0.1 m along the profile.
SurfaceMesh surface() {
    SurfaceMesh mesh;
    const auto p = profile();
    std::vector<Vec3> line;
    for (std::size_t k = 0; k + 1 < p.size(); ++k) {
        const int parts = static_cast<int>(std::ceil((p[k + 1] - p[k]).norm() / 0.1));
        for (int n = k == 0 ? 0 : 1; n <= parts; ++n) {
            line.emplace_back(p[k] + (p[k + 1] - p[k]) * n / parts);
        }
    }
    for (const double y : {-0.31, -0.12, 0.07, 0.26}) {
        for (const auto& v : line) {
            mesh.vertex.emplace_back(v.x(), y, v.z());
        }
    }
    const auto n = static_cast<std::uint32_t>(line.size());
    for (std::uint32_t row = 0; row < 3; ++row) {
        for (std::uint32_t k = 0; k + 1 < n; ++k) {
            const std::uint32_t a = row * n + k;
            mesh.add({a, a + 1, a + n + 1, a + n});
        }
    }
    return triangulated(mesh);
}

// A piece of the way of the centre: straight, or an arc about a point.
struct Piece {
    Vec3 from, to, about;
    double length;
    bool arc;
};

std::vector<Piece> way(double& concave_at) {
    const auto p = profile();
    const auto normal = [&](std::size_t k) {
        const Vec3 along = (p[k + 1] - p[k]).normalized();
        return Vec3(-along.z(), 0, along.x());
    };
    std::vector<Piece> out;
    const auto line = [&](const Vec3& a, const Vec3& b) { out.push_back({a, b, Vec3::Zero(), (b - a).norm(), false}); };
    const auto arc = [&](std::size_t k) {
        const Vec3 a = p[k] + lift * normal(k - 1);
        const Vec3 b = p[k] + lift * normal(k);
        out.push_back({a, b, p[k], lift * std::acos(normal(k - 1).dot(normal(k))), true});
        return b;
    };
    const Vec3 begin = p[0] + Vec3(0.1, 0, lift);
    line(begin, p[1] + lift * normal(0));
    const Vec3 down = arc(1);
    // Where the lines at this distance from both sides of the concave corner meet.
    const Vec3 corner = p[2] + lift / std::cos(degrees(15)) * (normal(1) + normal(2)).normalized();
    line(down, corner);
    concave_at = out[0].length + out[1].length + out[2].length;
    line(corner, p[3] + lift * normal(2));
    const Vec3 last = arc(3);
    line(last, last + 0.6 * (p[4] - p[3]).normalized());
    return out;
}

Vec3 place(const Piece& piece, double s) {
    if (!piece.arc) {
        return piece.from + (piece.to - piece.from) * (s / piece.length);
    }
    const Vec3 a = piece.from - piece.about;
    const double angle = s / lift;
    return piece.about + Eigen::AngleAxisd(angle, Vec3::UnitY()) * a;
}

Outcome compute() {
    OneSphere kind;
    kind.radius = 0.14;
    kind.young = 1e3;
    kind.friction = 5.0;
    kind.law = ContactLaw::linear;
    const Material m = kind.material();
    LooseContact law;
    {
        Surface s = kind.surface(plane_surface(1, 1));
        law = wall_contact(wall_pair(m, s.material, s.friction), {kind.radius, kind.mass(), 1.0},
                           std::numbers::pi * kind.radius * kind.radius);
    }
    const double limit = kind.friction * law.k_n * (kind.radius - lift);
    LedSphere sphere(kind, surface(), speed, dt, search_every);
    double concave_at = 0.0;
    const auto pieces = way(concave_at);
    // The second plane is felt from where the centre stands on it; the first one until it no longer stands on that.
    const double around = lift * std::tan(degrees(15)) + 1e-3 + lift * std::tan(degrees(30));

    report::Curve tangential{"tangential", {}, {}, "#c0392b"};
    report::Curve normal{"normal, times mu", {}, {}, "#1f4e79", report::CurveStyle::dashed};
    double form = 0.0, drop = 0.0, gone = 0.0, before = 0.0, lowest_after = 1e300;
    int step = 0;
    for (const auto& piece : pieces) {
        for (double s = 0.0; s < piece.length; s += speed * dt, gone += speed * dt) {
            sphere.go(place(piece, s));
            const double force = sphere.tangential_forces();
            const bool in_corner = std::fabs(gone - concave_at) < around;
            if (gone < concave_at - around) {
                form = std::max(form, std::fabs(force - std::min(law.k_t * gone, limit)) / limit);
            }
            if (gone > concave_at + 0.55) { // long enough after it to slide again
                lowest_after = std::min(lowest_after, force / limit);
            }
            if (!in_corner) {
                drop = std::max(drop, (before - force) / limit);
            }
            before = force;
            if (step++ % 200 == 0) {
                tangential.x.push_back(gone);
                tangential.y.push_back(force);
                normal.x.push_back(gone);
                normal.y.push_back(kind.friction * sphere.normal_forces());
            }
        }
    }
    Outcome out;
    // A step is 2.5e-5 m of the 0.48 m in which friction builds up: 5e-5 of the limit; pieces of the way begin anew in the middle of one.
    out.checks = {{"force less min(k_t way, mu F_n) before the concave corner, over mu F_n", 0.0, form, 3e-4, Compare::absolute, "", ""},
                  {"largest drop in a step outside the concave corner, over mu F_n", 0.0, drop, 1e-4, Compare::absolute, "",
                   "reset to 0 without care"},
                  {"lowest force after it, once sliding again, over mu F_n", 1.0, lowest_after, 1e-3, Compare::absolute, "", ""}};
    out.plots = {{"Tangential force over elements and corners; searched every 100 steps (fig. 3.23)",
                  "way [m]",
                  "force [N]",
                  {tangential, normal},
                  {}}};
    return out;
}

} // namespace tangential_continuity_case

Case tangential_continuity() {
    using namespace tangential_continuity_case;
    return {"tangential-continuity", "3.5.2", "The tangential force goes on where the contact changes to another element, edge or facet.",
            false, compute};
}

} // namespace proveta::verification
