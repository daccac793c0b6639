#include "core/laws/material.hpp"

#include <algorithm>
#include <limits>

namespace proveta {

double BondGroup::tensile_limit() const {
    return criterion.kind == Criterion::bond ? std::visit([](const auto& c) { return LawOf<decltype(c)>::tensile_limit(c); }, law)
                                             : criterion.sigma_f;
}

BondGroup bond_group(const Material& material) {
    BondGroup group;
    const BondBasis basis{material.normal_factor * material.young_modulus, material.shear_ratio(), material.mu_d};
    group.law = std::visit([&](const auto& p) -> BondConstants { return LawOf<decltype(p)>::constants(p, basis); }, material.bond);
    group.beams = {material.bending, material.twisting, basis.shear_ratio};
    std::visit(
        [&](const auto& p) {
            using Law = LawOf<decltype(p)>;
            if constexpr (Law::asks_volumetric_strain) {
                group.volumetric = Law::uses_volumetric_strain(p);
            }
        },
        material.bond);
    if (auto* law = std::get_if<Dempack::Constants>(&group.law); law != nullptr && material.criterion != Criterion::bond) {
        group.criterion = {material.criterion, law->sigma_f, law->tau_f, law->mu_s};
        law->sigma_f = std::numeric_limits<double>::infinity();
        law->tau_f = law->sigma_f;
    }
    return group;
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
    m.mu_d = std::min(a.mu_d, b.mu_d);
    m.bending = mean(a.bending, b.bending);
    m.twisting = mean(a.twisting, b.twisting);
    if (a.bond.index() == b.bond.index()) {
        m.bond = std::visit(
            [&](const auto& p) -> BondParameters {
                using Parameters = std::remove_cvref_t<decltype(p)>;
                return LawOf<Parameters>::mix(p, std::get<Parameters>(b.bond));
            },
            a.bond);
    } else {
        m.bond = a.bond.index() < b.bond.index() ? a.bond : b.bond;
    }
    return m;
}

} // namespace proveta
