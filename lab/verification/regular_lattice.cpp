// Hexagonal discs whose stiffnesses follow from E and nu (thesis 5.1.5, after Tavarez and Plesha).
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/statics/elastic.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/meshes.hpp"
#include "specimens/lattice.hpp"

namespace proveta::verification {

namespace regular_lattice_case {

constexpr double radius = 0.002;

// Stresses xx and zz under a uniform strain. The border is moved with the strain and held against turning; inside the solve decides.
std::pair<double, double> stress_under(const Mesh& mesh, const Bonds& bonds, double strain_x, double strain_z) {
    const auto full = [&](std::size_t k) { return bonds.incidence.offset[k + 1] - bonds.incidence.offset[k] == 6; };
    std::vector<Support> border;
    double inside = 0.0;
    for (std::size_t k = 0; k < mesh.spheres.size(); ++k) {
        if (full(k)) {
            inside += 1.0;
            continue;
        }
        border.push_back({k, 0, strain_x * mesh.spheres.position.x[k]});
        border.push_back({k, 2, strain_z * mesh.spheres.position.z[k]});
        border.push_back({k, 4, 0.0});
    }
    const ElasticSolution solution = solve_elastic(mesh.spheres, bonds, border);
    // Love-Weber: each disc inside owns half of its six bonds and a hexagon.
    double xx = 0.0;
    double zz = 0.0;
    for (std::size_t b = 0; b < bonds.size(); ++b) {
        const auto i = static_cast<std::size_t>(bonds.i[b]);
        const auto j = static_cast<std::size_t>(bonds.j[b]);
        const Vec3 to = mesh.spheres.position.at(j) - mesh.spheres.position.at(i);
        const double share = 0.5 * ((full(i) ? 1.0 : 0.0) + (full(j) ? 1.0 : 0.0));
        xx += share * solution.bond.x[b] * to.x();
        zz += share * solution.bond.z[b] * to.z();
    }
    const double volume = inside * 2.0 * std::numbers::sqrt3 * radius * radius; // 1 m thick
    return {xx / volume, zz / volume};
}

} // namespace regular_lattice_case

Case regular_lattice() {
    using namespace regular_lattice_case;
    return {"regular-lattice", "5.1.5", "Hexagonal discs with (5.10) under uniform strain give E and nu back.", false, [] {
                Outcome out;
                const Mesh mesh = make_mesh("hexagonal", hexagonal_lattice(12, 13, radius), 0.0);
                constexpr double young = 20e6;
                report::Curve stress_curve{"plane stress", {}, {}, "#1f4e79"};
                report::Curve strain_curve{"plane strain", {}, {}, "#c0392b"};
                const auto check = [&](double nu, bool plane_strain) {
                    const double e_star = plane_strain ? young / (1.0 - nu * nu) : young;
                    const double nu_star = plane_strain ? nu / (1.0 - nu) : nu;
                    const double k_n = e_star / (std::numbers::sqrt3 * (1.0 - nu_star)); // (5.10), for 1 m of thickness
                    const double k_t = (1.0 - 3.0 * nu_star) / (1.0 + nu_star) * k_n;
                    Material m;
                    m.area_rule = AreaRule::truncated_cone; // 2 R, so that k_n = a E
                    m.young_modulus = 1.0;
                    m.poisson_ratio = 0.0;
                    m.normal_factor = k_n;
                    m.shear_factor = 2.0 * k_t;
                    const Bonds bonds = mesh.bonds(m);
                    constexpr double strain = 1e-4;
                    const auto [xx, zx] = stress_under(mesh, bonds, strain, 0.0);
                    const auto [xz, zz] = stress_under(mesh, bonds, 0.0, strain);
                    const double nu_found = xz / xx;
                    const double e_found = (zz - xz * zx / xx) / strain;
                    const std::string name = fmt::format("nu {:.4g}, plane {}", nu, plane_strain ? "strain" : "stress");
                    const double nu_back = plane_strain ? nu_found / (1.0 + nu_found) : nu_found;
                    const double e_back = plane_strain ? e_found * (1.0 - nu_back * nu_back) : e_found;
                    auto& curve = plane_strain ? strain_curve : stress_curve;
                    curve.x.push_back(nu);
                    curve.y.push_back(nu_back);
                    out.checks.push_back({name + ": E", young, e_back, 1e-9, Compare::relative, "Pa"});
                    out.checks.push_back({name + ": nu", nu, nu_back, 1e-9, Compare::absolute});
                };
                for (const double nu : {0.0, 0.1, 0.2, 0.3, 1.0 / 3.0}) {
                    check(nu, false);
                }
                for (const double nu : {0.1, 0.2, 0.25}) {
                    check(nu, true);
                }
                out.plots.push_back(
                    {"Poisson's ratio that a hexagonal lattice gives back.", "nu asked for", "nu found", {stress_curve, strain_curve}, {}});
                out.notes = {"Beyond nu = 1/3 in plane stress and 1/4 in plane strain (5.10) would want a negative k_t."};
                return out;
            }};
}

} // namespace proveta::verification
