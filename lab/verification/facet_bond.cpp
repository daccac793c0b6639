// One facet along every load path, against closed forms point by point (CSL and LDPM; docs/theory.md).
#include <cmath>
#include <numbers>
#include <string>

#include "lab/verification/cases.hpp"
#include "lab/verification/facet_walk.hpp"

namespace proveta::verification {

namespace facet_bond_case {

constexpr double rounded = 1e-8; // of the strength: exponential, logarithm and arc tangent are good to 3e-9

double fracture_energy(const Facet::Parameters& p) { return 0.5 * p.sigma_t * p.sigma_t * p.length_t / e_0; }

void balance(Outcome& out, const std::string& path, const Walk& w) {
    out.checks.push_back({path + ": work less stored and dissipated, over work", 0.0, (w.work - w.stored() - w.lost()) / std::fabs(w.work),
                          1e-12, Compare::absolute, ""});
}

// Opening along a fixed direction until it fails, with unloading to the origin on the way.
void opening(Outcome& out, report::Plot& plot, const Facet::Parameters& p, double length, double w, const std::string& name,
             const char* colour) {
    Walk facet(p, length);
    const double s_0 = papers_strength(p, w);
    double worst = 0.0;
    double reached = 0.0; // effective strain so far
    report::Curve curve;
    curve.name = name;
    curve.colour = colour;
    const auto effective = [&](double e) { return std::pair{e * std::sin(w), e * std::cos(w) / std::sqrt(alpha)}; };
    const auto look = [&] {
        const double e = std::hypot(facet.u, std::sqrt(alpha) * facet.slip) / length;
        const double s = std::hypot(facet.s_n(), facet.s_t() / std::sqrt(alpha));
        const double expected = e >= reached ? papers_stress(p, length, w, e) : papers_stress(p, length, w, reached) * e / reached;
        if (facet.s.damage < 1.0) {
            worst = std::max(worst, std::fabs(s - expected) / s_0);
        }
        reached = std::max(reached, e);
        curve.x.push_back(1e6 * e);
        curve.y.push_back(1e-6 * s);
    };
    const auto go = [&](double e, int steps) {
        const auto [e_n, e_t] = effective(e);
        facet.to(e_n, e_t, steps, look);
    };
    const double e_first = s_0 / e_0;
    go(e_first, 20);
    go(5.0 * e_first, 400);
    go(1e-9 * e_first, 40); // to the origin, but not closed
    go(5.0 * e_first, 40);
    go(25.0 * e_first, 2000);
    go(0.4 * e_first, 40);
    go(25.0 * e_first, 40);
    double e = 25.0 * e_first;
    while (facet.s.damage < 1.0 && e < 1e5 * e_first) {
        go(1.002 * e, 1);
        e *= 1.002;
    }
    out.checks.push_back({name + ": largest error of the stress over the strength", 0.0, worst, rounded, Compare::absolute, ""});
    balance(out, name, facet);
    out.checks.push_back({name + ": failed in shear (1) or tension (0)", w < 0.25 * std::numbers::pi ? 1.0 : 0.0,
                          Facet::failed_in_shear(facet.s) ? 1.0 : 0.0, 0.0, Compare::absolute, ""});
    if (w == 0.5 * std::numbers::pi) {
        // What the last hundredth of the strength would still have given is let go with what is stored, about as much.
        out.checks.push_back(
            {name + ": energy to failure over G_t A", 1.0, facet.work / (fracture_energy(p) * area), 0.02, Compare::relative, ""});
    }
    plot.curves.push_back(curve);
}

void surface(Outcome& out) {
    const auto p = concrete();
    double worst_parabola = 0.0;
    double worst_papers = 0.0;
    for (int k = 0; k <= 18; ++k) {
        const double w = 0.5 * std::numbers::pi * k / 18.0;
        Walk facet(p);
        const double s_0 = papers_strength(p, w);
        double most = 0.0;
        double at_n = 0.0;
        double at_t = 0.0;
        facet.to(1.05 * s_0 / e_0 * std::sin(w), 1.05 * s_0 / e_0 * std::cos(w) / std::sqrt(alpha), 20000, [&] {
            const double s = std::hypot(facet.s_n(), facet.s_t() / std::sqrt(alpha));
            if (s > most) {
                most = s;
                at_n = facet.s_n();
                at_t = facet.s_t();
            }
        });
        const double s_s = p.shear_ratio_t * p.sigma_t;
        worst_papers = std::max(worst_papers, std::fabs(most / s_0 - 1.0));
        worst_parabola = std::max(worst_parabola, std::fabs(std::pow(at_t / s_s, 2.0) + at_n / p.sigma_t - 1.0));
    }
    // A step is 1.05/20000 of the strength, the largest stress lies within one.
    out.checks.push_back({"limit surface, 19 directions: largest error of s_0(w)", 0.0, worst_papers, 6e-5, Compare::absolute, ""});
    out.checks.push_back({"limit surface: s_T^2 / s_s^2 + s_N / s_t", 0.0, worst_parabola, 1.2e-4, Compare::absolute, ""});
}

void lengths(Outcome& out) {
    const auto p = concrete();
    double spread = 0.0;
    for (const double length : {0.004, 0.0077, 0.0146}) {
        Walk facet(p, length);
        const double e = 8.0 * p.sigma_t / e_0; // in the first stage
        facet.to(e, 0.0, 2000);
        spread = std::max(spread, std::fabs(facet.s_n() - papers_stress(p, 0.0077, 0.5 * std::numbers::pi, e)) / p.sigma_t);
    }
    out.checks.push_back(
        {"two stages: one stress-strain law for facets of 4, 7.7, 14.6 mm, difference", 0.0, spread, rounded, Compare::absolute, ""});
    auto one = p;
    one.first_length = 0.0;
    one.length_t = 0.02;
    const double long_facet = 0.03;
    Walk facet(one, long_facet);
    double most = 0.0;
    facet.to(3.0 * p.sigma_t / e_0, 0.0, 30000, [&] { most = std::max(most, facet.s_n()); });
    out.checks.push_back({"one stage, facet longer than L_t: strength is cut to s_t sqrt(0.99 L_t / L)",
                          one.sigma_t * std::sqrt(0.99 * one.length_t / long_facet), most, 2e-4, Compare::relative, "Pa"});
}

void collapse(Outcome& out, report::Plot& plot) {
    auto p = concrete();
    Walk facet(p);
    const double e_c0 = p.sigma_c0 / e_0;
    const double e_c1 = p.transition * e_c0;
    const double h = p.hardening * e_0;
    const double s_c1 = p.sigma_c0 + (e_c1 - e_c0) * h;
    const auto bound = [&](double e) {
        return e <= e_c0 ? e_0 * e : e <= e_c1 ? p.sigma_c0 + (e - e_c0) * h : s_c1 * std::exp((e - e_c1) * h / s_c1);
    };
    double worst = 0.0;
    double plastic = 0.0;
    report::Curve curve;
    curve.name = "pore collapse and rehardening";
    curve.colour = "#7d3c98";
    const auto look = [&] {
        const double e = -facet.u / facet.length;
        // Beyond e_c1 the exponential may climb faster than the facet is stiff: then it follows its own elastic line.
        const double expected = std::min(bound(e), e_0 * (e - plastic));
        plastic = std::max(plastic, e - expected / e_0);
        worst = std::max(worst, std::fabs(-facet.s_n() - expected) / std::max(expected, p.sigma_c0));
        curve.x.push_back(1e6 * e);
        curve.y.push_back(-1e-6 * facet.s_n());
    };
    facet.to(-e_c0, 0.0, 40, look);
    facet.to(-3.0 * e_c0, 0.0, 400, look);
    facet.to(-2.7 * e_c0, 0.0, 40, look); // elastic
    facet.to(-3.0 * e_c0, 0.0, 40, look);
    facet.to(-e_c1, 0.0, 400, look);
    facet.to(-2.0 * e_c1, 0.0, 2000, look);
    out.checks.push_back(
        {"compression: largest error of the stress over the larger of itself and s_c0", 0.0, worst, rounded, Compare::absolute, ""});
    balance(out, "compression", facet);
    // On into tension from the plastic shortening with the whole strength.
    double most = 0.0;
    facet.to(-facet.s.plastic / facet.length + 1.2 * p.sigma_t / e_0, 0.0, 40000, [&] { most = std::max(most, facet.s_n()); });
    out.checks.push_back({"from compression into tension: strength", p.sigma_t, most, 1e-3, Compare::relative, "Pa"});

    // The strain around the facet: with beta 0 pores collapse by it alone, and a deviatoric facet hardens less.
    p.coupling = 0.0;
    p.kappa_c2 = 5.0;
    Walk around(p);
    around.volumetric = -2.0 * e_c0;
    around.to(-4.0 * e_c0, 0.0, 400);
    const double r_dv = 2.0 * e_c0 / (p.kappa_c3 * e_c0 + 2.0 * e_c0);
    const double less = h / (1.0 + p.kappa_c2 * std::max(r_dv - p.kappa_c1, 0.0));
    out.checks.push_back(
        {"compression, beta 0, e_V = -2 e_c0, e_N = -4 e_c0", p.sigma_c0 + e_c0 * less, -around.s_n(), 1e-12, Compare::relative, "Pa"});
    plot.curves.push_back(curve);
}

void pressed_shear(Outcome& out, report::Plot& plot) {
    auto p = concrete();
    p.sigma_c0 = 1e9; // elastic in compression, to see shear alone
    p.mu_0 = 0.3;
    p.mu_inf = 0.05;
    p.sigma_n0 = 100e6;
    for (const double pressure : {0.0, 30.0e6, 200.0e6}) {
        Walk facet(p);
        facet.to(-pressure / e_0, 0.0, 10);
        const double limit =
            p.shear_ratio_t * p.sigma_t + (p.mu_0 - p.mu_inf) * p.sigma_n0 * (1.0 - std::exp(-pressure / p.sigma_n0)) + p.mu_inf * pressure;
        const double e_y = limit / (alpha * e_0);
        const std::string name = "shear under " + std::to_string(static_cast<int>(pressure * 1e-6)) + " MPa";
        double worst = 0.0;
        double back = 0.0; // plastic slip over length
        report::Curve curve;
        curve.name = name;
        curve.colour = pressure == 0.0 ? "#1f4e79" : pressure < 1e8 ? "#b9770e" : "#c0392b";
        const auto look = [&] {
            const double e_t = facet.slip / facet.length;
            back = std::clamp(back, e_t - e_y, e_t + e_y);
            worst = std::max(worst, std::fabs(facet.s_t() - alpha * e_0 * (e_t - back)) / limit);
            curve.x.push_back(1e6 * e_t);
            curve.y.push_back(1e-6 * facet.s_t());
        };
        const double rest = -pressure / e_0;
        facet.to(rest, 2.5 * e_y, 200, look);
        facet.to(rest, -1.5 * e_y, 200, look); // reversal
        facet.to(rest, 0.0, 100, look);
        out.checks.push_back(
            {name + ", reversed twice: largest error of the stress over the limit", 0.0, worst, rounded, Compare::absolute, ""});
        out.checks.push_back(
            {name + ": energy of sliding", limit * 3.5 * e_y * facet.length * area, facet.friction, rounded, Compare::relative, "J"});
        balance(out, name, facet);
        plot.curves.push_back(curve);
    }
}

// A crack opened with shear, closed, sheared, opened again.
void closing(Outcome& out) {
    auto p = concrete();
    p.sigma_c0 = 1e9;
    Walk facet(p);
    const double e_y = p.sigma_t / e_0;
    facet.to(6.0 * e_y, 4.0 * e_y, 4000);
    const double d = facet.s.damage;
    const double opened = facet.s_t();
    out.checks.push_back(
        {"opened with shear: secant of both stresses", (1.0 - d) * alpha * e_0 * 4.0 * e_y, opened, 1e-12, Compare::relative, "Pa"});
    facet.to(1e-9 * e_y, 4.0 * e_y, 400);
    const double lost = facet.lost();
    const double before = facet.stored();
    const double worked = facet.work;
    facet.to(-1e-9 * e_y, 4.0 * e_y, 1);
    out.checks.push_back({"closing: the shear stress does not jump", opened, facet.s_t(), 1e-8, Compare::relative, "Pa"});
    out.checks.push_back(
        {"closing: energy lost is D of what was stored in shear", d * before, facet.lost() - lost, 1e-6, Compare::relative, "J"});
    out.checks.push_back({"closing: energy made", 0.0, (facet.stored() - before - (facet.work - worked) + facet.lost() - lost) / before,
                          1e-9, Compare::absolute, ""});
    facet.to(-8.0 * e_y, 4.0 * e_y, 200);
    const double s_n = -facet.s_n();
    out.checks.push_back({"closed: full stiffness in compression", 8.0 * e_y * e_0, s_n, 1e-12, Compare::relative, "Pa"});
    const double own = p.shear_ratio_t * p.sigma_t + p.mu_0 * p.sigma_n0 * (1.0 - std::exp(-s_n / p.sigma_n0));
    facet.to(-8.0 * e_y, 60.0 * e_y, 400);
    out.checks.push_back({"closed: shear limit between the facet's and a crack's friction, by D", (1.0 - d) * own + d * 0.25 * s_n,
                          facet.s_t(), rounded, Compare::relative, "Pa"});
    const double slid = facet.s_t();
    facet.to(-7.0 * e_y, 60.0 * e_y, 2000);
    const auto limit = [&](double pressed) {
        return (1.0 - d) * (p.shear_ratio_t * p.sigma_t + p.mu_0 * p.sigma_n0 * (1.0 - std::exp(-pressed / p.sigma_n0))) +
               d * 0.25 * pressed;
    };
    out.checks.push_back({"released: shear stress falls with its limit", std::min(slid, limit(7.0 * e_y * e_0)), facet.s_t(), rounded,
                          Compare::relative, "Pa"});
    facet.to(-1e-9 * e_y, 60.0 * e_y, 2000);
    const double left = facet.s_t();
    out.checks.push_back(
        {"released to nothing: the cohesion that damage left", limit(1e-9 * e_y * e_0), left, rounded, Compare::relative, "Pa"});
    facet.to(1e-9 * e_y, 60.0 * e_y, 1);
    out.checks.push_back({"opened again: the secant with the same D", (1.0 - d) * left, facet.s_t(), 1e-6, Compare::relative, "Pa"});
    out.checks.push_back({"opened again: damage kept", d, facet.s.damage, 1e-12, Compare::absolute, ""});
    balance(out, "opened, closed, sheared, opened", facet);
    // Torn: friction alone, from zero.
    facet.to(4000.0 * e_y, 60.0 * e_y, 4000);
    out.checks.push_back({"torn: failed, stress left", 0.0, Facet::failed(facet.s) ? std::fabs(facet.s_n()) + std::fabs(facet.s_t()) : 1.0,
                          0.0, Compare::absolute, "Pa"});
    facet.to(-8.0 * e_y, 60.0 * e_y, 400);
    facet.to(-8.0 * e_y, 120.0 * e_y, 400);
    out.checks.push_back({"torn and closed: Coulomb's friction", 0.25 * 8.0 * e_y * e_0, facet.s_t(), 1e-12, Compare::relative, "Pa"});
}

// As the card has it: without loss of cohesion a closed crack has the whole of it, of a facet as strong as it is.
void keeping(Outcome& out) {
    auto p = concrete();
    p.sigma_c0 = 1e9;
    p.cohesion_loss = 0.0;
    Walk facet(p);
    facet.strength = 0.5;
    const double e_y = p.sigma_t / e_0;
    double most = 0.0;
    facet.to(0.6 * e_y, 0.0, 6000, [&] { most = std::max(most, facet.s_n()); });
    out.checks.push_back({"half as strong a facet: strength", 0.5 * p.sigma_t, most, 2e-4, Compare::relative, "Pa"});
    facet.to(8.0 * e_y, 0.0, 4000);
    facet.to(-4.0 * e_y, 0.0, 400);
    facet.to(-4.0 * e_y, 60.0 * e_y, 400);
    const double own = 0.5 * p.shear_ratio_t * p.sigma_t + p.mu_0 * p.sigma_n0 * (1.0 - std::exp(-4.0 * e_y * e_0 / p.sigma_n0));
    out.checks.push_back({"closed without loss of cohesion: its own limit", own, facet.s_t(), rounded, Compare::relative, "Pa"});
}

// Slipped through under pressure, then pulled: the departure from LDPM that docs/theory.md names.
void slipped(Outcome& out) {
    const auto p = concrete();
    Walk facet(p);
    const double e_y = p.sigma_t / e_0;
    facet.to(-4.0 * e_y, 0.0, 100);
    facet.to(-4.0 * e_y, 300.0 * e_y, 4000);
    const double back = facet.slip / facet.length - facet.s_t() / (alpha * e_0); // where no shear is left
    facet.to(-4.0 * e_y, back, 400);
    double most = 0.0;
    facet.to(1.2 * e_y, back, 20000, [&] { most = std::max(most, facet.s_n()); });
    out.checks.push_back({"slipped under pressure, then pulled: the whole strength", p.sigma_t, most, 2e-4, Compare::relative, "Pa"});
}

// The same opening and shearing along x, and along a direction that turns in the contact plane by 1.1 rad: forces turn with it.
void rotation(Outcome& out) {
    const auto p = concrete();
    const auto c = Facet::constants(p, {e_0, alpha, 0.25});
    const double turn = 1.1;
    Facet::State<double> one{{0, 0, 0}, 0, 0, 0};
    Facet::State<double> other = one;
    const BondShape<double> bond{e_0 * area / 0.0077, area, 0.0077, 0.0, 1.0};
    double worst = 0.0;
    double u = 0.0;
    for (int k = 0; k < 3000; ++k) {
        const double du = 2e-9 * std::sin(0.004 * k) + 5e-10;
        const double dx = 3e-8 * std::cos(0.007 * k);
        const double dy = 1e-8 * std::sin(0.003 * k);
        u += du;
        const auto a = Facet::advance<double>(c, bond, {-u, -du, {dx, dy, 0.0}}, one);
        const double tx = std::cos(turn) * dx - std::sin(turn) * dy;
        const double ty = std::sin(turn) * dx + std::cos(turn) * dy;
        const auto b = Facet::advance<double>(c, bond, {-u, -du, {tx, ty, 0.0}}, other);
        worst = std::max({worst, std::fabs(a.normal - b.normal),
                          std::fabs(std::hypot(a.shear[0], a.shear[1]) - std::hypot(b.shear[0], b.shear[1])),
                          std::fabs(std::cos(turn) * a.shear[0] - std::sin(turn) * a.shear[1] - b.shear[0])});
    }
    out.checks.push_back(
        {"turned by 1.1 rad: largest difference of the forces over s_t A", 0.0, worst / (p.sigma_t * area), 1e-10, Compare::absolute, ""});
    out.checks.push_back({"turned by 1.1 rad: damage reached on the way", 0.5, one.damage, 0.0, Compare::at_least, ""});
}

} // namespace facet_bond_case

Case facet_bond() {
    using namespace facet_bond_case;
    return {"facet-bond", "", "One facet along every load path: stresses point by point, energies by mechanism.", false, [] {
                Outcome out;
                report::Plot opened{
                    "A facet opened along three directions, unloaded twice.", "effective strain [1e-6]", "effective stress [MPa]", {}, {}};
                report::Plot crushed{"A facet in compression.", "shortening over length [1e-6]", "normal stress [MPa]", {}, {}};
                report::Plot sheared{
                    "A facet sheared under pressure, reversed twice.", "slip over length [1e-6]", "shear stress [MPa]", {}, {}};
                const double half = 0.5 * std::numbers::pi;
                surface(out);
                auto one_stage = concrete();
                one_stage.first_length = 0.0;
                opening(out, opened, concrete(), 0.0077, half, "tension, two stages", "#1f4e79");
                opening(out, opened, concrete(), 0.0146, half, "tension, two stages, 14.6 mm", "#5dade2");
                opening(out, opened, concrete(), 0.030, half, "tension, two stages, 30 mm, too long for its tail", "#7f8c8d");
                opening(out, opened, one_stage, 0.0077, half, "tension, one stage", "#1e7b46");
                opening(out, opened, concrete(), 0.0077, 0.6 * half, "tension with shear, w = 54 degrees", "#b9770e");
                opening(out, opened, concrete(), 0.0077, 0.35 * half, "shear with tension, w = 31.5 degrees", "#c0392b");
                lengths(out);
                collapse(out, crushed);
                pressed_shear(out, sheared);
                closing(out);
                keeping(out);
                slipped(out);
                rotation(out);
                out.plots = {opened, crushed, sheared};
                return out;
            }};
}

} // namespace proveta::verification
