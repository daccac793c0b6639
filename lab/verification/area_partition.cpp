// Do bond areas make up the section (thesis 5.4.1, table 5.3)?
#include <fmt/format.h>

#include "lab/verification/cases.hpp"
#include "lab/verification/meshes.hpp"

namespace proveta::verification {

Case area_partition() {
    return {"area-partition", "5.4.1", "Virtual-polyhedron areas of bonds, cut by planes across the axis, make up the section.", false, [] {
                Outcome out;
                report::Curve whole{"whole section", {}, {}, "#1f4e79"};
                report::Curve inside{"interior", {}, {}, "#c0392b"};
                const char* const thesis[] = {"+3.3 %", "+2.6 %", "+2.2 %", "-1.4 %", "0.0 %", "+1.5 %", "+0.9 %"};
                const auto add = [&](const Mesh& m, double allowed, double allowed_inside, const char* theirs) {
                    const Partition p = partition(m.specimen.shape, m.spheres, m.bonds(Material{}));
                    const std::string name = fmt::format("{}, coordination {:.2f}", m.name, m.coordination);
                    out.checks.push_back({name + ": section", 1.0, p.section, allowed, Compare::relative, "", theirs});
                    out.checks.push_back({name + ": interior", 1.0, p.interior, allowed_inside,
                                          allowed_inside > 0.0 ? Compare::relative : Compare::reported});
                    whole.x.push_back(m.coordination);
                    whole.y.push_back(100.0 * (p.section - 1.0));
                    inside.x.push_back(m.coordination);
                    inside.y.push_back(100.0 * (p.interior - 1.0));
                    out.notes.push_back(fmt::format("{}: {} {}, mean radius {:.2f} mm, deviation {:.2f} %, beta {:.3f}, porosity {:.2f} %.",
                                                    name, m.spheres.size(), m.spheres.planar ? "discs" : "spheres",
                                                    1e3 * m.statistics.mean_radius, 100.0 * m.statistics.relative_deviation, m.beta,
                                                    100.0 * m.statistics.porosity));
                };
                for (int k = 1; k <= 5; ++k) {
                    add(plate_mesh(k), k == 5 ? 1e-9 : 0.033, 0.0, thesis[k - 1]);
                }
                for (int k = 1; k <= 2; ++k) {
                    const Mesh mesh = cylinder_mesh(k);
                    add(make_mesh(mesh.name, mesh.specimen, 10.0), 0.015, 0.035, "");
                    add(mesh, 0.015, 0.0, thesis[k + 4]);
                }
                for (auto* c : {&whole, &inside}) { // by coordination, and 2D-5 apart: its inner region is no whole number of columns
                    c->x.erase(c->x.begin() + 4);
                    c->y.erase(c->y.begin() + 4);
                    std::swap(c->x[5], c->x[6]);
                    std::swap(c->y[5], c->y[6]);
                }
                out.plots.push_back({"Error of the section made up by bond areas: plates (2D-1 to 2D-4) and cylinders (at 10 and 11).",
                                     "coordination",
                                     "error [%]",
                                     {whole, inside},
                                     {}});
                out.notes.emplace_back(
                    "The thesis's meshes are GiD's; ours are relaxed packings with the counts, deviations, porosities and "
                    "coordinations of table 5.3. 2D-5 has the table's 13 x 25 discs of 2 mm, which are 5.2 cm wide; "
                    "its inner region is no whole number of columns.");
                out.notes.emplace_back(
                    "The interior is held to its bound at coordination 10, the default; at the 11 of table 5.3 our packings need "
                    "bonds over larger gaps (beta 0.24), which raise the mean distance to the mid-gap planes. docs/areas.md says more.");
                return out;
            }};
}

} // namespace proveta::verification
