#include "core/bonds/material.hpp"

#include <algorithm>
#include <limits>

namespace proveta {

BondLaw bond_law(const Material& material) {
    BondLaw law = material.bond;
    law.shear_ratio = material.shear_factor / (material.normal_factor * 2.0 * (1.0 + material.poisson_ratio));
    law.opening_f = material.fracture_energy_n > 0.0 && law.sigma_f > 0.0 ? 2.0 * material.fracture_energy_n / law.sigma_f : 0.0;
    law.slip_f = material.fracture_energy_t > 0.0 && law.tau_f > 0.0 ? 2.0 * material.fracture_energy_t / law.tau_f : 0.0;
    if (law.criterion != Criterion::bond) {
        law.averaged_sigma_f = law.sigma_f;
        law.averaged_tau_f = law.tau_f;
        law.sigma_f = std::numeric_limits<double>::infinity();
        law.tau_f = law.sigma_f;
    }
    return law;
}

namespace {

double in_series(double a, double b) { return 2.0 * a * b / (a + b); }
double mean(double a, double b) { return 0.5 * (a + b); }

} // namespace

Material equivalent(const Material& a, const Material& b) {
    Material m = a;
    if (a.name != b.name) {
        m.name = std::min(a.name, b.name) + "/" + std::max(a.name, b.name);
    }
    m.young_modulus = in_series(a.young_modulus, b.young_modulus);
    m.poisson_ratio = mean(a.poisson_ratio, b.poisson_ratio);
    m.normal_factor = mean(a.normal_factor, b.normal_factor);
    m.shear_factor = mean(a.shear_factor, b.shear_factor);
    m.local_damping = mean(a.local_damping, b.local_damping);
    m.contact_restitution = mean(a.contact_restitution, b.contact_restitution);
    m.restitution_rule = std::min(a.restitution_rule, b.restitution_rule);
    m.contact_law = std::min(a.contact_law, b.contact_law);
    m.rolling_friction = std::min(a.rolling_friction, b.rolling_friction);
    m.contact_tension = a.contact_tension && b.contact_tension;
    m.area_factor = mean(a.area_factor, b.area_factor);
    m.bond.sigma_f = std::min(a.bond.sigma_f, b.bond.sigma_f);
    m.bond.tau_f = std::min(a.bond.tau_f, b.bond.tau_f);
    m.bond.mu_s = std::min(a.bond.mu_s, b.bond.mu_s);
    m.bond.mu_d = std::min(a.bond.mu_d, b.bond.mu_d);
    m.fracture_energy_n = std::min(a.fracture_energy_n, b.fracture_energy_n);
    m.fracture_energy_t = std::min(a.fracture_energy_t, b.fracture_energy_t);
    m.bond.yield_stress = std::min(a.bond.yield_stress, b.bond.yield_stress);
    m.bond.plastic_ratio = mean(a.bond.plastic_ratio, b.bond.plastic_ratio);
    m.bond.shear_energy = mean(a.bond.shear_energy, b.bond.shear_energy);
    m.bond.bending = mean(a.bond.bending, b.bond.bending);
    m.bond.twisting = mean(a.bond.twisting, b.bond.twisting);
    m.bond.softening_n = mean(a.bond.softening_n, b.bond.softening_n);
    m.bond.softening_t = mean(a.bond.softening_t, b.bond.softening_t);
    for (int k = 0; k < 3; ++k) {
        m.bond.lcs[k] = std::min(a.bond.lcs[k], b.bond.lcs[k]);
        m.bond.yrc[k] = mean(a.bond.yrc[k], b.bond.yrc[k]);
    }
    return m;
}

} // namespace proveta
