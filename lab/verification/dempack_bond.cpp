// One bond along every load path, against closed forms point by point (thesis 5.2.3 to 5.2.5).
#include <cmath>
#include <functional>
#include <string>

#include "core/laws/bond/dempack_law.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace dempack_bond_case {

constexpr double k_n = 7.0e7;   // N/m, concrete's for spheres of 4 mm
constexpr double area = 5.0e-5; // m2
constexpr double exact = 1e-12; // of the force at the limit: a few roundings
constexpr double sigma = 5.0e6; // table 5.5
constexpr double tau = 16.0e6;

// A bond that is moved to absolute places, with its work and dissipation on record and the largest distance from a closed form.
struct Walk {
    Dempack::Constants p;
    Dempack::State<double> s{{0, 0, 0}, 0, 0, 0};
    BondResponse<double> r{};
    double u = 0.0; // shortening
    double slip = 0.0;
    double work = 0.0;
    double dissipated = 0.0;
    double worst_normal = 0.0;
    double worst_shear = 0.0;
    report::Curve curve;

    [[nodiscard]] double k_t() const { return k_n * p.shear_ratio; }

    /// Not inlined: one copy of the law is enough. Goes straight to (u, slip) in `steps`, comparing with the forces that the closed forms
    /// give there (compression positive).
    [[gnu::noinline]] void to(double u1, double slip1, int steps, const std::function<double(double)>& normal,
                              const std::function<double(double)>& shear) {
        const double u0 = u;
        const double slip0 = slip;
        for (int k = 1; k <= steps; ++k) {
            const auto before = r;
            const double next = k == steps ? u1 : u0 + (u1 - u0) * k / steps;
            const double next_slip = k == steps ? slip1 : slip0 + (slip1 - slip0) * k / steps;
            const double du = next - u;
            const double dx = next_slip - slip;
            u = next;
            slip = next_slip;
            r = Dempack::advance<double>(p, {k_n, area, 0.0, 0.0, 1.0}, {u, du, {dx, 0.0, 0.0}}, s);
            work += 0.5 * ((before.normal + r.normal) * du + (before.shear[0] + r.shear[0]) * dx);
            dissipated += r.damage_work + r.plastic_work + r.friction_work;
            if (normal) {
                worst_normal = std::max(worst_normal, std::fabs(r.normal - normal(u)));
            }
            if (shear) {
                worst_shear = std::max(worst_shear, std::fabs(r.shear[0] - shear(slip)));
            }
        }
    }
    [[nodiscard]] double stored() const {
        return Dempack::stored_energy<double>(p, {k_n, area, 0.0, 0.0, 1.0}, {u, 0.0, {0.0, 0.0, 0.0}}, r.normal, s);
    }

    void keep(const char* name, const char* colour, bool in_shear) {
        if (curve.name.empty()) {
            curve.name = name;
            curve.colour = colour;
            curve.x.push_back(0.0);
            curve.y.push_back(0.0);
        }
        curve.x.push_back(1e6 * (in_shear ? slip : u));
        curve.y.push_back(1e-6 * (in_shear ? r.shear[0] : r.normal) / area);
    }
};

void judge(Outcome& out, const std::string& path, const Walk& w, double limit, bool in_shear) {
    out.checks.push_back({path + ": largest error of the force over its limit", 0.0, (in_shear ? w.worst_shear : w.worst_normal) / limit,
                          exact, Compare::absolute, ""});
}

void judge_energy(Outcome& out, const std::string& path, const Walk& w, double closed_form, double tolerance) {
    out.checks.push_back({path + ": dissipated energy", closed_form, w.dissipated, tolerance, Compare::relative, "J"});
    out.checks.push_back({path + ": work less stored and dissipated, over work", 0.0,
                          (w.work - w.stored() - w.dissipated) / std::fabs(w.work), exact * 100, Compare::absolute, ""});
}

