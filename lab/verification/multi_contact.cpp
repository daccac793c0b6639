// Spheres that come to rest in holes of three shapes, on edges and on vertices (thesis 3.6.3).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace multi_contact_case {

// A plate at z = 0 around a hole: quadrilaterals between the hole's corners and those of a square, each along one side.
SurfaceMesh ring(const std::vector<Vec3>& hole) {
    SurfaceMesh mesh;
    const auto n = static_cast<std::uint32_t>(hole.size());
    for (const auto& v : hole) {
        mesh.vertex.push_back(v);
    }
    for (const auto& v : hole) { // outwards, as far as the plate reaches
        mesh.vertex.push_back(v * (1.0 / v.norm()));
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        mesh.add({k, n + k, n + (k + 1) % n, (k + 1) % n});
    }
    return triangulated(mesh);
}

std::vector<Vec3> regular(int corners, double inner_radius) {
    std::vector<Vec3> out;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.5) / corners;
        out.emplace_back(Vec3(std::cos(angle), std::sin(angle), 0.0) * (inner_radius / std::cos(std::numbers::pi / corners)));
    }
    return out;
}

// A cross of four arms: its inner corners carry the sphere.
std::vector<Vec3> cross(double inner, double outer) {
    std::vector<Vec3> out;
    for (int k = 0; k < 4; ++k) {
        const Eigen::AngleAxisd turn(0.5 * std::numbers::pi * k, Vec3::UnitZ());
        for (const Vec3& v : {Vec3(outer, -inner, 0), Vec3(outer, inner, 0), Vec3(inner, inner, 0)}) {
            out.push_back(turn * v);
        }
    }
    return out;
}

struct Hole {
    std::string name;
    std::vector<Vec3> corners;
    int contacts;    // that carry the sphere
    double distance; // of them from the axis, m
    Feature feature;
};

// Height of the centre at rest: n k d^(3/2) cos = m g, the contacts' distance from the centre R - d.
double height_at_rest(const OneSphere& kind, const Hole& hole) {
    double d = 0.0;
    double height = 0.0;
    for (int k = 0; k < 100; ++k) {
        height = std::sqrt((kind.radius - d) * (kind.radius - d) - hole.distance * hole.distance);
        d = kind.overlap(kind.mass() * 9.81 * (kind.radius - d) / height / hole.contacts);
    }
    return height;
}

Outcome compute() {
    OneSphere kind;
    kind.young = 1e6;
    kind.restitution = 0.4;
    const std::vector<Hole> holes{{"triangle", regular(3, 0.18), 3, 0.18, Feature::edge},
                                  {"square", regular(4, 0.2), 4, 0.2, Feature::edge},
                                  {"cross", cross(0.12, 0.5), 4, 0.12 * std::sqrt(2.0), Feature::vertex}};
    Outcome out;
    report::Plot plot{"Spheres falling into holes (fig. 3.29)", "time [s]", "speed [m/s]", {}, {}};
    const char* colours[] = {"#1f4e79", "#c0392b", "#1e7b46"};
    for (std::size_t h = 0; h < holes.size(); ++h) {
        const Hole& hole = holes[h];
        Model model = make_model(kind, {{0.01, -0.006, 0.5}}, {kind.surface(ring(hole.corners))}, 1e-5);
        report::Curve curve{hole.name, {}, {}, colours[h]};
        for (int n = 0; model.time() < 2.5; ++n) {
            model.step({}, n % 1000 == 0);
            if (n % 500 == 0) {
                curve.x.push_back(model.time());
                curve.y.push_back(model.spheres.velocity.at(0).norm());
            }
        }
        const Vec3 at = model.spheres.position.at(0);
        const auto& touches = model.walls.surfaces[0].touches[0];
        int right = 0;
        for (const auto& t : touches) {
            right += t.feature == hole.feature && t.force.norm() > 0.0 ? 1 : 0;
        }
        const double known = height_at_rest(kind, hole);
        const double overlap = kind.radius - std::hypot(known, hole.distance);
        const std::string of = ", " + hole.name;
        // Friction may hold the sphere anywhere within the overlap of where it would come to rest without.
        out.checks.push_back({"height of the centre at rest" + of, known, at.z(), overlap, Compare::absolute, "m", ""});
        out.checks.push_back({"distance from the hole's axis" + of, 0.0, std::hypot(at.x(), at.y()), overlap, Compare::absolute, "m", ""});
        out.checks.push_back(
            {"speed after 2.5 s" + of, 0.0, model.spheres.velocity.at(0).norm(), 1e-6, Compare::absolute, "m/s", "\"close to 0\""});
        out.checks.push_back({"contacts that carry it" + of, static_cast<double>(hole.contacts), static_cast<double>(right), 0.0,
                              Compare::absolute, "", ""});
        const Vec3 reaction = model.walls.surfaces[0].sums.reaction;
        out.checks.push_back({"weight on the plate" + of, kind.mass() * 9.81, -reaction.z(), 1e-6, Compare::relative, "N", ""});
        plot.curves.push_back(curve);
    }
    out.plots = {plot};
    return out;
}

} // namespace multi_contact_case

Case multi_contact() {
    using namespace multi_contact_case;
    return {"multi-contact", "3.6.3", "Spheres come to rest in holes, on three edges, on four, and on four vertices.", false, compute};
}

} // namespace proveta::verification
