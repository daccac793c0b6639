#include "lab/elastic/press.hpp"

#include <cmath>

#include "core/geometry/linear_field.hpp"

namespace proveta {

MacroElasticity press_elastically(const Shape& shape, const Spheres& spheres, const Bonds& bonds, const ElasticOptions& options) {
    const double travel = 1e-4 * shape.height; // linear: any value does
    std::vector<Support> supports;
    std::vector<std::size_t> lower;
    std::size_t upper = 0;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const double z = spheres.position.z[k];
        if (z <= 1.1 * spheres.radius[k]) {
            supports.push_back({k, 2, 0.0});
            lower.push_back(k);
        } else if (shape.height - z <= 1.1 * spheres.radius[k]) {
            supports.push_back({k, 2, -travel});
            ++upper;
        }
    }
    if (lower.size() < 2 || upper == 0) {
        throw std::invalid_argument("no spheres at the ends");
    }
    // What is left of rigid motion: along x, and in space along y and about z. Held at the lower end without any reaction.
    supports.push_back({lower.front(), 0, 0.0});
    if (!spheres.planar) {
        const Vec3 first = spheres.position.at(lower.front());
        std::size_t far = lower.front();
        double reach = 0.0;
        for (const auto k : lower) {
            if (std::fabs(spheres.position.x[k] - first.x()) > reach) {
                reach = std::fabs(spheres.position.x[k] - first.x());
                far = k;
            }
        }
        supports.push_back({lower.front(), 1, 0.0});
        supports.push_back({far, 1, 0.0});
    }
    const ElasticSolution solution = solve_elastic(spheres, bonds, supports, options);

    double force = 0.0; // on the lower end
    for (const auto k : lower) {
        force += solution.force.z[k];
    }
    // Least squares: u = a + G x, over the spheres that their bonds can hold without shear; others may swing.
    const std::uint32_t enough = spheres.planar ? 3 : 4;
    const Shape::Region gauge = shape.inner(0.8, 0.6);
    LinearField field;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const Vec3 p = spheres.position.at(k);
        const auto held_by = bonds.incidence.offset[k + 1] - bonds.incidence.offset[k];
        if (held_by >= enough && gauge.contains(p)) {
            field.add(p - Vec3(0.0, 0.0, 0.5 * shape.height), solution.displacement.at(k));
        }
    }
    const Mat3 slopes = field.slopes(spheres.planar);
    const double axial = slopes(2, 2);
    const double lateral = spheres.planar ? slopes(0, 0) : 0.5 * (slopes(0, 0) + slopes(1, 1));
    return {-force / shape.section() / axial, -lateral / axial, solution.iterations};
}

} // namespace proveta
