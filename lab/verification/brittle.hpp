// A material for cases and tests about the machine: its strengths do not depend on how tough its bonds are.
#pragma once

#include "core/input/json.hpp"

namespace proveta::verification {

/// Changes to concrete_sfer that make it a brittle concrete, some 33 MPa strong, whose bonds take the card's elasticity as given and soften
/// by ratio: it may be pressed on specimens of any size of spheres.
inline input::Json brittle_concrete() {
    return {{"elasticity", "as-given"}, {"normal_factor", 1.407}, {"shear_factor", 1.407},        {"strength_factor", 1.195},
            {"sigma_f", "5 MPa"},       {"tau_f", "16 MPa"},      {"fracture_energy_tension", 0}, {"fracture_energy_shear", 0}};
}

} // namespace proveta::verification