void tension(Outcome& out, report::Plot& plot, bool by_energy) {
    constexpr double g_f = 100.0; // J/m2, concrete
    Walk w;
    const double u_l = sigma * area / k_n;
    w.p.opening_f = by_energy ? 2.0 * g_f / sigma : 0.0;
    const double u_f = by_energy ? w.p.opening_f : 1.2 * u_l;
    const auto damage = [&](double e) { return e <= u_l ? 0.0 : (by_energy ? u_f / e : 1.0) * (e - u_l) / (u_f - u_l); };
    double worst_damage = 0.0; // reached so far
    const auto force = [&](double u) { return u > 0.0 ? k_n * u : (1.0 - worst_damage) * k_n * u; };
    const auto loading = [&](double u) { return -(1.0 - damage(-u)) * k_n * -u; };
    const auto leg = [&](double u1, int steps, bool loads) {
        for (int k = 0; k < steps; ++k) { // one step at a time, for the drawing
            const double next = w.u + (u1 - w.u) / (steps - k);
            w.to(next, 0.0, 1, loads ? std::function<double(double)>(loading) : force, nullptr);
            w.keep(by_energy ? "tension, G_f = 100 J/m2" : "tension, ratio 0.2", by_energy ? "#1e7b46" : "#1f4e79", false);
        }
        worst_damage = std::max(worst_damage, loads ? damage(-u1) : 0.0);
    };
    const double half = by_energy ? 0.4 * u_f : 1.1 * u_l;
    leg(-u_l, 50, true);
    leg(-half, 1000, true);
    leg(0.0, 50, false);       // the damaged secant to the origin
    leg(0.3 * u_l, 50, false); // compression is undamaged
    leg(0.0, 50, false);
    leg(-half, 50, false); // reloading comes back to where it left
    leg(-u_f, 4000, true);
    const std::string name = by_energy ? "tension, softening by G_f" : "tension, softening by ratio";
    judge(out, name, w, sigma * area, false);
    // By ratio k u_l^2 (r^2 + r + 1) / 6, which the trapezoidal rule meets to the square of the step; by energy G_f A, exactly.
    const double r = u_f / u_l;
    judge_energy(out, name, w, by_energy ? g_f * area : k_n * u_l * u_l * (r * r + r + 1.0) / 6.0, by_energy ? 1e-10 : 1e-6);
    out.checks.push_back({name + ": damage at u_f", 1.0, w.s.d_n, exact, Compare::absolute, ""});
    plot.curves.push_back(w.curve);
}

void compression(Outcome& out, report::Plot& plot) {
    Walk w;
    const double u1 = 20e6 * area / k_n;
    const double u2 = u1 + 3.0 * 25e6 * area / k_n;
    const double u3 = u2 + 12.0 * 25e6 * area / k_n;
    const double u4 = u3 + 22.0 * 10e6 * area / k_n;
    const auto envelope = [&](double u) {
        return u < u1   ? k_n * u
               : u < u2 ? 20e6 * area + k_n / 3.0 * (u - u1)
               : u < u3 ? 45e6 * area + k_n / 12.0 * (u - u2)
                        : 70e6 * area + k_n / 22.0 * (u - u3);
    };
    const auto leg = [&](double target, int steps, const std::function<double(double)>& force) {
        for (int k = 0; k < steps; ++k) {
            w.to(w.u + (target - w.u) / (steps - k), 0.0, 1, force, nullptr);
            w.keep("compression", "#7d3c98", false);
        }
    };
    const auto unloading = [&](double from) { return [&, from](double u) { return envelope(from) - k_n * (from - u); }; };
    leg(u1, 40, envelope);
    leg(0.5 * (u1 + u2), 40, envelope);
    const double left = w.u;
    leg(left - 15e6 * area / k_n, 20, unloading(left));
    leg(left, 20, unloading(left));
    leg(u2, 40, envelope);
    leg(u3, 40, envelope);
    leg(u4, 40, envelope);
    const double u_p = u4 - 80e6 * area / k_n;
    leg(u_p, 40, unloading(u4));
    judge(out, "compression past every LCS, unloading, reloading", w, 80e6 * area, false);
    const double under = 0.5 * (20e6 * u1 + 65e6 * (u2 - u1) + 115e6 * (u3 - u2) + 150e6 * (u4 - u3)) * area;
    judge_energy(out, "compression", w, under - 0.5 * std::pow(80e6 * area, 2) / k_n, 1e-10);
    // On into tension from the plastic shortening, without a jump and with the whole strength.
    w.worst_normal = 0.0;
    const double u_l = sigma * area / k_n;
    leg(u_p - u_l, 40, [&](double u) { return k_n * (u - u_p); });
    judge(out, "from compression into tension", w, sigma * area, false);
    plot.curves.push_back(w.curve);
}

