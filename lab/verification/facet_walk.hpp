// A single facet on a walk through strains, and its stresses as the papers write them (CSL and LDPM; docs/theory.md).
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "core/laws/bond_laws.hpp"

namespace proveta::verification::facet_bond_case {

inline constexpr double e_0 = 35.0e9;  // Pa
inline constexpr double alpha = 0.36;  // k_t / k_n
inline constexpr double area = 5.0e-5; // m2

inline Facet::Parameters concrete() {
    Facet::Parameters p; // the default's, with the exponent of which the power is tried and both parts of the softening modulus
    p.softening_s = 0.01;
    p.coupling = 1.0; // by the facet's own strain, but where a path says otherwise
    p.cohesion_loss = 1.0;
    return p;
}

// A facet that is moved to absolute strains, with its work and its losses on record.
struct Walk {
    Facet::Constants c;
    double length;
    Facet::State<double> s{{0, 0, 0}, 0, 0, 0};
    BondResponse<double> r{};
    BondMotion<double> m{};
    double u = 0.0;    // elongation
    double slip = 0.0; // along x
    double work = 0.0, damage = 0.0, plastic = 0.0, friction = 0.0;
    double volumetric = 0.0;

    double strength = 1.0; // of this facet over the card's

    explicit Walk(const Facet::Parameters& p, double l = 0.0077) : c(Facet::constants(p, {e_0, alpha, 0.25})), length(l) {}

    [[nodiscard]] BondShape<double> bond() const { return {e_0 * area / length, area, length, volumetric, strength}; }
    [[nodiscard]] double s_n() const { return -r.normal / area; } // tension positive
    [[nodiscard]] double s_t() const { return r.shear[0] / area; }
    [[nodiscard]] double lost() const { return damage + plastic + friction; }
    [[nodiscard]] double stored() const { return Facet::stored_energy<double>(c, bond(), m, r.normal, s); }

    /// Goes straight to strains (e_n, e_t) in `steps` and calls `at` after each.
    [[gnu::noinline]] void to(double e_n, double e_t, int steps, const std::function<void()>& at = nullptr) {
        const double u0 = u;
        const double slip0 = slip;
        for (int k = 1; k <= steps; ++k) {
            const auto before = r;
            const double next = k == steps ? e_n * length : u0 + (e_n * length - u0) * k / steps;
            const double next_slip = k == steps ? e_t * length : slip0 + (e_t * length - slip0) * k / steps;
            m = {-next, u - next, {next_slip - slip, 0.0, 0.0}};
            r = Facet::advance<double>(c, bond(), m, s);
            work += 0.5 * ((before.normal + r.normal) * m.approach + (before.shear[0] + r.shear[0]) * m.slip[0]);
            u = next;
            slip = next_slip;
            damage += r.damage_work;
            plastic += r.plastic_work;
            friction += r.friction_work;
            if (at) {
                at();
            }
        }
    }
};

// s_0 as the papers write it; w between shear, 0, and tension, pi / 2.
inline double papers_strength(const Facet::Parameters& p, double w) {
    if (w == 0.5 * std::numbers::pi) {
        return p.sigma_t; // the limit of a quotient of zeros
    }
    const double q = 2.0 * alpha * std::pow(std::cos(w) / p.shear_ratio_t, 2.0);
    return p.sigma_t * (-std::sin(w) + std::sqrt(std::pow(std::sin(w), 2.0) + 2.0 * q)) / q;
}

// Effective stress under proportional loading at effective strain e, from the papers' exponentials.
inline double papers_stress(const Facet::Parameters& p, double length, double w, double e) {
    const double s_0 = papers_strength(p, w);
    const double x = e - s_0 / e_0;
    if (x <= 0.0) {
        return e_0 * e;
    }
    const double g = std::pow(2.0 * w / std::numbers::pi, p.exponent);
    const double tail = 1.0 - p.tail;
    // l_0, longer where the facet is so long that the tail would have less than a hundredth of the first stage's energy
    const double l_0 = std::max(p.first_length, p.length_t / (1.0 + (p.length_t / length - 1.0) / (1.01 * tail)));
    const double of_length = p.first_length > 0.0 ? l_0 : length;
    const double h_s = p.softening_s * e_0 / alpha;
    const double h_1 = h_s + (2.0 * e_0 / (p.length_t / of_length - 1.0) - h_s) * g;
    if (p.first_length <= 0.0) {
        return s_0 * std::exp(-h_1 * x / s_0);
    }
    const double x_1 = -s_0 * std::log(p.tail) / h_1;
    const double spare = p.length_t / length - 1.0 - tail * (p.length_t / l_0 - 1.0);
    // the tail is to the first stage in every direction what it is in pure tension
    const double h_2 = h_1 * p.tail * p.tail * (p.length_t / l_0 - 1.0) / spare;
    return x < x_1 ? s_0 * std::exp(-h_1 * x / s_0) : p.tail * s_0 * std::exp(-h_2 * (x - x_1) / (p.tail * s_0));
}

} // namespace proveta::verification::facet_bond_case
