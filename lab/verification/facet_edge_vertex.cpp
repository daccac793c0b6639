// A soft sphere dropped onto a facet, an edge and a vertex (thesis 3.6.1).
#include <algorithm>
#include <cmath>

#include "core/boundaries/surface_shapes.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/one_sphere.hpp"

namespace proveta::verification {

namespace facet_edge_vertex_case {

constexpr double height = 1.0; // of the fall, m

struct Fall {
    report::Curve path;
    std::vector<double> z;
    double deepest = 0.0, highest = 0.0, sideways = 0.0, residual = 0.0;
    std::size_t most_contacts = 0;
};

Fall fall(const char* name, const char* colour, SurfaceMesh mesh) {
    const OneSphere kind;
    Model model = make_model(kind, {{0, 0, height + kind.radius}}, {kind.surface(std::move(mesh))}, 1e-5);
    Fall out;
    out.path = {name, {}, {}, colour};
    const double period = 2.0 * std::sqrt(2.0 * height / 9.81);
    bool rebounding = false;
    for (int n = 0; model.time() < 1.4 * period; ++n) {
        model.step({}, n % 100 == 0);
        const Vec3 at = model.spheres.position.at(0);
        const WallSums& sums = model.walls.surfaces[0].sums;
        out.most_contacts = std::max(out.most_contacts, model.walls.surfaces[0].touches[0].size());
        out.deepest = std::max(out.deepest, kind.radius - at.z());
        rebounding = rebounding || (sums.touching == 0 && out.deepest > 0.0);
        out.highest = rebounding ? std::max(out.highest, at.z() - kind.radius) : 0.0;
        if (sums.touching > 0) {
            out.sideways = std::max(out.sideways, std::hypot(sums.reaction.x(), sums.reaction.y()) / sums.reaction.norm());
        }
        out.z.push_back(at.z());
        if (n % 400 == 0) {
            out.path.x.push_back(model.time());
            out.path.y.push_back(at.z());
        }
    }
    out.residual = std::fabs(model.ledger().relative_residual());
    return out;
}

// A roof of two planes that meet in the x axis at z = 0, cut into many small triangles.
SurfaceMesh roof() {
    SurfaceMesh mesh;
    mesh.vertex = {{-1, 0, 0}, {1, 0, 0}, {1, -0.7, -0.5}, {-1, -0.7, -0.5}, {1, 0.7, -0.5}, {-1, 0.7, -0.5}};
    mesh.add({0, 3, 2, 1});
    mesh.add({0, 1, 4, 5});
    return refined(refined(refined(triangulated(mesh))));
}

SurfaceMesh peak() {
    SurfaceMesh mesh = refined(refined(refined(cylinder_surface(1.0, 0.0, 1.0, 6, false, false))));
    for (auto& v : mesh.vertex) {
        v.z() -= 1.0;
    }
    return mesh;
}

// The deepest overlap: 2/5 k d^(5/2) = m g (h + d).
double deepest(const OneSphere& kind) {
    double d = 0.1;
    for (int k = 0; k < 100; ++k) {
        d = std::pow(2.5 * kind.mass() * 9.81 * (height + d) / kind.hertz_stiffness(), 0.4);
    }
    return d;
}

Outcome compute() {
    const OneSphere kind;
    const Fall facet = fall("facet", "#1f4e79", refined(refined(refined(triangulated(plane_surface(2.0, 2.0))))));
    const Fall edge = fall("edge", "#c0392b", roof());
    const Fall vertex = fall("vertex", "#1e7b46", peak());
    Outcome out;
    for (const auto* f : {&facet, &edge, &vertex}) {
        const std::string of = ", " + f->path.name;
        double apart = 0.0;
        for (std::size_t k = 0; k < f->z.size(); ++k) {
            apart = std::max(apart, std::fabs(f->z[k] - facet.z[k]));
        }
        // The overlap at a step misses the deepest by (v dt)^2: 1e-7 of it. The step's own error is of second order.
        out.checks.push_back({"deepest overlap" + of, deepest(kind), f->deepest, 1e-4, Compare::relative, "m", ""});
        out.checks.push_back({"height after the rebound" + of, height, f->highest, 1e-4, Compare::relative, "m", ""});
        out.checks.push_back({"horizontal part of the force" + of, 0.0, f->sideways, 1e-9, Compare::absolute, "", ""});
        out.checks.push_back({"path less the facet's" + of, 0.0, apart, 1e-9, Compare::absolute, "m", "\"exactly the same\""});
        out.checks.push_back({"contacts at once" + of, 1.0, static_cast<double>(f->most_contacts), 0.0, Compare::absolute, "", ""});
        out.checks.push_back({"energy ledger, relative residual" + of, 0.0, f->residual, 1e-4, Compare::absolute, "", ""});
    }
    out.checks.push_back({"deepest overlap over the radius", 0.3, facet.deepest / kind.radius, 0.0, Compare::at_least, "", "> 30 %"});
    out.plots = {{"Rebound from a facet, an edge and a vertex (fig. 3.25)",
                  "time [s]",
                  "height of the centre [m]",
                  {facet.path, edge.path, vertex.path},
                  {}}};
    return out;
}

} // namespace facet_edge_vertex_case

Case facet_edge_vertex() {
    using namespace facet_edge_vertex_case;
    return {"facet-edge-vertex", "3.6.1", "A soft sphere rebounds alike from a facet, an edge and a vertex of fine meshes.", false,
            compute};
}

} // namespace proveta::verification
