// What the physics needs to know of a material: the numbers of a card, without its paper.
#pragma once

#include <cstdint>
#include <string>

#include "core/contacts/loose_contact.hpp"
#include "core/laws/bond_laws.hpp"

namespace proveta {

/// Rule that gives the effective area of a bond (model: effective areas; thesis 5.1.3, 5.3).
/// laguerre areas are not computed here: `make_bonds` is given them.
enum class AreaRule { minimum_radius, truncated_cone, virtual_polyhedron, laguerre };

/// How a restitution becomes a dashpot: by (2.21), or so that the law as it runs, which never pulls, gives it back.
enum class RestitutionRule : std::uint8_t { corrected, nominal };

/// Rules that turn the material of a card into bonds, contacts and masses. SI units.
struct Material {
    std::string name = "unnamed";
    double density = 2500.0;          ///< of a sphere, kg/m3
    double young_modulus = 28.0e9;    ///< E0 of the bond, Pa
    double poisson_ratio = 0.2;       ///< of the bond: G = E / (2 (1 + nu))
    double normal_factor = 1.0;       ///< a in k_n = a E A / L (5.34)
    double shear_factor = 1.0;        ///< b in k_t = b G A / L
    double averaged_factor = 0.0;     ///< lambda / (a E): averaged part of the stress (dilatation.hpp); 0: none
    double local_damping = 0.0;       ///< xi of the dashpot c_n = 2 xi sqrt(m_eq k_n) in each bond
    double contact_restitution = 0.2; ///< normal restitution of new contacts
    RestitutionRule restitution_rule = RestitutionRule::corrected;
    ContactLaw contact_law = ContactLaw::linear;
    double mu_d = 0.25;            ///< Coulomb friction of failed bonds and of new contacts
    double rolling_friction = 0.0; ///< eta_r (2.42)
    bool contact_tension = false;  ///< loose contacts may pull: for comparison with closed forms only
    AreaRule area_rule = AreaRule::virtual_polyhedron;
    double area_factor = 1.0;                    ///< global alpha on the areas (5.4-5.6)
    BondParameters bond = Dempack::Parameters{}; ///< law of the bonds
    Criterion criterion = Criterion::bond;       ///< an averaged one takes its strengths from the law dempack
    double bending = 0.0;                        ///< f_b
    double twisting = 0.0;                       ///< f_t

    /// k_t / k_n = b / (2 (1 + nu) a) (5.17).
    [[nodiscard]] double shear_ratio() const { return shear_factor / (normal_factor * 2.0 * (1.0 + poisson_ratio)); }
    /// Parameters of the law, which must be the one that the bonds have.
    template <class Law> [[nodiscard]] typename Law::Parameters& as() { return std::get<typename Law::Parameters>(bond); }
    template <class Law> [[nodiscard]] const typename Law::Parameters& as() const { return std::get<typename Law::Parameters>(bond); }
};

/// What bonds of one material obey. With an averaged criterion the law's own strengths are infinite.
BondGroup bond_group(const Material& material);

/// Material of a pair (2.40 in spirit): moduli in series, the lower strength and friction, the mean of the rest; of two laws, contact laws
/// or restitution rules the first one. Symmetric in a and b; of two equal materials it is that material.
Material equivalent(const Material& a, const Material& b);

} // namespace proveta
