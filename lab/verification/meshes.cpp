#include "lab/verification/meshes.hpp"

#include <array>

#include "specimens/lattice.hpp"

namespace proveta::verification {

Bonds Mesh::bonds(const Material& material, const Areas* given) const {
    std::vector<double> weight;
    return make_bonds(spheres, {material}, pairs, skin, weight, given);
}

Mesh make_mesh(std::string name, Specimen specimen, double coordination) {
    Mesh m;
    m.name = std::move(name);
    m.specimen = std::move(specimen);
    m.statistics = statistics(m.specimen);
    m.skin = skin_spheres(m.specimen);
    m.spheres.planar = m.specimen.shape.planar();
    for (std::size_t k = 0; k < m.specimen.size(); ++k) {
        m.spheres.add(m.specimen.spheres.centre.at(k), m.specimen.spheres.radius[k], 2500.0);
    }
    m.pairs = bonded_pairs(m.spheres, {1e-6, coordination}, m.beta);
    m.coordination = 2.0 * static_cast<double>(m.pairs.size()) / static_cast<double>(m.spheres.size());
    return m;
}

Mesh plate_mesh(int k) {
    if (k == 5) {
        return make_mesh("2D-5", square_lattice(13, 25, 0.002), 0.0);
    }
    struct Row {
        std::int64_t discs;
        double deviation, coordination, porosity;
    };
    constexpr std::array<Row, 4> table{
        {{2260, 0.4565, 5.08, 0.1104}, {1262, 0.3116, 5.14, 0.0939}, {725, 0.1024, 5.24, 0.0677}, {1343, 0.0923, 5.79, 0.1114}}};
    const Row& row = table.at(static_cast<std::size_t>(k - 1));
    SpecimenRecipe r;
    r.shape = "plate";
    r.width = 0.05;
    r.height = 0.1;
    r.spheres = row.discs;
    r.porosity = {row.porosity, ""};
    r.radius_deviation = row.deviation;
    r.smallest_radius = 0.2; // wide enough for the largest deviation
    r.largest_radius = 2.5;
    return make_mesh("2D-" + std::to_string(k), make_specimen(r), row.coordination);
}

Mesh cylinder_mesh(int k) {
    SpecimenRecipe r;
    r.spheres = k == 1 ? 10511 : 13500;
    r.porosity = {k == 1 ? 0.2544 : 0.2573, ""};
    r.radius_deviation = k == 1 ? 0.2525 : 0.2583;
    return make_mesh("3D-" + std::to_string(k), make_specimen(r), k == 1 ? 10.98 : 10.97);
}

Mesh small_cylinder(std::int64_t spheres, std::int64_t seed) {
    SpecimenRecipe r;
    r.spheres = spheres;
    r.seed = seed;
    return make_mesh(std::to_string(spheres) + " spheres", make_specimen(r), 10.0);
}

} // namespace proveta::verification
