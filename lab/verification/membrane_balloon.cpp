// Balloons and tubes of membrane triangles under inner pressure against the formulas of thin walls (thesis 4.2, equation (4.37)).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/model.hpp"
#include "core/solids/solid_shapes.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace membrane_balloon_case {

constexpr double radius = 0.1;     // m
constexpr double thickness = 1e-3; // m

SolidMaterial rubber() {
    SolidMaterial m;
    m.law = SolidLaw::neo_hookean;
    m.density = 1000.0;
    m.young_modulus = 1e6;
    m.poisson_ratio = 0.45;
    return m;
}

// Square of the stretch across a sheet in plane stress whose area has grown by `area`: the root s of
// lambda ln(area sqrt(s)) + mu (s - 1) = 0, which grows with s, by halves.
double square_across(double area) {
    const Lame c = rubber().lame();
    double low = 1e-6;
    double high = 10.0;
    for (int k = 0; k < 200; ++k) {
        const double s = 0.5 * (low + high);
        (c.lambda * std::log(area * std::sqrt(s)) + c.mu * (s - 1.0) < 0.0 ? low : high) = s;
    }
    return low;
}

// From (4.37) sigma = (mu (l^2 - 1) + lambda ln J) / J along a stretch l, and nothing across: sigma = mu (l^2 - s) / J. With p = 2 sigma
// t/r in a sphere of radius l R and thickness sqrt(s) T, J = l^2 sqrt(s): p = 2 mu T / R (l^2 - s) / l^3.
double sphere_pressure(double stretch) {
    const double s = square_across(stretch * stretch);
    return 2.0 * rubber().lame().mu * thickness / radius * (stretch * stretch - s) / (stretch * stretch * stretch);
}

// In a tube that keeps its length, p = sigma t / r and J = l sqrt(s): p = mu T / R (l^2 - s) / l^2.
double tube_pressure(double stretch) {
    const double s = square_across(stretch);
    return rubber().lame().mu * thickness / radius * (stretch * stretch - s) / (stretch * stretch);
}

// The stretch at which one of these reaches a pressure, below the balloon's highest (at 1.4).
template <class Pressure> double stretch_at(double pressure, const Pressure& of) {
    double low = 1.0;
    double high = 1.35;
    for (int k = 0; k < 60; ++k) {
        const double l = 0.5 * (low + high);
        (of(l) < pressure ? low : high) = l;
    }
    return low;
}

// A body and a sphere that it never meets: a model needs one.
Model make_model(Solid solid, double pressure) {
    Spheres s;
    s.add(Vec3::Zero(), 0.1 * radius, 1000.0);
    Material m;
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, {0}, weight);
    std::vector<SolidMesh::Triangle> facets;
    for (const auto& f : solid.mesh().membranes) { // they face outwards, and pressure presses against where they face to
        facets.push_back(f);
    }
    solid.pressures.push_back({-pressure, facets});
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    return {std::move(s),
            {m},
            std::move(none),
            std::move(weight),
            Walls({}, {}, {Deformable(std::move(solid), m, 0.0, Coupling::area_distributed, 0.0)}),
            numerics};
}

struct State {
    double stretch = 0.0; // mean of the nodes that count
    double uneven = 0.0;  // standard deviation of the same
    double stress = 0.0;  // mean of the elements along the circle about z, or in the sphere of both directions, Pa
    double left = 0.0;    // fastest node over the speed of waves
};

// Nodes' distance from the axis (tube, in its middle half) or the centre (sphere).
State state_of(const Model& model, bool tube) {
    const Solid& solid = model.walls.bodies[0].solid;
    const SolidMesh& mesh = solid.mesh();
    const auto across = [&](const Vec3& p) { return tube ? Vec3(p.x(), p.y(), 0.0) : p; };
    State out;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < mesh.node.size(); ++k) {
        const double l = across(solid.position[k]).norm() / across(mesh.node[k]).norm();
        out.stretch += l;
        squares += l * l;
        count += 1.0;
        out.left = std::max(out.left, solid.velocity[k].norm());
    }
    out.stretch /= count;
    out.uneven = std::sqrt(std::max(0.0, squares / count - out.stretch * out.stretch));
    out.left /= std::sqrt(rubber().young_modulus / rubber().density);
    const auto stresses = solid.stresses();
    double area = 0.0;
    for (std::size_t e = 0; e < stresses.size(); ++e) {
        const auto& f = mesh.membranes[e];
        const double weight = (mesh.node[f[1]] - mesh.node[f[0]]).cross(mesh.node[f[2]] - mesh.node[f[0]]).norm();
        const Vec3 middle = across(mesh.node[f[0]] + mesh.node[f[1]] + mesh.node[f[2]]).normalized();
        const Vec3 around = Vec3::UnitZ().cross(middle);
        area += weight;
        out.stress += weight * (tube ? around.dot(stresses[e] * around) : 0.5 * stresses[e].trace());
    }
    out.stress /= area;
    return out;
}

// Blown up at once, and brought to rest by damping as strong as the breathing needs.
State inflate(bool tube, double pressure, report::Curve* path = nullptr) {
    SolidMaterial m = rubber();
    const double breathing = std::sqrt(m.young_modulus / m.density) / radius; // rad/s, roughly
    m.mass_damping = 2.0 * breathing;
    Solid solid("balloon", tube ? tube_membrane(radius, 0.2, 60, 23) : sphere_membrane(radius, 4), m, thickness);
    if (tube) {
        for (const auto& group : solid.mesh().groups) {
            solid.holds.push_back({group.name, group.node, {false, false, true}});
        }
    }
    Model model = make_model(std::move(solid), pressure);
    const double until = 40.0 / breathing;
    while (model.time() < until) {
        model.step({}, false);
        if (path != nullptr && model.steps() % 20 == 0) {
            path->x.push_back(1e3 * model.time());
            path->y.push_back(state_of(model, tube).stretch);
        }
    }
    return state_of(model, tube);
}

