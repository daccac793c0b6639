// A sphere led around an edge at constant indentation (thesis 3.6.2).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace normal_continuity_case {

constexpr double indentation = 0.01; // m

Outcome compute() {
    OneSphere kind;
    kind.friction = 0.0;
    // Two planes at a right angle: z = 0 for x < 0 and x = 0 for z < 0, of triangles smaller than the sphere.
    SurfaceMesh mesh;
    mesh.vertex = {{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}, {0, -1, -1}, {0, 1, -1}};
    mesh.add({0, 1, 2, 3});
    mesh.add({1, 4, 5, 2});
    mesh = refined(refined(refined(triangulated(mesh))));
    constexpr double step = 1e-3; // m
    LedSphere sphere(kind, std::move(mesh), 1.0, step, 1);
    const double lift = kind.radius - indentation;
    const double arc = 0.5 * std::numbers::pi * lift;
    const double expected = kind.hertz_stiffness() * std::pow(indentation, 1.5);
    report::Curve size{"size", {}, {}, "#111111"};
    report::Curve up{"vertical part", {}, {}, "#1f4e79"};
    report::Curve across{"horizontal part", {}, {}, "#c0392b"};
    double lowest = 1e300, highest = 0.0, direction = 0.0;
    for (double way = 0.0; way < 1.0 + arc; way += step) {
        const double on_first = std::min(way, 0.5);
        const double angle = std::clamp((way - 0.5) / lift, 0.0, 0.5 * std::numbers::pi);
        const double on_second = std::max(0.0, way - 0.5 - arc);
        const Vec3 normal(std::sin(angle), 0.0, std::cos(angle));
        sphere.go(Vec3(on_first - 0.5, 0.013, -on_second) + lift * normal);
        const Vec3 force = sphere.force();
        lowest = std::min(lowest, force.norm());
        highest = std::max(highest, force.norm());
        direction = std::max(direction, (force.normalized() - normal).norm());
        size.x.push_back(way);
        size.y.push_back(force.norm());
        up.x.push_back(way);
        up.y.push_back(force.z());
        across.x.push_back(way);
        across.y.push_back(force.x());
    }
    Outcome out;
    out.checks = {{"lowest force, 4/3 E* sqrt(R) d^(3/2)", expected, lowest, 1e-9, Compare::relative, "N", "76.063 N"},
                  {"highest force", expected, highest, 1e-9, Compare::relative, "N", "76.063 N"},
                  {"the closed form in figures", 76.0726, expected, 1e-6, Compare::relative, "N", ""},
                  {"direction less that of the path's normal", 0.0, direction, 1e-9, Compare::absolute, "", ""}};
    out.plots = {{"Around an edge: facet, edge, facet (fig. 3.27)", "way [m]", "force [N]", {size, up, across}, {}}};
    return out;
}

} // namespace normal_continuity_case

Case normal_continuity() {
    using namespace normal_continuity_case;
    return {"normal-continuity", "3.6.2", "The normal force does not jump where the contact goes from a facet to an edge and on.", false,
            compute};
}

} // namespace proveta::verification
