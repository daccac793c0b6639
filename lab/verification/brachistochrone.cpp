// Spheres sliding down a cycloid: the fastest way, and the same time from any height (thesis 3.6.5).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace brachistochrone_case {

// The cycloid from (0, 0) to (0.2, -0.1): x = r (s - sin s), z = -r (1 - cos s).
constexpr double r = 0.05172, last = 3.5084, lower_start = 1.5;

Vec3 cycloid(double s) { return {r * (s - std::sin(s)), 0.0, -r * (1.0 - std::cos(s))}; }
// Towards the inside of its curve: across the tangent (1 - cos s, -sin s).
Vec3 inward(double s) { return {std::cos(0.5 * s), 0.0, std::sin(0.5 * s)}; }

// The centre is to go along the cycloid: the surface lies a radius outside, in strips of equal angle.
SurfaceMesh chute(double radius, int strips) {
    SurfaceMesh mesh;
    for (int k = 0; k <= strips; ++k) {
        const double s = (last + 0.2) * k / strips;
        const Vec3 at = cycloid(s) - radius * inward(s);
        mesh.vertex.emplace_back(at.x(), -0.05, at.z());
        mesh.vertex.emplace_back(at.x(), 0.05, at.z());
    }
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(strips); ++k) {
        mesh.add({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
    }
    return mesh;
}

struct Times {
    double bottom = 0.0, end = 0.0;
    report::Curve path;
};

Times slide(const char* name, const char* colour, double start, int strips) {
    OneSphere kind;
    kind.radius = 0.01;
    kind.density = 2500.0;
    kind.young = 1e7;
    kind.friction = 0.0;
    Model model = make_model(kind, {cycloid(start)}, {kind.surface(chute(kind.radius, strips))}, 1e-5);
    Times out;
    out.path = {name, {}, {}, colour};
    const double bottom = cycloid(std::numbers::pi).x();
    const double end = cycloid(last).x();
    double before = cycloid(start).x();
    for (int n = 0; out.end == 0.0 && model.time() < 0.5; ++n) {
        model.step({}, false);
        const double x = model.spheres.position.x[0];
        const auto passed = [&](double where) { return before < where && x >= where; };
        const auto when = [&](double where) { return model.time() - model.dt() * (x - where) / (x - before); };
        if (passed(bottom)) {
            out.bottom = when(bottom);
        }
        if (passed(end)) {
            out.end = when(end);
        }
        if (n % 250 == 0) {
            out.path.x.push_back(x);
            out.path.y.push_back(model.spheres.position.z[0]);
        }
        before = x;
    }
    return out;
}

Outcome compute() {
    constexpr int strips = 400;
    const Times high = slide("from the top", "#1f4e79", 0.0, strips);
    const Times low = slide("from half way", "#c0392b", lower_start, strips);
    const double scale = std::sqrt(r / 9.81);
    Outcome out;
    // Undamped, unlike table 3.9: at every edge of the chute a dashpot would take the part of the velocity across the new strip, and the
    // more the finer the strips are against the overlap's width. The overlap is a thousandth of the radius, and the sphere swings by that.
    out.checks = {{"time to the end", 0.25474, high.end, 5e-4, Compare::relative, "s", "0.2516 s, 1.22 % off"},
                  {"time to the bottom, from the top", 0.22811, high.bottom, 5e-4, Compare::relative, "s", "0.2198 s"},
                  {"time to the bottom, from half way", 0.22811, low.bottom, 5e-4, Compare::relative, "s", "0.2183 s"},
                  {"both times to the bottom alike", high.bottom, low.bottom, 5e-4, Compare::relative, "s", "0.68 %"},
                  {"sqrt(r/g) s in figures", 0.25474, scale * last, 1e-4, Compare::relative, "s", ""}};
    out.plots = {{"Two spheres on a cycloid (fig. 3.32)", "x [m]", "z [m]", {high.path, low.path}, {}, true}};
    return out;
}

} // namespace brachistochrone_case

Case brachistochrone() {
    using namespace brachistochrone_case;
    return {"brachistochrone", "3.6.5", "Spheres slide down a cycloid in the shortest time, and in the same from any height.", false,
            compute};
}

} // namespace proveta::verification
