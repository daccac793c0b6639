// Ratios of polygons and polyhedra to their inscribed circles and spheres (thesis 5.3, tables 5.1 and 5.2).
#include <array>
#include <cmath>
#include <numbers>

#include "core/bonds/areas.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

using std::numbers::pi;

Case polygon_areas() {
    return {"polygon-areas", "5.3", "Surface of the regular polyhedra and polygons over that of their inscribed sphere and circle.", false,
            [] {
                // Of a solid with n faces that are regular p-gons, q at a vertex.
                const auto closed_form = [](double n, double p, double q) {
                    const double half = std::asin(std::cos(pi / q) / std::sin(pi / p)); // half the dihedral angle
                    const double side = 2.0 * std::tan(pi / p) / std::tan(half);        // of the solid with inscribed radius 1
                    return n * p * side * side / (4.0 * std::tan(pi / p)) / (4.0 * pi);
                };
                Outcome out;
                for (const auto& [n, p, q] :
                     {std::array{4.0, 3.0, 3.0}, {6.0, 4.0, 3.0}, {8.0, 3.0, 4.0}, {12.0, 5.0, 3.0}, {20.0, 3.0, 5.0}}) {
                    out.checks.push_back({std::to_string(static_cast<int>(n)) + " faces", closed_form(n, p, q), polyhedron_ratio(n), 4e-6,
                                          Compare::relative, "", ""});
                }
                // Table 5.2 prints three decimals; a polygon around a circle of radius 1 has half sides tan(pi / n).
                const std::array printed{1.654, 1.273, 1.156, 1.103, 1.073, 1.055, 1.043, 1.034, 1.028, 1.023, 1.020, 1.017};
                for (std::size_t k = 0; k < printed.size(); ++k) {
                    const auto n = static_cast<double>(k + 3);
                    const std::string name = std::to_string(k + 3) + " sides";
                    const double perimeter = 2.0 * n * std::tan(pi / n);
                    out.checks.push_back({name, perimeter / (2.0 * pi), polygon_ratio(n), 1e-12});
                    out.checks.push_back({name + ", as printed", printed[k], polygon_ratio(n), 5.001e-4, Compare::absolute});
                }
                report::Curve solids{"polyhedra, between the solids linear", {}, {}, "#1f4e79"};
                report::Curve polygons{"polygons", {}, {}, "#c0392b"};
                for (double n = 4.0; n <= 30.0; n += 0.5) {
                    solids.x.push_back(n);
                    solids.y.push_back(polyhedron_ratio(n));
                    polygons.x.push_back(n);
                    polygons.y.push_back(polygon_ratio(n));
                }
                out.plots.push_back(
                    {"Surface over that of the inscribed sphere or circle.", "faces or sides", "ratio", {solids, polygons}, {}});
                return out;
            }};
}

} // namespace proveta::verification
