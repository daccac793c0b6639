#include "lab/granular.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace proveta {

Network make_loose(const Deck& deck, const Specimen& specimen) {
    Network out;
    out.materials = {to_material(deck.material.values)};
    const double density = out.materials.front().density;
    if (specimen.stones.empty()) {
        out.spheres = make_spheres(specimen, deck, out.materials);
    }
    out.spheres.packed = true; // the bed's overlaps are those of other moduli than the card's
    std::int64_t number = 0;
    for (const auto& stone : specimen.stones) {
        const ClusterShape shape = scaled(specimen.forms[static_cast<std::size_t>(stone.form)], stone.size);
        const std::size_t first = out.spheres.size();
        out.clusters.add(out.spheres, shape, density, stone.position, stone.attitude);
        std::fill(out.spheres.id.begin() + static_cast<std::ptrdiff_t>(first), out.spheres.id.end(), number);
        ++number;
    }
    out.skin.assign(out.spheres.size(), 0);
    out.bonds = make_bonds(out.spheres, out.materials, {}, out.skin, out.weight);
    return out;
}

PackModuli pack_moduli(const Material& m, double porosity, double coordination, double pressure) {
    const double filled = (1.0 - porosity) * coordination;
    if (m.contact_law == ContactLaw::linear) { // k_n = E pi R / 2, k_t / k_n = 1/(2 (1 + nu)): no pressure in it
        const double bulk = filled * m.normal_factor * m.young_modulus / 24.0;
        const double ratio = 1.0 / (2.0 * (1.0 + m.poisson_ratio));
        return {bulk, bulk * 0.6 * (1.0 + 1.5 * ratio)};
    }
    const double shear = m.young_modulus / (2.0 * (1.0 + m.poisson_ratio));
    const double cube = std::pow(filled * shear / (1.0 - m.poisson_ratio), 2) * pressure / std::pow(std::numbers::pi, 2);
    return {std::cbrt(cube / 18.0), (5.0 - 4.0 * m.poisson_ratio) / (5.0 * (2.0 - m.poisson_ratio)) * std::cbrt(1.5 * cube)};
}

} // namespace proveta
