// What the bond laws compute once for a material or a pair of materials.
#include "core/laws/bond_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace proveta {

namespace {

// What the laws with an envelope of three corners share.
template <class P> void mix_envelope(P& m, const P& a, const P& b) {
    m.sigma_f = std::min(a.sigma_f, b.sigma_f);
    m.tau_f = std::min(a.tau_f, b.tau_f);
    m.mu_s = std::min(a.mu_s, b.mu_s);
    m.softening_n = std::midpoint(a.softening_n, b.softening_n);
    for (int k = 0; k < 3; ++k) {
        m.lcs[k] = std::min(a.lcs[k], b.lcs[k]);
        m.yrc[k] = std::midpoint(a.yrc[k], b.yrc[k]);
    }
}

template <class P> void scale_envelope(P& p, double factor) {
    p.sigma_f *= factor;
    p.tau_f *= factor;
    for (double& stress : p.lcs) {
        stress *= factor;
    }
}

} // namespace

Dempack::Parameters Dempack::mix(const Parameters& a, const Parameters& b) {
    Parameters m = a;
    mix_envelope(m, a, b);
    m.softening_t = std::midpoint(a.softening_t, b.softening_t);
    m.fracture_energy_n = std::min(a.fracture_energy_n, b.fracture_energy_n);
    m.fracture_energy_t = std::min(a.fracture_energy_t, b.fracture_energy_t);
    return m;
}

Dempack::Parameters Dempack::scaled(Parameters p, double factor) {
    scale_envelope(p, factor);
    return p;
}

Dempack::Constants Dempack::constants(const Parameters& p, const BondBasis& basis) {
    Constants c{p, basis, 0.0, 0.0};
    c.opening_f = p.fracture_energy_n > 0.0 && p.sigma_f > 0.0 ? 2.0 * p.fracture_energy_n / p.sigma_f : 0.0;
    c.slip_f = p.fracture_energy_t > 0.0 && p.tau_f > 0.0 ? 2.0 * p.fracture_energy_t / p.tau_f : 0.0;
    return c;
}

KratosDempack::Parameters KratosDempack::mix(const Parameters& a, const Parameters& b) {
    Parameters m = a;
    mix_envelope(m, a, b);
    m.yield_stress = std::min(a.yield_stress, b.yield_stress);
    m.plastic_ratio = std::midpoint(a.plastic_ratio, b.plastic_ratio);
    m.shear_energy = std::midpoint(a.shear_energy, b.shear_energy);
    return m;
}

KratosDempack::Parameters KratosDempack::scaled(Parameters p, double factor) {
    scale_envelope(p, factor);
    p.yield_stress *= factor;
    return p;
}

Facet::Parameters Facet::mix(const Parameters& a, const Parameters& b) {
    Parameters m = a;
    // Strengths, fracture energies and frictions: the lower; shapes of curves: the mean.
    for (double Parameters::*weaker : {&Parameters::sigma_t, &Parameters::sigma_c0, &Parameters::mu_0, &Parameters::mu_inf}) {
        m.*weaker = std::min(a.*weaker, b.*weaker);
    }
    const auto cohesion = [](const Parameters& p) { return p.shear_ratio_t * p.sigma_t; };
    const auto energy = [](const Parameters& p) { return p.sigma_t * p.sigma_t * p.length_t; }; // times 2 E0
    m.shear_ratio_t = std::min(cohesion(a), cohesion(b)) / m.sigma_t;
    m.length_t = std::min(energy(a), energy(b)) / (m.sigma_t * m.sigma_t);
    for (double Parameters::*shape : {&Parameters::exponent, &Parameters::softening_s, &Parameters::first_length, &Parameters::tail,
                                      &Parameters::hardening, &Parameters::transition, &Parameters::kappa_c1, &Parameters::kappa_c2,
                                      &Parameters::kappa_c3, &Parameters::coupling, &Parameters::sigma_n0, &Parameters::cohesion_loss}) {
        m.*shape = std::midpoint(a.*shape, b.*shape);
    }
    if (a.first_length == 0.0 || b.first_length == 0.0) {
        m.first_length = 0.0; // one of them has a single stage
    }
    // The wider scatter.
    const auto scatter = [](const Parameters& p) { // comes first of two that is wider, then longer
        return std::tuple(p.weibull_modulus == 0.0, p.weibull_modulus, -p.correlation_length);
    };
    const Parameters& wider = scatter(a) <= scatter(b) ? a : b;
    m.weibull_modulus = wider.weibull_modulus;
    m.correlation_length = wider.correlation_length;
    return m;
}

Facet::Parameters Facet::scaled(Parameters p, double factor) {
    p.sigma_t *= factor;
    p.sigma_c0 *= factor;
    p.sigma_n0 *= factor;
    return p;
}

Facet::Constants Facet::constants(const Parameters& p, const BondBasis& basis) {
    Constants c;
    static_cast<Parameters&>(c) = p;
    static_cast<BondBasis&>(c) = basis;
    c.sigma_s = p.shear_ratio_t * p.sigma_t;
    c.per_sigma_t = 1.0 / c.sigma_t;
    c.per_sigma_s = 1.0 / c.sigma_s;
    c.shear_softening = basis.shear_ratio > 0.0 ? p.softening_s / basis.shear_ratio : 0.0;
    if (p.first_length > 0.0) {
        const double ratio = std::max(p.length_t / p.first_length, 1.0 / 0.99) - 1.0;
        c.first_slope = 2.0 / ratio;
        c.first_energy = (1.0 - p.tail) * ratio;
        c.tail_rate = p.tail * ratio;
    }
    c.first_end = -std::log(p.tail);
    c.root_alpha = std::sqrt(basis.shear_ratio);
    c.e_c0 = p.sigma_c0 / basis.young_modulus;
    c.e_c1 = p.transition * c.e_c0;
    c.e_v0 = p.kappa_c3 * c.e_c0;
    c.modulus_c = p.hardening * basis.young_modulus;
    return c;
}

double Facet::longest_bond(const Constants& c) {
    return c.first_length > 0.0 ? c.length_t / (1.0 + 1.01 * c.first_energy) : 0.99 * c.length_t;
}

} // namespace proveta