void small_strain(Outcome& out) {
    const SolidMaterial m = rubber();
    const double strain = 1e-3;
    const double p_sphere = 2.0 * m.young_modulus * thickness / (radius * (1.0 - m.poisson_ratio)) * strain;
    const double p_tube = m.young_modulus * thickness / (radius * (1.0 - m.poisson_ratio * m.poisson_ratio)) * strain;
    const State sphere = inflate(false, p_sphere);
    const State tube = inflate(true, p_tube);
    // The sheets are polyhedra: facets with an edge of 0.07 R in the sphere and 0.1 R in the tube lie up to (edge/R)^2/6 below it.
    out.checks.push_back(
        {"balloon, u_r = p r^2 (1 - nu)/(2 E t)", radius * strain, radius * (sphere.stretch - 1.0), 0.02, Compare::relative, "m", ""});
    out.checks.push_back(
        {"balloon, stress p r/(2 t)", p_sphere * radius / (2.0 * thickness), sphere.stress, 0.02, Compare::relative, "Pa", ""});
    out.checks.push_back({"tube with held ends, u_r = p r^2 (1 - nu^2)/(E t)", radius * strain, radius * (tube.stretch - 1.0), 0.02,
                          Compare::relative, "m", ""});
    out.checks.push_back({"tube, hoop stress p r/t", p_tube * radius / thickness, tube.stress, 0.02, Compare::relative, "Pa", ""});
}

void finite_strain(Outcome& out) {
    report::Curve known[] = {{"balloon, closed form", {}, {}, "#1f4e79"}, {"tube, closed form", {}, {}, "#c0392b"}};
    report::Curve found[] = {{"balloon", {}, {}, "#1f4e79", report::CurveStyle::points},
                             {"tube", {}, {}, "#c0392b", report::CurveStyle::points}};
    for (double l = 1.0; l <= 1.401; l += 0.01) {
        known[0].x.push_back(l);
        known[0].y.push_back(1e-3 * sphere_pressure(l));
        known[1].x.push_back(l);
        known[1].y.push_back(1e-3 * tube_pressure(l));
    }
    report::Plot in_time{"The balloon comes to rest", "time [ms]", "radius over that without pressure", {}, {}};
    for (const double wanted : {1.05, 1.15, 1.25}) {
        const std::string of = ", stretch " + std::to_string(wanted).substr(0, 4);
        report::Curve path{"stretch " + std::to_string(wanted).substr(0, 4),
                           {},
                           {},
                           wanted > 1.2   ? "#c0392b"
                           : wanted > 1.1 ? "#1f4e79"
                                          : "#1e7b46"};
        const double p_sphere = sphere_pressure(wanted);
        const double p_tube = tube_pressure(wanted);
        const State sphere = inflate(false, p_sphere, &path);
        const State tube = inflate(true, p_tube);
        in_time.curves.push_back(path);
        // The pressure that belongs to the radius found: near the highest pressure the radius answers to it without measure.
        out.checks.push_back(
            {"balloon, pressure at the radius found" + of, sphere_pressure(sphere.stretch), p_sphere, 0.02, Compare::relative, "Pa", ""});
        out.checks.push_back(
            {"balloon, stretch" + of, stretch_at(p_sphere, sphere_pressure), sphere.stretch, 0.01, Compare::relative, "", ""});
        out.checks.push_back(
            {"tube, pressure at the radius found" + of, tube_pressure(tube.stretch), p_tube, 0.02, Compare::relative, "Pa", ""});
        const double s = square_across(tube.stretch);
        out.checks.push_back({"tube, hoop stress p r/t" + of, p_tube * radius * tube.stretch / (thickness * std::sqrt(s)), tube.stress,
                              0.02, Compare::relative, "Pa", ""});
        out.checks.push_back(
            {"balloon, fastest node at the end over the speed of waves" + of, 1e-3, sphere.left, 0.0, Compare::at_most, "", ""});
        out.checks.push_back({"balloon, unevenness of the stretch" + of, 0.0, sphere.uneven, 0.0, Compare::reported, "", ""});
        found[0].x.push_back(sphere.stretch);
        found[0].y.push_back(1e-3 * p_sphere);
        found[1].x.push_back(tube.stretch);
        found[1].y.push_back(1e-3 * p_tube);
    }
    out.plots = {{"Pressure and stretch of Neo-Hookean membranes",
                  "radius over that without pressure",
                  "pressure [kPa]",
                  {known[0], known[1], found[0], found[1]},
                  {},
                  false,
                  false},
                 in_time};
}

Outcome compute() {
    Outcome out;
    small_strain(out);
    finite_strain(out);
    out.notes = {"Rubber of 1 MPa and nu 0.45, walls of 1 mm on a radius of 100 mm; the balloon has 5120 triangles, the tube 2760 and ends "
                 "that are free to widen but not to come nearer."};
    return out;
}

} // namespace membrane_balloon_case

Case membrane_balloon() {
    using namespace membrane_balloon_case;
    return {"membrane-balloon", "4.2", "A balloon and a tube of membranes under pressure, at small and at finite strain.", false, compute};
}

} // namespace proveta::verification
