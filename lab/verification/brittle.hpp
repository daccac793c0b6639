// A material for cases and tests about the machine: its strengths do not depend on how tough its bonds are, nor on what a card of the
// program is calibrated to.
#pragma once

#include "core/input/json.hpp"

namespace proveta::verification {

/// Strengths of table 5.5 (thesis) times 1.195, bonds that soften by ratio: specimens of spheres of any size may be pressed.
inline input::Json brittle_strengths() {
    return {{"strength_factor", 1.195},
            {"card", "custom"},
            {"sigma_f", "5 MPa"},
            {"tau_f", "16 MPa"},
            {"mu_s", 0.9},
            {"mu_d", 0.25},
            {"fracture_energy_tension", 0},
            {"fracture_energy_shear", 0},
            {"lcs", {"20 MPa", "45 MPa", "70 MPa"}},
            {"yrc", {3, 12, 22}}};
}

/// The same with the elasticity of bonds as given: a concrete of some 28 GPa and 33 MPa on 13,500 spheres.
inline input::Json brittle_concrete() {
    input::Json material = brittle_strengths();
    material.update({{"elasticity", "as-given"}, {"normal_factor", 1.407}, {"shear_factor", 1.407}});
    return material;
}

} // namespace proveta::verification
