// A row of bonded spheres with bending and twisting stiffness is a beam.
#include <cmath>
#include <numbers>

#include "core/model.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/unbreakable.hpp"

namespace proveta::verification {

namespace bonded_cantilever_case {

constexpr double r = 0.01; // m
constexpr double young = 1e9;
constexpr double poisson = 0.25;
constexpr double kappa = 0.9; // shear correction of a round section, given to the bonds as b

struct Tip {
    double deflection = 0.0; // m
    double twist = 0.0;      // rad
    std::vector<Vec3> moved;
};

// Row of n bonds along x, held at the first sphere, with a force and a torque at the last; brought to rest by damping.
Tip load(int n, const Vec3& force, const Vec3& torque) {
    Material m = unbreakable(young);
    m.poisson_ratio = poisson;
    m.shear_factor = kappa;
    m.area_rule = AreaRule::truncated_cone;
    m.bending = 1.0;
    m.twisting = 1.0 / kappa; // it stands on k_t, which has kappa in it
    Spheres s;
    std::vector<Pair> pairs;
    for (int k = 0; k <= n; ++k) {
        s.add({2.0 * r * k, 0, 0}, r, 2500.0);
        if (k > 0) {
            pairs.push_back({k - 1, k});
        }
    }
    std::vector<double> weight;
    Bonds bonds = make_bonds(s, {m}, pairs, std::vector<std::uint8_t>(s.size(), 0), weight);
    Numerics numerics;
    numerics.damping = {0.7, 0.7};
    Model model(s, {m}, bonds, weight, {}, numerics);
    const auto last = static_cast<std::size_t>(n);
    Tip tip;
    for (int k = 0; k < 400 * n * n; ++k) {
        model.loads.add(last, force, torque);
        model.step({}, false);
        tip.twist += model.spheres.spin.x[last] * model.dt();
        model.spheres.position.set(0, s.position.at(0));
        model.spheres.velocity.set(0, Vec3::Zero());
        model.spheres.spin.set(0, Vec3::Zero());
    }
    for (std::size_t k = 0; k <= last; ++k) {
        tip.moved.emplace_back(model.spheres.position.at(k) - s.position.at(k));
    }
    tip.deflection = -tip.moved.back().z();
    return tip;
}

} // namespace bonded_cantilever_case

Case bonded_cantilever() {
    using namespace bonded_cantilever_case;
    return {"bonded-cantilever", "- (bending and twisting of bonds)",
            "A row of bonded spheres under a tip load and a tip torque against Timoshenko's beam.", false, [] {
                Outcome out;
                const double area = std::numbers::pi * r * r;
                const double inertia = area * area / (4.0 * std::numbers::pi);
                const double shear = young / (2.0 * (1.0 + poisson));
                constexpr double p = 0.1;  // N: deflections of micrometres, so that the geometry stays linear
                constexpr double t = 1e-3; // N m
                report::Plot plot{"A bonded cantilever of 16 spheres and Timoshenko's beam.", "x [m]", "deflection [um]", {}, {}};
                for (const int n : {8, 16}) {
                    const double length = 2.0 * r * n;
                    const Tip bent = load(n, {0, 0, -p}, Vec3::Zero());
                    const Tip twisted = load(n, Vec3::Zero(), {t, 0, 0});
                    // The row itself: moments at the bonds' middles.
                    const double l = 2.0 * r;
                    double row = 0.0;
                    double slope = 0.0;
                    for (int k = 1; k <= n; ++k) {
                        const double turn = p * (length - (k - 0.5) * l) / (young * inertia / l);
                        row += p / (kappa * shear * area / l) + l * (slope + 0.5 * turn);
                        slope += turn;
                    }
                    const auto beam = [&](double x) {
                        return p * x * x * (3.0 * length - x) / (6.0 * young * inertia) + p * x / (kappa * shear * area);
                    };
                    const std::string name = std::to_string(n) + " bonds: ";
                    // At rest to the round-off of micrometres against the row's decimetres.
                    out.checks.push_back({name + "tip deflection, row of springs", row, bent.deflection, 1e-6, Compare::relative, "m"});
                    // Midpoint rule for the moments: 1/(4 n^2) below the beam.
                    out.checks.push_back(
                        {name + "tip deflection, Timoshenko", beam(length), bent.deflection, 0.3 / (n * n), Compare::relative, "m"});
                    out.checks.push_back(
                        {name + "tip twist", t * length / (shear * 2.0 * inertia), twisted.twist, 1e-6, Compare::relative, "rad"});
                    if (n == 16) {
                        report::Curve found{"bonded spheres", {}, {}, "#c0392b"};
                        report::Curve closed{"Timoshenko", {}, {}, "#1f4e79"};
                        for (int k = 0; k <= n; ++k) {
                            found.x.push_back(k * l);
                            found.y.push_back(-1e6 * bent.moved[static_cast<std::size_t>(k)].z());
                            closed.x.push_back(k * l);
                            closed.y.push_back(1e6 * beam(k * l));
                        }
                        plot.curves = {closed, found};
                    }
                }
                out.plots.push_back(plot);
                return out;
            }};
}

} // namespace proveta::verification
