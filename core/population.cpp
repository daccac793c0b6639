// Model::repopulate: spheres and clusters come, go and change places between steps.
#include <algorithm>
#include <stdexcept>

#include "core/model.hpp"

namespace proveta {

namespace {

double kinetic_energy(const Spheres& s, std::size_t k) {
    return 0.5 * s.mass[k] * s.velocity.at(k).squaredNorm() + 0.5 * s.inertia[k] * s.spin.at(k).squaredNorm();
}

double kinetic_energy(const Clusters& c, std::size_t body) {
    return 0.5 * c.mass[body] * c.velocity[body].squaredNorm() + rotation::energy(c.turning[body]);
}

// Kinetic energy of the bodies for which counts(first sphere) holds.
template <class Counts> double kinetic_energy(const Spheres& spheres, const Clusters& clusters, const Counts& counts) {
    double sum = 0.0;
    for (std::size_t k = 0; k < clusters.alone(spheres); ++k) {
        sum += counts(k) ? kinetic_energy(spheres, k) : 0.0;
    }
    for (std::size_t body = 0; body < clusters.size(); ++body) {
        sum += counts(clusters.first[body]) ? kinetic_energy(clusters, body) : 0.0;
    }
    return sum;
}

// Work of gravity since the start on the bodies that are gone.
double body_work_of_gone(const Spheres& spheres, const Clusters& clusters, const std::vector<std::int32_t>& now, const Vec3& gravity) {
    double sum = 0.0;
    for (std::size_t k = 0; k < clusters.alone(spheres); ++k) {
        sum += now[k] < 0 ? spheres.mass[k] * gravity.dot(spheres.position.at(k) - spheres.start.at(k)) : 0.0;
    }
    for (std::size_t body = 0; body < clusters.size(); ++body) {
        sum += now[clusters.first[body]] < 0 ? clusters.mass[body] * gravity.dot(clusters.position[body] - clusters.start[body]) : 0.0;
    }
    return sum;
}

// A contact on its way from one numbering to another.
struct Carried {
    Pair pair;
    Vec3 slip, viscous; // as i of the pair sees them
};

// The list of contacts in the new numbering, as far as `search_contacts` reads it; lost: energy of those of gone spheres.
Contacts carried_over(const Spheres& old, const Contacts& contacts, const std::vector<std::int32_t>& now, double& lost) {
    std::vector<Carried> kept;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const auto i = static_cast<std::size_t>(contacts.i[k]);
        const auto j = static_cast<std::size_t>(contacts.j[k]);
        if (now[i] < 0 || now[j] < 0) {
            const double overlap = contacts.contact_distance[k] - (old.position.at(j) - old.position.at(i)).norm();
            lost += stored_energy(contacts.law[k], overlap, contacts.slip.at(k).norm());
        } else {
            const bool turned = now[i] > now[j];
            const double sign = turned ? -1.0 : 1.0;
            kept.push_back(
                {turned ? Pair{now[j], now[i]} : Pair{now[i], now[j]}, sign * contacts.slip.at(k), sign * contacts.viscous.at(k)});
        }
    }
    std::sort(kept.begin(), kept.end(), [](const Carried& a, const Carried& b) { return a.pair < b.pair; });
    Contacts out;
    out.resize(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
        out.i[k] = kept[k].pair.i;
        out.j[k] = kept[k].pair.j;
        out.slip.set(k, kept[k].slip);
        out.viscous.set(k, kept[k].viscous);
    }
    return out;
}

} // namespace

void Model::repopulate(Spheres next, Clusters bodies, const std::vector<std::int32_t>& origin) {
    if (bonds.size() > 0 || !walls.platens.empty() || !pressures.empty() || !scaling_.mass.empty()) {
        throw std::logic_error("only loose particles among surfaces can be exchanged");
    }
    std::vector<std::int32_t> now(spheres.size(), -1);
    for (std::size_t k = 0; k < origin.size(); ++k) {
        if (origin[k] >= 0) {
            now[static_cast<std::size_t>(origin[k])] = static_cast<std::int32_t>(k);
        }
    }
    double lost = kinetic_energy(spheres, clusters, [&](std::size_t k) { return now[k] < 0; });
    body_gone_ += body_work_of_gone(spheres, clusters, now, numerics_.gravity);
    contacts = carried_over(spheres, contacts, now, lost);
    for (auto& surface : walls.surfaces) {
        lost += surface.renumber(spheres, now, next.size());
    }
    for (auto& body : walls.bodies) {
        lost += body.renumber(now, next.size());
    }
    spheres = std::move(next);
    clusters = std::move(bodies);
    if (steps_ > 0) { // else the first step looks for itself
        ledger_.initial += kinetic_energy(spheres, clusters, [&](std::size_t k) { return origin[k] < 0; }) - lost;
    }
    mean_radius_ = mean_radius(spheres);
    bonds = make_bonds(spheres, materials, {}, std::vector<std::uint8_t>(spheres.size(), 0), weight_);
    bound_ = StepBound(spheres, bonds);
    loads = Loads(spheres.size());
    block_sums_.resize(loads.blocks().size());
    search_anew_ = true;
}

void Model::set_skin(double skin) {
    skin_ = skin;
    search_anew_ = true;
}

} // namespace proveta
