// Loose specimens: from a bed of stones or spheres to what the calculation needs, and what their stiffness is about.
#pragma once

#include "lab/network.hpp"

namespace proveta {

/// Particles without bonds: the spheres, and the stones as clusters.
Network make_loose(const Deck& deck, const Specimen& specimen);

/// Elastic moduli of a random pack of equal spheres that do not slip, under a pressure in Pa (K. Walton, J. Mech. Phys. Solids 35 (1987)
/// 213-226, with Hertz's contacts; with linear ones the same mean field): an estimate that servos and ramps are scaled by.
struct PackModuli {
    double bulk, shear; ///< Pa

    [[nodiscard]] double young() const { return 9.0 * bulk * shear / (3.0 * bulk + shear); }
    [[nodiscard]] double poisson() const { return (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)); }
};
PackModuli pack_moduli(const Material& material, double porosity, double coordination, double pressure);

} // namespace proveta
