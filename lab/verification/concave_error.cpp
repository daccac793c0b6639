// The jump of the normal force in a concave corner, which the Double Hierarchy method is known to have (thesis 3.5.1, (3.20)).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace concave_error_case {

constexpr double relative_indentations[] = {0.001, 0.01, 0.033, 0.1, 0.25, 0.5, 0.75, 0.98};
const char* colours[] = {"#1f4e79", "#c0392b", "#1e7b46", "#b9770e", "#7d3c98", "#0e8a93", "#7f8c8d", "#d35f9e"};

// (3.20); below zero the second plane is met without a jump.
double expected(double alpha, double gamma, ContactLaw law) {
    const double t = std::cos(alpha) > 1e-12 ? (gamma - 1.0 + std::cos(alpha)) / (gamma * std::cos(alpha)) : -1.0;
    return t <= 0.0 ? 0.0 : law == ContactLaw::linear ? t : std::pow(t, 1.5);
}

// First force of the second plane over that of the first, when a sphere is led along the first. alpha: change of direction.
double jump(double alpha, double gamma, ContactLaw law) {
    OneSphere kind;
    kind.friction = 0.0;
    kind.law = law;
    SurfaceMesh mesh;
    const double c = std::cos(alpha), s = std::sin(alpha);
    mesh.vertex = {{-2, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-2, 1, 0}, {c, -1, s}, {c, 1, s}};
    mesh.add({0, 1, 2, 3});
    mesh.add({1, 4, 5, 2});
    const double height = (1.0 - gamma) * kind.radius;
    // The second plane is met where the centre stands on it above the corner, x = -height tan(alpha), or sooner by touching: the first
    // place at which two contacts are found is bisected.
    LedSphere sphere(kind, std::move(mesh), 4.0, 1.0, 1);
    const auto met = [&](double x) {
        sphere.go({x, 0.0, height});
        return sphere.touches().size() > 1;
    };
    const double touching = -(kind.radius - height * c) / s;
    const double standing = -height * std::fabs(s / c);
    const double step = std::clamp(-standing / 20.0, 1e-6, 1e-3);
    double before = std::max(-1.9, std::min(touching, standing) - 0.05), after = kind.radius;
    // Beyond the corner the first plane no longer holds; a place where both do lies before it.
    for (double x = before; x <= 0.0; x += step) {
        if (met(x)) {
            after = x;
            break;
        }
        before = x;
    }
    if (after > 0.0) {
        return 0.0;
    }
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (before + after);
        (met(middle) ? after : before) = middle;
    }
    met(after);
    double first = 0.0, second = 0.0;
    for (const auto& t : sphere.touches()) {
        (t.face == 0 ? first : second) = t.force.norm();
    }
    return second / first;
}

Outcome compute() {
    Outcome out;
    for (const auto law : {ContactLaw::linear, ContactLaw::hertz}) {
        const std::string name = law == ContactLaw::linear ? "linear" : "Hertzian";
        report::Plot plot{"Force of the new plane over that of the old, " + name + " (fig. 3.19); lines: (3.20), dots: found",
                          "change of angle [degrees]",
                          "ratio of forces",
                          {},
                          {}};
        double worst = 0.0;
        for (std::size_t g = 0; g < std::size(relative_indentations); ++g) {
            const double gamma = relative_indentations[g];
            report::Curve line{"gamma = " + std::to_string(gamma).substr(0, 5), {}, {}, colours[g]};
            for (int degrees = 5; degrees <= 90; degrees += 5) {
                const double alpha = degrees * std::numbers::pi / 180.0;
                const double known = expected(alpha, gamma, law);
                const double found = jump(alpha, gamma, law);
                worst = std::max(worst, std::fabs(found - known) * gamma);
                line.x.push_back(degrees);
                line.y.push_back(known);
                plot.marks.emplace_back(degrees, found);
            }
            plot.curves.push_back(line);
        }
        // The tolerance for coplanar neighbours delays the new contact by 1e-6 of the distance from the corner, 1e-6 / gamma of the
        // overlap, which the Hertzian force takes to the power of 3/2.
        out.checks.push_back(
            {"largest difference to (3.20) times gamma, 5 to 90 degrees, " + name, 0.0, worst, 1.6e-6, Compare::absolute, "", ""});
        out.plots.push_back(plot);
    }
    out.checks.push_back({"(3.20) at 10 degrees and 3.3 %, Hertzian", 0.41,
                          expected(10.0 * std::numbers::pi / 180.0, 0.033, ContactLaw::hertz), 5e-3, Compare::absolute, "", "0.41"});
    out.checks.push_back({"(3.20) at 10 degrees and 3.3 %, linear", 0.55,
                          expected(10.0 * std::numbers::pi / 180.0, 0.033, ContactLaw::linear), 5e-3, Compare::absolute, "", "0.55"});
    return out;
}

} // namespace concave_error_case

Case concave_error() {
    using namespace concave_error_case;
    return {"concave-error", "3.5.1", "The known jump of the force in a concave corner is that of the closed form, at any angle and depth.",
            false, compute};
}

} // namespace proveta::verification
