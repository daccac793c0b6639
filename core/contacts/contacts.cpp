#include "core/contacts/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contacts/cell_grid.hpp"
#include "core/contacts/pair_kinematics.hpp"
#include "core/contacts/rolling.hpp"

namespace proveta {

void Contacts::resize(std::size_t n) {
    i.resize(n);
    j.resize(n);
    for (auto* array : {&contact_distance, &normal}) {
        array->resize(n, 0.0);
    }
    law.resize(n);
    slip.resize(n);
    viscous.resize(n);
    forces.resize(n);
}

double lever_share(const Spheres& spheres, std::int32_t i, std::int32_t j) {
    const double r_i = spheres.radius[static_cast<std::size_t>(i)];
    return r_i / (r_i + spheres.radius[static_cast<std::size_t>(j)]);
}

namespace {

bool bonded(const Bonds& bonds, const Pair& p) {
    const auto& in = bonds.incidence;
    const auto i = static_cast<std::size_t>(p.i);
    for (auto k = in.offset[i]; k < in.offset[i + 1]; ++k) {
        const auto b = in.entry[k] / 2;
        if (bonds.j[b] == p.j || bonds.i[b] == p.j) {
            return true;
        }
    }
    return false;
}

} // namespace

Contacts search_contacts(const Spheres& spheres, const Bonds& bonds, const std::vector<Material>& materials,
                         const std::vector<double>& weight, double skin, const Contacts& old) {
    auto pairs = find_pairs(spheres.position, spheres.radius, 1.0, skin);
    std::erase_if(pairs, [&](const Pair& p) { return bonded(bonds, p); });

    Contacts c;
    c.resize(pairs.size());
    std::size_t before = 0; // both lists are sorted by (i, j)
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        c.i[k] = pairs[k].i;
        c.j[k] = pairs[k].j;
        while (before < old.size() && Pair{old.i[before], old.j[before]} < pairs[k]) {
            ++before;
        }
        if (before < old.size() && Pair{old.i[before], old.j[before]} == pairs[k]) {
            c.slip.set(k, old.slip.at(before));
            c.viscous.set(k, old.viscous.at(before));
        }
    }
    set_up_contacts(spheres, materials, weight, c);
    return c;
}

void set_up_contacts(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<double>& weight, Contacts& c) {
    const std::size_t kinds = materials.size();
    std::vector<LoosePair> pairs;
    pairs.reserve(kinds * kinds);
    for (const auto& a : materials) {
        for (const auto& b : materials) {
            pairs.push_back(loose_pair(a, b));
        }
    }
    c.resize(c.i.size());
    c.rolls = false;
    for (std::size_t k = 0; k < c.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.i[k]);
        const auto j = static_cast<std::size_t>(c.j[k]);
        const double r_i = spheres.radius[i];
        const double r_j = spheres.radius[j];
        c.contact_distance[k] = std::min((spheres.start.at(j) - spheres.start.at(i)).norm(), r_i + r_j);
        const LoosePair& pair =
            pairs[static_cast<std::size_t>(spheres.material[i]) * kinds + static_cast<std::size_t>(spheres.material[j])];
        c.law[k] = loose_contact(pair, {r_i, spheres.mass[i], spheres.inertia[i]}, {r_j, spheres.mass[j], spheres.inertia[j]},
                                 contact_area(pair.area_rule, r_i, r_j, weight[i], weight[j]));
        c.rolls = c.rolls || c.law[k].rolling_arm > 0.0;
        c.forces[k].share_i = lever_share(spheres, c.i[k], c.j[k]);
    }
    c.incidence = make_incidence(spheres.size(), c.i, c.j);
}

ContactEnergies contact_forces(const Spheres& spheres, Contacts& contacts, double dt) {
    constexpr std::size_t block = 512;
    const std::size_t n = contacts.size();
    const SphereView view = spheres.view();
    std::vector<ContactEnergies> parts((n + block - 1) / block);
#pragma omp parallel for schedule(static) if (n > 4 * block)
    for (std::size_t part = 0; part < parts.size(); ++part) {
        for (std::size_t k = part * block; k < std::min(n, (part + 1) * block); ++k) {
            const double old[3] = {contacts.slip.x[k], contacts.slip.y[k], contacts.slip.z[k]};
            auto pair = pair_kinematics<double>(view, &contacts.i[k], &contacts.j[k], contacts.forces[k].share_i, old, dt);
            // The dashpots' last force, taken apart along the pair's present frame.
            const double last[3] = {contacts.viscous.x[k], contacts.viscous.y[k], contacts.viscous.z[k]};
            const double pulled = last[0] * pair.n[0] + last[1] * pair.n[1] + last[2] * pair.n[2];
            contact::State<double> state;
            state.viscous = -pulled;
            for (int c = 0; c < 3; ++c) {
                state.u_t[c] = pair.turned[c];
                state.viscous_t[c] = last[c] - pulled * pair.n[c];
            }
            const auto r =
                advance(contacts.law[k], contacts.contact_distance[k] - pair.distance, -pair.separation * dt, dt, pair.slip, state);
            contacts.slip.set(k, {state.u_t[0], state.u_t[1], state.u_t[2]});
            contacts.viscous.set(k, {state.viscous_t[0] - state.viscous * pair.n[0], state.viscous_t[1] - state.viscous * pair.n[1],
                                     state.viscous_t[2] - state.viscous * pair.n[2]});
            contacts.normal[k] = r.normal;
            store_pair_forces(&contacts.forces[k], pair, r.normal, r.shear);
            parts[part].stored += r.stored;
            parts[part].friction += r.friction_work;
            parts[part].dashpot += r.dashpot_work;
        }
    }
    ContactEnergies sum;
    for (const auto& p : parts) {
        sum.stored += p.stored;
        sum.friction += p.friction;
        sum.dashpot += p.dashpot;
    }
    return sum;
}

double rolling_torques(Spheres& s, const Contacts& contacts, double dt) {
    std::vector<double> power(s.size(), 0.0);
    const auto& in = contacts.incidence;
#pragma omp parallel for schedule(static) if (s.size() > 1024)
    for (std::size_t k = 0; k < s.size(); ++k) {
        Vec3 sum = Vec3::Zero();
        for (auto e = in.offset[k]; e < in.offset[k + 1]; ++e) {
            const auto p = in.entry[e] >> 1;
            const LooseContact& law = contacts.law[p];
            if (!(contacts.normal[p] > 0.0 && law.rolling_arm > 0.0)) {
                continue;
            }
            const bool second = (in.entry[e] & 1u) != 0;
            const Vec3 spin = s.spin.at(k) - s.spin.at(static_cast<std::size_t>(second ? contacts.i[p] : contacts.j[p]));
            const double relative[3] = {spin.x(), spin.y(), spin.z()};
            const auto r = rolling::torque<double>(law.rolling_arm, contacts.normal[p], law.reduced_inertia, relative, dt);
            sum += Vec3(r.torque[0], r.torque[1], r.torque[2]);
            power[k] += 0.5 * r.power; // each side of the pair counts half
        }
        s.external_torque.add(k, sum);
    }
    return std::accumulate(power.begin(), power.end(), 0.0);
}

} // namespace proveta
