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
    for (auto* array : {&contact_distance, &normal, &share}) {
        array->resize(n, 0.0);
    }
    row_j.resize(n);
    law.resize(n);
    slip.resize(n);
    viscous.resize(n);
    force.resize(n);
    active.resize(n, 1);
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

Contacts search_contacts(const Spheres& spheres, const Bonds& bonds, const Clusters& clusters, const std::vector<Material>& materials,
                         const std::vector<double>& weight, double skin, const Contacts& old) {
    auto pairs = find_pairs(spheres.position, spheres.radius, 1.0, skin);
    std::erase_if(pairs, [&](const Pair& p) {
        const std::int32_t body = clusters.of(static_cast<std::size_t>(p.i));
        return bonded(bonds, p) || (body >= 0 && body == clusters.of(static_cast<std::size_t>(p.j)));
    });

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
    c.first.assign(1, 0);
    for (std::size_t k = 0; k < c.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.i[k]);
        const auto j = static_cast<std::size_t>(c.j[k]);
        c.first.resize(std::max(c.first.size(), i / spheres_per_block + 1), static_cast<std::uint32_t>(k));
        c.contact_distance[k] = spheres.radius[i] + spheres.radius[j];
        if (spheres.packed) {
            const Vec3 to = spheres.start.at(j) - spheres.start.at(i);
            c.contact_distance[k] = std::min(distance_at_rest(to.x(), to.y(), to.z()), c.contact_distance[k]);
        }
        const LoosePair& pair =
            pairs[static_cast<std::size_t>(spheres.material[i]) * kinds + static_cast<std::size_t>(spheres.material[j])];
        const auto body = [&](std::size_t s) { return LooseBody{spheres.radius[s], spheres.mass[s], spheres.inertia[s]}; };
        c.law[k] = loose_contact(pair, body(i), body(j), contact_area(pair.area_rule, spheres, i, j, weight[i], weight[j]));
        c.rolls = c.rolls || c.law[k].rolling_arm > 0.0;
        c.share[k] = lever_share(spheres, c.i[k], c.j[k]);
    }
    c.first.resize(blocks_of(spheres.size()) + 1, static_cast<std::uint32_t>(c.size()));
    c.incidence = make_incidence(spheres.size(), c.i, c.j);
}

ContactEnergies contact_forces(const Spheres& spheres, Contacts& contacts, std::size_t block, double elapsed, double dt, Loads& loads) {
    const SphereView view = spheres.view();
    ContactEnergies sum;
    for (auto k = contacts.first[block]; k < contacts.first[block + 1]; ++k) {
        const auto i = static_cast<std::size_t>(contacts.i[k]);
        const auto j = static_cast<std::size_t>(contacts.j[k]);
        const double reach = contacts.contact_distance[k];
        const bool apart = (spheres.position.at(j) - spheres.position.at(i)).squaredNorm() > reach * reach;
        if (apart && contacts.active[k] == 0 && !contacts.law[k].tension) {
            continue; // most of the list: neighbours that do not touch
        }
        contacts.active[k] = apart ? 0 : 1;
        const double old[3] = {contacts.slip.x[k], contacts.slip.y[k], contacts.slip.z[k]};
        auto pair = pair_kinematics<double>(view, &contacts.i[k], &contacts.j[k], contacts.share[k], old, elapsed);
        // The dashpots' last force, taken apart along the pair's present frame.
        const double last[3] = {contacts.viscous.x[k], contacts.viscous.y[k], contacts.viscous.z[k]};
        const double pulled = last[0] * pair.n[0] + last[1] * pair.n[1] + last[2] * pair.n[2];
        contact::State<double> state;
        state.viscous = -pulled;
        for (int c = 0; c < 3; ++c) {
            state.u_t[c] = pair.turned[c];
            state.viscous_t[c] = last[c] - pulled * pair.n[c];
        }
        const auto r = advance(contacts.law[k], reach - pair.distance, -pair.separation * elapsed, elapsed, pair.slip, state);
        contacts.slip.set(k, {state.u_t[0], state.u_t[1], state.u_t[2]});
        contacts.viscous.set(k, {state.viscous_t[0] - state.viscous * pair.n[0], state.viscous_t[1] - state.viscous * pair.n[1],
                                 state.viscous_t[2] - state.viscous * pair.n[2]});
        contacts.normal[k] = r.normal;
        double couple[3] = {0.0, 0.0, 0.0};
        const LooseContact& law = contacts.law[k];
        if (law.rolling_arm > 0.0 && r.normal > 0.0) {
            const Vec3 spin = spheres.spin.at(i) - spheres.spin.at(j);
            const double relative[3] = {spin.x(), spin.y(), spin.z()};
            const auto rolling = rolling::torque<double>(law.rolling_arm, r.normal, law.reduced_inertia, relative, dt);
            std::copy_n(rolling.torque, 3, couple);
            sum.friction += rolling.power * elapsed;
        }
        const auto force =
            add_pair_loads(loads.rows(), &contacts.i[k], &contacts.row_j[k], pair, contacts.share[k], r.normal, r.shear, couple);
        contacts.force.set(k, {force.x[0], force.x[1], force.x[2]});
        sum.stored += r.stored;
        sum.friction += r.friction_work;
        sum.dashpot += r.dashpot_work;
    }
    return sum;
}

} // namespace proveta
