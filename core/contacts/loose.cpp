#include "core/contacts/loose.hpp"

#include <algorithm>
#include <cmath>

#include "core/contacts/restitution.hpp"

namespace proveta {

namespace {

double shear_modulus(const Material& m) { return m.young_modulus / (2.0 * (1.0 + m.poisson_ratio)); }

// xi of the law's own normalisation. A contact that may pull follows (2.21) exactly.
double damping_ratio(const Material& m) {
    const bool nominal = m.restitution_rule == RestitutionRule::nominal;
    const double xi =
        nominal || m.contact_tension ? restitution::ratio_pulling(m.contact_restitution) : restitution::ratio_cut(m.contact_restitution);
    return m.contact_law == ContactLaw::hertz && !nominal ? restitution::hertz_factor * xi : xi;
}

// The two laws' dashpots follow from their stiffnesses in the same way.
LooseContact damped(LooseContact c, double xi, double reduced_mass) {
    c.c_n = 2.0 * xi * std::sqrt(reduced_mass * c.k_n);
    c.c_t = 2.0 * xi * std::sqrt(reduced_mass * c.k_t);
    c.reduced_mass = reduced_mass;
    return c;
}

} // namespace

LoosePair loose_pair(const Material& a, const Material& b) {
    const Material m = equivalent(a, b);
    LoosePair p;
    p.law = m.contact_law;
    p.tension = m.contact_tension;
    p.area_rule = m.area_rule;
    p.axial = m.normal_factor * m.young_modulus;
    p.shear_ratio = m.shear_ratio();
    const auto compliance = [](const Material& x) { return (1.0 - x.poisson_ratio * x.poisson_ratio) / x.young_modulus; };
    p.young = 1.0 / (compliance(a) + compliance(b));
    p.shear = 1.0 / ((2.0 - a.poisson_ratio) / shear_modulus(a) + (2.0 - b.poisson_ratio) / shear_modulus(b));
    p.damping = damping_ratio(m);
    p.friction = m.mu_d;
    p.rolling = m.rolling_friction;
    return p;
}

LoosePair wall_pair(const Material& sphere, const Material& wall, double friction) {
    LoosePair p = loose_pair(sphere, wall);
    p.axial = 0.5 * (sphere.normal_factor + wall.normal_factor) * 2.0 / (1.0 / sphere.young_modulus + 1.0 / wall.young_modulus);
    p.shear_ratio = sphere.shear_ratio();
    p.shear = shear_modulus(sphere) / (2.0 - sphere.poisson_ratio);
    p.friction = friction;
    return p;
}

LooseContact loose_contact(const LoosePair& pair, const LooseBody& i, const LooseBody& j, double area) {
    LooseContact c;
    c.law = pair.law;
    c.tension = pair.tension;
    c.friction = pair.friction;
    c.rolling_arm = pair.rolling * std::min(i.radius, j.radius);
    c.reduced_inertia = i.inertia * j.inertia / (i.inertia + j.inertia);
    if (pair.law == ContactLaw::hertz) {
        const double root = std::sqrt(i.radius * j.radius / (i.radius + j.radius));
        c.k_n = 2.0 * pair.young * root;
        c.k_t = 8.0 * pair.shear * root;
    } else {
        c.k_n = pair.axial * area / (i.radius + j.radius);
        c.k_t = pair.shear_ratio * c.k_n;
    }
    return damped(c, pair.damping, i.mass * j.mass / (i.mass + j.mass));
}

LooseContact wall_contact(const LoosePair& pair, const LooseBody& sphere, double section) {
    LooseContact c;
    c.law = pair.law;
    c.tension = pair.tension;
    c.friction = pair.friction;
    c.rolling_arm = pair.rolling * sphere.radius;
    c.reduced_inertia = sphere.inertia;
    if (pair.law == ContactLaw::hertz) {
        c.k_n = 2.0 * pair.young * std::sqrt(sphere.radius);
        c.k_t = 8.0 * pair.shear * std::sqrt(sphere.radius);
    } else {
        c.k_n = pair.axial * section / (2.0 * sphere.radius);
        c.k_t = pair.shear_ratio * c.k_n;
    }
    return damped(c, pair.damping, sphere.mass);
}

double stored_energy(const LooseContact& c, double overlap, double slip) {
    if (overlap <= 0.0) {
        return 0.0;
    }
    // 2/5 of F_n delta for Hertz's law, half of it for the linear one.
    const double share = c.law == ContactLaw::hertz ? 0.4 * 2.0 / 3.0 : 0.5;
    const Stiffness k = stiffness_at(c, overlap);
    return share * k.k_n * overlap * overlap + 0.5 * k.k_t * slip * slip;
}

Stiffness stiffness_at(const LooseContact& c, double overlap) {
    if (c.law == ContactLaw::linear) {
        return {c.k_n, c.k_t, c.c_n, c.c_t};
    }
    const double root = std::sqrt(std::max(overlap, 0.0));
    const double fourth_root = std::sqrt(root);
    return {c.k_n * root, c.k_t * root, c.c_n * fourth_root, c.c_t * fourth_root};
}

} // namespace proveta
