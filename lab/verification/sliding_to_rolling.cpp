// A sphere that slides on a plane until it rolls, on one quadrilateral and on 80 triangles (thesis 3.6.4).
#include <cmath>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace sliding_to_rolling_case {

constexpr double speed = 5.0, gravity = 9.81, until = 1.0; // m/s, m/s2, s

// A strip of 10 x 4 rectangles, each of two triangles.
SurfaceMesh strip() {
    SurfaceMesh mesh;
    for (int y = 0; y <= 4; ++y) {
        for (int x = 0; x <= 10; ++x) {
            mesh.vertex.emplace_back(0.6 * x - 1.0, 0.5 * y - 1.07, 0.0);
        }
    }
    for (std::uint32_t y = 0; y < 4; ++y) {
        for (std::uint32_t x = 0; x < 10; ++x) {
            const std::uint32_t a = 11 * y + x;
            mesh.add({a, a + 1, a + 12, a + 11});
        }
    }
    return triangulated(mesh);
}

struct Slide {
    double x, v, w; // at the end
    report::Curve speed, spin;
    double residual;
};

Slide slide(const OneSphere& kind, SurfaceMesh mesh, double dt) {
    const double sunk = kind.overlap(kind.mass() * gravity);
    Model model = make_model(kind, {{0, 0, kind.radius - sunk}}, {kind.surface(std::move(mesh))}, dt);
    model.spheres.velocity.set(0, {speed, 0, 0});
    Slide out{0, 0, 0, {"speed over the first", {}, {}, "#1f4e79"}, {"spin times radius, likewise", {}, {}, "#c0392b"}, 0};
    const auto steps = std::lround(until / dt);
    for (long n = 0; n < steps; ++n) {
        model.step({}, n % 1000 == 0 || n == steps - 1);
        if (n % (steps / 200) == 0) {
            out.speed.x.push_back(model.time());
            out.speed.y.push_back(model.spheres.velocity.x[0] / speed);
            out.spin.x.push_back(model.time());
            out.spin.y.push_back(model.spheres.spin.y[0] * kind.radius / speed);
        }
    }
    out.x = model.spheres.position.x[0];
    out.v = model.spheres.velocity.x[0];
    out.w = model.spheres.spin.y[0];
    out.residual = std::fabs(model.ledger().relative_residual());
    return out;
}

// Slides with mu g until v = w r, r the lever arm of the soft contact.
struct Known {
    double x, v, w;
};
Known known(const OneSphere& kind) {
    const double r = kind.radius - kind.overlap(kind.mass() * gravity);
    const double share = 0.4 * kind.radius * kind.radius / (r * r);
    const double v = speed / (1.0 + share);
    const double a = kind.friction * gravity;
    const double t = (speed - v) / a;
    return {speed * t - 0.5 * a * t * t + v * (until - t), v, v / r};
}

Outcome compute() {
    Outcome out;
    OneSphere kind;
    kind.young = 1e6;
    kind.restitution = 0.4;
    SurfaceMesh quad = plane_surface(20.0, 20.0);
    Slide shown{};
    for (const bool rigid : {false, true}) {
        kind.rigid_wall = rigid;
        const Slide one = slide(kind, quad, 1e-5);
        const Slide many = slide(kind, strip(), 1e-5);
        const Known k = known(kind);
        const std::string of = rigid ? ", rigid wall" : ", wall as soft as the sphere";
        const std::string v_printed = rigid ? "" : "3.5410", w_printed = rigid ? "" : "11.9788";
        out.checks.push_back({"speed" + of, k.v, one.v, 5e-4, Compare::relative, "m/s", v_printed});
        out.checks.push_back({"spin" + of, k.w, one.w, 5e-4, Compare::relative, "rad/s", w_printed});
        out.checks.push_back({"way" + of, k.x, one.x, 5e-4, Compare::relative, "m", rigid ? "" : "3.9021"});
        out.checks.push_back(
            {"speed in the table's digits" + of, rigid ? 3.5524 : 3.5410, one.v, 1e-4, Compare::absolute, "m/s", v_printed});
        out.checks.push_back(
            {"spin in the table's digits" + of, rigid ? 11.952 : 11.979, one.w, 1e-3, Compare::absolute, "rad/s", w_printed});
        out.checks.push_back({"80 triangles less one quadrilateral, way" + of, 0.0, many.x - one.x, 1e-6, Compare::absolute, "m", "1e-4"});
        out.checks.push_back({"80 triangles less one quadrilateral, speed" + of, 0.0, many.v - one.v, 1e-6, Compare::absolute, "m/s", ""});
        out.checks.push_back({"80 triangles less one quadrilateral, spin" + of, 0.0, many.w - one.w, 1e-6, Compare::absolute, "rad/s", ""});
        out.checks.push_back({"energy ledger, relative residual" + of, 0.0, one.residual, 1e-3, Compare::absolute, "", ""});
        shown = rigid ? shown : one;
    }
    // Ten times as hard, the lever arm comes 10^(2/3) nearer to the radius: the way approaches that of a hard sphere.
    kind.rigid_wall = true;
    double error = 0.0;
    for (const double young : {1e6, 1e7, 1e8}) {
        kind.young = young;
        const Slide s = slide(kind, quad, young > 5e7 ? 2e-6 : 5e-6);
        const double off = std::fabs(s.x - 3.91815);
        if (error > 0.0) {
            out.checks.push_back(
                {"error of the way against the ideal 3.91815 m falls with E, factor", 2.0, error / off, 0.0, Compare::at_least, "", ""});
        }
        error = off;
    }
    out.checks.push_back(
        {"way at E = 1e8 Pa against the ideal", 3.91815, 3.91815 + error, 5e-4, Compare::relative, "m", "0.41 % off at 1e6"});
    out.plots = {{"From sliding to rolling (fig. 3.31)", "time [s]", "over the first speed", {shown.speed, shown.spin}, {}}};
    return out;
}

} // namespace sliding_to_rolling_case

Case sliding_to_rolling() {
    using namespace sliding_to_rolling_case;
    return {"sliding-to-rolling", "3.6.4", "A sliding sphere comes to roll as the soft contact's lever arm says, whatever the mesh.", false,
            compute};
}

} // namespace proveta::verification
