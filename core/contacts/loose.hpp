// One loose contact, whichever law it follows: its constants from two materials, one step of it, and how stiff it may become.
#pragma once

#include "core/contacts/hertz_law.hpp"
#include "core/contacts/linear_law.hpp"
#include "core/contacts/loose_contact.hpp"
#include "core/laws/material.hpp"

namespace proveta {

/// What a contact of two materials needs, whatever the sizes of the spheres. Worked out once a pair of materials.
struct LoosePair {
    ContactLaw law = ContactLaw::linear;
    bool tension = false;
    AreaRule area_rule = AreaRule::virtual_polyhedron;
    double axial = 0.0;       ///< a E of the linear law, Pa
    double shear_ratio = 0.0; ///< k_t / k_n of the linear law
    double young = 0.0;       ///< E* of the Hertzian law (2.40c), Pa
    double shear = 0.0;       ///< G* of the Hertzian law (2.40d), Pa
    double damping = 0.0;     ///< xi
    double friction = 0.0;    ///< mu
    double rolling = 0.0;     ///< eta_r
};

/// Spheres of materials a and b, symmetric in both.
LoosePair loose_pair(const Material& a, const Material& b);

/// A sphere's material against a wall's. The friction is that of this pair of surfaces; the wall moves sideways much less than the sphere,
/// so its shear modulus counts as infinite (2.41d). A wall of infinite Young's modulus is rigid.
LoosePair wall_pair(const Material& sphere, const Material& wall, double friction);

/// What a contact needs to know of a sphere: m, kg, kg m2.
struct LooseBody {
    double radius, mass, inertia;
};

/// Contact of two spheres; area in m2 is that of the linear law, over the distance at touch.
LooseContact loose_contact(const LoosePair& pair, const LooseBody& i, const LooseBody& j, double area);

/// Contact of a sphere of the given section, m2, with a wall (2.41). The linear law sees the wall as a mirror image made of the wall's
/// material.
LooseContact wall_contact(const LoosePair& pair, const LooseBody& sphere, double section);

/// One step; see `linear::advance`.
inline contact::Response<double> advance(const LooseContact& c, double overlap, double approach, const ContactStep& step,
                                         const double (&slip)[3], contact::State<double>& state) {
    if (c.law == ContactLaw::hertz) {
        return hertz::advance<double>({c.k_n, c.k_t, c.c_n, c.c_t, c.friction, c.tension, step.impacts, c.reduced_mass}, overlap, approach,
                                      step.elapsed, slip, state);
    }
    return linear::advance<double>({c.k_n, c.k_t, c.c_n, c.c_t, c.friction, c.tension, step.impacts, c.reduced_mass}, overlap, approach,
                                   step.elapsed, slip, state);
}

/// Energy of the springs at an overlap and an elastic tangential displacement in m, J.
double stored_energy(const LooseContact& c, double overlap, double slip);

/// Tangent stiffnesses (N/m) and dashpots (N s/m), which grow with the overlap, at an overlap in m.
struct Stiffness {
    double k_n, k_t, c_n, c_t;
};
Stiffness stiffness_at(const LooseContact& c, double overlap);

} // namespace proveta