void shear(Outcome& out, report::Plot& plot, double pressure, const char* colour) {
    Walk w;
    const double limit = (tau + 0.9 * pressure) * area;
    const double u_l = limit / w.k_t();
    w.to(pressure * area / k_n, 0.0, 20, nullptr, nullptr);
    const double pressed = w.work;
    const std::string name = "shear under " + std::to_string(static_cast<int>(pressure * 1e-6)) + " MPa";
    const auto force = [&](double u) { return (u <= u_l ? 1.0 : 1.0 - (u - u_l) / (0.2 * u_l)) * w.k_t() * u; };
    const auto leg = [&](double target, int steps, const std::function<double(double)>& f) {
        for (int k = 0; k < steps; ++k) {
            w.to(w.u, w.slip + (target - w.slip) / (steps - k), 1, nullptr, f);
            w.keep(name.c_str(), colour, true);
        }
    };
    leg(u_l, 50, force);
    leg(1.1 * u_l, 1000, force);
    const auto secant = [&](double u) { return 0.5 * w.k_t() * u; };
    leg(-0.9 * u_l, 50, secant); // through the origin: shear has no sign
    leg(1.1 * u_l, 50, secant);
    leg(1.2 * u_l, 4000, force);
    judge(out, name, w, limit, true);
    const double r = 1.2;
    const double closed = w.k_t() * u_l * u_l * (r * r + r + 1.0) / 6.0;
    out.checks.push_back({name + ": dissipated energy", closed, w.dissipated, 1e-6, Compare::relative, "J"});
    out.checks.push_back({name + ": normal force kept through the failure, over its value", 0.0,
                          pressure > 0.0 ? w.r.normal / (pressure * area) - 1.0 : w.r.normal, exact, Compare::absolute, ""});
    // Friction: the spring starts anew at zero, then slides at mu_d F_n.
    w.worst_shear = 0.0;
    const double start = w.slip;
    const double coulomb = 0.25 * pressure * area;
    const double until = w.slip + 0.4 * u_l;
    leg(until, 400, [&](double u) { return std::min(w.k_t() * (u - start), coulomb); });
    judge(out, name + ", friction after failure", w, limit, true);
    const double slid = until - start - coulomb / w.k_t();
    out.checks.push_back({name + ": all dissipated, with friction", closed + coulomb * slid, w.dissipated, 1e-6, Compare::relative, "J"});
    out.checks.push_back({name + ": work less stored and dissipated, over work", 0.0,
                          (w.work - w.stored() - w.dissipated) / (w.work + pressed), exact * 100, Compare::absolute, ""});
    plot.curves.push_back(w.curve);
}

void shear_by_energy(Outcome& out) {
    constexpr double g_s = 5000.0; // J/m2: enough not to snap back
    Walk w;
    w.p.slip_f = 2.0 * g_s / tau;
    const double u_l = tau * area / w.k_t();
    const auto force = [&](double u) { return u <= u_l ? w.k_t() * u : tau * area * (w.p.slip_f - u) / (w.p.slip_f - u_l); };
    w.to(0.0, u_l, 50, nullptr, force);
    w.to(0.0, w.p.slip_f, 1000, nullptr, force);
    judge(out, "shear, softening by G_s", w, tau * area, true);
    judge_energy(out, "shear, softening by G_s", w, g_s * area, 1e-10);
}

void shear_after_tension(Outcome& out) {
    Walk w;
    const double u_l = sigma * area / k_n;
    w.to(-1.1 * u_l, 0.0, 500, nullptr, nullptr);
    const double u_t = 0.5 * tau * area / w.k_t();
    w.to(
        -1.1 * u_l, u_t, 50, [&](double u) { return 0.5 * k_n * u; }, [&](double x) { return w.k_t() * x; });
    out.checks.push_back({"shear after tension damage: largest error of both forces over their limits", 0.0,
                          w.worst_shear / (tau * area) + w.worst_normal / (sigma * area), exact, Compare::absolute, ""});
    w.to(-1.21 * u_l, u_t, 500, nullptr, nullptr);
    out.checks.push_back({"failure in tension ends shear too: force left", 0.0, w.r.shear[0] + w.r.normal, 0.0, Compare::absolute, "N"});
    out.checks.push_back({"failure in tension: stored energy left", 0.0, w.stored(), 0.0, Compare::absolute, "J"});
}

} // namespace dempack_bond_case

Case dempack_bond() {
    using namespace dempack_bond_case;
    return {
        "dempack-bond", "5.2.3-5.2.5", "One bond along every load path: forces point by point, energies as areas under curves.", false, [] {
            Outcome out;
            report::Plot pulled{"A bond in tension: softening, unloading, reloading.", "shortening [um]", "normal stress [MPa]", {}, {}};
            report::Plot normal{"A bond in compression, on into tension.", "shortening [um]", "normal stress [MPa]", {}, {}};
            report::Plot sheared{"A bond in shear, with friction after failure.", "slip [um]", "shear stress [MPa]", {}, {}};
            tension(out, pulled, false);
            tension(out, pulled, true);
            compression(out, normal);
            shear(out, sheared, 0.0, "#1f4e79");
            shear(out, sheared, 20e6, "#c0392b");
            shear_by_energy(out);
            shear_after_tension(out);
            out.plots = {pulled, normal, sheared};
            return out;
        }};
}

} // namespace proveta::verification
