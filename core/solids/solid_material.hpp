// What the calculation needs to know of a deformable body's material.
#pragma once

#include <cstdint>
#include <string>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Constitutive law of a deformable body (thesis 4.2.3).
enum class SolidLaw : std::uint8_t {
    kirchhoff,   ///< St. Venant and Kirchhoff (4.34-4.35): any rotation, small strain
    neo_hookean, ///< (4.37-4.39): any strain
    j2           ///< von Mises plasticity with linear isotropic hardening at any strain (4.40-4.42)
};

/// Lame's constants, Pa (4.38).
struct Lame {
    double lambda, mu;
};

/// Parameters of one material. SI units.
struct SolidMaterial {
    std::string name = "unnamed";
    SolidLaw law = SolidLaw::kirchhoff;
    double density = 1000.0;        ///< in the reference configuration, kg/m3
    double young_modulus = 1.0e6;   ///< at small strain, Pa
    double poisson_ratio = 0.3;     ///< at small strain, below 1/2
    double yield_stress = 0.0;      ///< of j2: true stress at which it yields first, Pa
    double hardening = 0.0;         ///< of j2: slope of true stress against plastic logarithmic strain, Pa
    double mass_damping = 0.0;      ///< Rayleigh's a1 (4.72), 1/s
    double stiffness_damping = 0.0; ///< Rayleigh's a2, s

    [[nodiscard]] Lame lame() const {
        return {young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
                young_modulus / (2.0 * (1.0 + poisson_ratio))};
    }
};

/// Answer of a law to a deformation gradient.
struct SolidResponse {
    Mat3 first_piola = Mat3::Zero(); ///< P, Pa: force on the reference area
    double stored = 0.0;             ///< elastic energy a reference volume, J/m3
    double plastic = 0.0;            ///< plastic work of this step a reference volume, J/m3
};

/// What a material point remembers.
struct PlasticState {
    Mat3 inverse = Mat3::Identity(); ///< inverse of the plastic right Cauchy-Green tensor
    double strain = 0.0;             ///< accumulated plastic strain
};

} // namespace proveta
