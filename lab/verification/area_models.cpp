// All area rules, and three treatments of the skin, on the same specimens: what docs/areas.md quotes.
#include <fmt/format.h>

#include <cmath>

#include "lab/elastic/press.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/meshes.hpp"
#include "specimens/laguerre.hpp"

namespace proveta::verification {

namespace area_models_case {

// Areas by one way of computing them, handed over as given ones.
struct Model {
    const char* name;
    Areas (*areas)(const Mesh&);
};

Areas by_rule(const Mesh& m, AreaRule rule) { return effective_areas(rule, m.spheres, m.pairs, m.skin); }

Areas without_skin(const Mesh& m) {
    return effective_areas(AreaRule::virtual_polyhedron, m.spheres, m.pairs, std::vector<std::uint8_t>(m.spheres.size(), 0));
}

// The released code's rule: a skin sphere of n bonds has n/11 of the surface of an 11-faced polyhedron, and where a skin sphere meets an
// inner one the inner one decides.
Areas eleventh_skin(const Mesh& m) {
    Areas a = without_skin(m);
    std::vector<double> faces(m.spheres.size(), 0.0);
    for (const auto& [i, j] : m.pairs) {
        faces[static_cast<std::size_t>(i)] += 1.0;
        faces[static_cast<std::size_t>(j)] += 1.0;
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
        if (m.skin[k] != 0 && faces[k] > 0.0) {
            a.weight[k] *= faces[k] / 11.0 * polyhedron_ratio(11.0) / polyhedron_ratio(faces[k]);
        }
    }
    for (std::size_t p = 0; p < m.pairs.size(); ++p) {
        const auto i = static_cast<std::size_t>(m.pairs[p].i);
        const auto j = static_cast<std::size_t>(m.pairs[p].j);
        const double w_i = m.skin[i] != 0 && m.skin[j] == 0 ? a.weight[j] : a.weight[i];
        const double w_j = m.skin[j] != 0 && m.skin[i] == 0 ? a.weight[i] : a.weight[j];
        a.pair[p] = contact_area(AreaRule::virtual_polyhedron, m.spheres, i, j, w_i, w_j);
    }
    return a;
}

constexpr Model models[] = {
    {"minimum_radius", [](const Mesh& m) { return by_rule(m, AreaRule::minimum_radius); }},
    {"truncated_cone", [](const Mesh& m) { return by_rule(m, AreaRule::truncated_cone); }},
    {"virtual_polyhedron", [](const Mesh& m) { return by_rule(m, AreaRule::virtual_polyhedron); }},
    {"virtual_polyhedron, no skin rule", without_skin},
    {"virtual_polyhedron, skin n/11", eleventh_skin},
    {"laguerre", [](const Mesh& m) { return laguerre_areas(m.specimen.shape, m.spheres, m.pairs).areas; }},
};

struct Moments {
    double sum = 0.0, squares = 0.0, count = 0.0;
    void add(double x) {
        sum += x;
        squares += x * x;
        count += 1.0;
    }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double deviation() const { return std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1.0))); }
};

Material elastic() {
    Material m;
    m.area_rule = AreaRule::laguerre; // takes the areas that it is given
    return m;
}

} // namespace area_models_case

Case area_models() {
    using namespace area_models_case;
    return {
        "area-models", "5.3", "Every area rule and three treatments of the skin: cuts, filling and scatter of the modulus.", true, [] {
            constexpr int seeds = 5;
            constexpr std::int64_t small = 2000;
            ElasticOptions options{.anchor = 1e-10};
            options.tolerance = 1e-7; // four digits are shown
            Outcome out;
            const Mesh large[2] = {cylinder_mesh(1), cylinder_mesh(2)};
            std::vector<Mesh> few;
            for (int seed = 1; seed <= seeds; ++seed) {
                few.push_back(small_cylinder(small, seed));
            }
            report::Curve scatter{"E/E0, mean of seeds", {}, {}, "#1f4e79"};
            std::string table =
                "| areas | 3D-1 whole | interior | sum(A d)/V | dropped | 3D-2 whole | interior | sum(A d)/V | dropped | E/E0 | its "
                "scatter | nu | its scatter |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
            const auto report = [&](const std::string& what, double value) {
                out.checks.push_back({what, 0.0, value, 0.0, Compare::reported});
            };
            for (const auto& model : models) {
                const std::string name = model.name;
                table += "| " + name;
                for (const auto& mesh : large) {
                    const Areas areas = model.areas(mesh);
                    const Bonds bonds = mesh.bonds(elastic(), &areas);
                    const Partition p = partition(mesh.specimen.shape, mesh.spheres, bonds);
                    report(name + ", " + mesh.name + ": section", p.section);
                    report(name + ", " + mesh.name + ": interior", p.interior);
                    report(name + ", " + mesh.name + ": sum(A d)/V", p.filling);
                    const double dropped = static_cast<double>(mesh.pairs.size() - bonds.size()) / static_cast<double>(mesh.pairs.size());
                    table += fmt::format(" | {:.4f} | {:.4f} | {:.3f} | {:.2f} %", p.section, p.interior, p.filling, 100.0 * dropped);
                }
                Moments e;
                Moments nu;
                for (const auto& mesh : few) {
                    const Areas areas = model.areas(mesh);
                    const Material m = elastic();
                    const auto found = press_elastically(mesh.specimen.shape, mesh.spheres, mesh.bonds(m, &areas), options);
                    e.add(found.young_modulus / m.young_modulus);
                    nu.add(found.poisson_ratio);
                }
                report(name + ": E/E0, mean of seeds", e.mean());
                report(name + ": E/E0, deviation over its mean", e.deviation() / e.mean());
                report(name + ": nu, mean of seeds", nu.mean());
                scatter.x.push_back(static_cast<double>(scatter.x.size()) + 1.0);
                scatter.y.push_back(e.mean());
                table += fmt::format(" | {:.4f} | {:.2f} % | {:.4f} | {:.4f} |\n", e.mean(), 100.0 * e.deviation() / e.mean(), nu.mean(),
                                     nu.deviation());
            }
            out.plots.push_back({"Modulus over that of the bonds, area rules in the order of the table.", "rule", "E/E0", {scatter}, {}});
            for (const auto& mesh : large) {
                const LaguerreAreas l = laguerre_areas(mesh.specimen.shape, mesh.spheres, mesh.pairs);
                out.checks.push_back({mesh.name + ": volume of Laguerre cells over the cylinder's", 1.0, l.volume_ratio, 0.002});
                report(mesh.name + ": share of bonds without a facet",
                       static_cast<double>(l.facetless) / static_cast<double>(mesh.pairs.size()));
                report(mesh.name + ": share of facet area without a bond", l.unbonded_share);
            }
            out.notes = {
                table,
                fmt::format("Cuts on the meshes of area-partition; E and nu between lubricated ends, {} packings of {} spheres, bonds "
                            "with a = b = 1, nu 0.2, coordination 10.",
                            seeds, small)};
            return out;
        }};
}

} // namespace proveta::verification
