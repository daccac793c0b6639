#include "core/motion/mass_scaling.hpp"

#include <algorithm>
#include <numeric>

namespace proveta {

namespace {

// The least factors on the true masses with which every sphere is stable at dt, and the mass that they add, kg. demand: of the spheres
// with the masses they have now.
double factors_at(double dt, const std::vector<SphereDemand>& demand, const std::vector<double>& now, const std::vector<double>& mass,
                  std::vector<double>& factor) {
    double added = 0.0;
    for (std::size_t k = 0; k < mass.size(); ++k) {
        factor[k] = std::max(1.0, demand[k].factor(dt) * now[k] / mass[k]);
        added += (factor[k] - 1.0) * mass[k];
    }
    return added;
}

// The largest step that the allowed mass reaches, and its factors.
double best_step(double allowed, const std::vector<SphereDemand>& demand, const std::vector<double>& now, const std::vector<double>& mass,
                 std::vector<double>& factor) {
    double low = 1e300;
    for (const auto& d : demand) {
        low = std::min(low, d.step());
    }
    double high = low;
    while (factors_at(low, demand, now, mass, factor) > allowed) { // the last round overspent
        low *= 0.5;
    }
    while (high < 1e3 * low && factors_at(high, demand, now, mass, factor) <= allowed) {
        high *= 2.0;
    }
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (factors_at(middle, demand, now, mass, factor) <= allowed ? low : high) = middle;
    }
    factors_at(low, demand, now, mass, factor);
    return low;
}

// Restitution follows the masses.
void set_up_laws(const Spheres& s, const std::vector<Material>& materials, const std::vector<double>& weight, Contacts& contacts,
                 Walls& walls) {
    set_up_contacts(s, materials, weight, contacts);
    set_up_walls(s, materials, walls);
}

} // namespace

MassScaling scale_masses(Spheres& s, const Bonds& bonds, const std::vector<Material>& materials, const std::vector<double>& weight,
                         Contacts& contacts, Walls& walls, const Clusters& clusters, double skin, double share, StepBound& bound) {
    MassScaling out;
    const std::vector<double> mass = s.mass;
    const std::vector<double> inertia = s.inertia;
    const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
    out.step_before = out.step_after = bound.limit({s, bonds, contacts, walls, clusters}, skin);
    if (share <= 0.0) {
        return out;
    }
    std::vector<double> factor(s.size(), 1.0);
    // First the splits of the springs, with true masses: the step that the share pays for grows from sweep to sweep, then settles.
    StepBound tuned = bound;
    StepBound best = bound;
    double longest = 0.0;
    tuned.level();
    for (int sweep = 0; sweep < 12; ++sweep) {
        const auto demand = tuned.demands({s, bonds, contacts, walls, clusters}, skin);
        const double dt = best_step(share * total, demand, mass, mass, factor);
        if (dt > longest) {
            longest = dt;
            best = tuned;
        }
        for (std::size_t k = 0; k < s.size(); ++k) {
            factor[k] = demand[k].factor(dt);
        }
        tuned.hand_over(factor);
    }
    bound = best;
    // Then the masses. Restitution follows them and the bound follows restitution: a few rounds.
    for (int round = 0; round < 4; ++round) {
        best_step(share * total, bound.demands({s, bonds, contacts, walls, clusters}, skin), s.mass, mass, factor);
        for (std::size_t k = 0; k < s.size(); ++k) {
            s.mass[k] = factor[k] * mass[k];
            s.inertia[k] = factor[k] * inertia[k];
        }
        set_up_laws(s, materials, weight, contacts, walls);
    }
    out.step_after = bound.limit({s, bonds, contacts, walls, clusters}, skin);
    for (std::size_t k = 0; k < s.size(); ++k) {
        out.added += (s.mass[k] - mass[k]) / total;
        out.spheres += factor[k] > 1.0 ? 1 : 0;
        out.largest_factor = std::max(out.largest_factor, factor[k]);
    }
    if (out.spheres > 0) {
        out.mass = mass;
    }
    return out;
}

Easing ease_step(Spheres& s, const Bonds& bonds, const std::vector<Material>& materials, const std::vector<double>& weight,
                 Contacts& contacts, Walls& walls, const Clusters& clusters, double skin, double dt, double allowed,
                 const StepBound& bound) {
    Easing out;
    constexpr double shorter = 0.9;
    constexpr double round_off = 1.0 + 1e-6;
    out.dt = dt;
    // Heavier spheres have stronger dashpots, which ask for a little more again: a few rounds, or a shorter step.
    for (int round = 0; round < 200; ++round) {
        const auto offenders = bound.offenders({s, bonds, contacts, walls, clusters}, skin, out.dt);
        if (offenders.empty()) {
            break;
        }
        double more = 0.0;
        for (const auto& o : offenders) {
            more += (o.factor * round_off - 1.0) * s.mass[o.sphere];
        }
        if (out.added + more > allowed) {
            out.dt *= shorter;
            continue;
        }
        for (const auto& [k, factor] : offenders) {
            const double f = factor * round_off;
            out.energy += 0.5 * (1.0 - 1.0 / f) * (s.mass[k] * s.velocity.at(k).squaredNorm() + s.inertia[k] * s.spin.at(k).squaredNorm());
            s.velocity.set(k, s.velocity.at(k) / f);
            s.spin.set(k, s.spin.at(k) / f);
            s.mass[k] *= f;
            s.inertia[k] *= f;
        }
        out.added += more;
        set_up_laws(s, materials, weight, contacts, walls);
    }
    return out;
}

} // namespace proveta
