#include "core/contacts/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contacts/cell_grid.hpp"
#include "core/contacts/pair_kinematics.hpp"
#include "core/parallel/instruction_set.hpp"

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
    touching.resize(n);
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

// As `set_up_contacts`; team: who shares the work, nobody: the caller alone.
void set_up(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<double>& weight, Contacts& c, Team* team) {
    const std::size_t kinds = materials.size();
    std::vector<LoosePair> pairs;
    pairs.reserve(kinds * kinds);
    for (const auto& a : materials) {
        for (const auto& b : materials) {
            pairs.push_back(loose_pair(a, b));
        }
    }
    c.rolls = std::any_of(pairs.begin(), pairs.end(), [](const LoosePair& p) { return p.rolling > 0.0; });
    c.pulls = std::any_of(pairs.begin(), pairs.end(), [](const LoosePair& p) { return p.tension; });
    c.resize(c.i.size());
    const auto set_up_one = [&](std::size_t k) {
        const auto i = static_cast<std::size_t>(c.i[k]);
        const auto j = static_cast<std::size_t>(c.j[k]);
        c.contact_distance[k] = spheres.radius[i] + spheres.radius[j];
        if (spheres.packed) {
            const Vec3 to = spheres.start.at(j) - spheres.start.at(i);
            c.contact_distance[k] = std::min(distance_at_rest(to.x(), to.y(), to.z()), c.contact_distance[k]);
        }
        const LoosePair& pair =
            pairs[static_cast<std::size_t>(spheres.material[i]) * kinds + static_cast<std::size_t>(spheres.material[j])];
        const auto body = [&](std::size_t s) { return LooseBody{spheres.radius[s], spheres.mass[s], spheres.inertia[s]}; };
        c.law[k] = loose_contact(pair, body(i), body(j), contact_area(pair.area_rule, spheres, i, j, weight[i], weight[j]));
        c.share[k] = lever_share(spheres, c.i[k], c.j[k]);
    };
    constexpr std::size_t per_part = 4096;
    const auto set_up_part = [&](std::size_t part) {
        for (std::size_t k = part * per_part; k < std::min(c.size(), (part + 1) * per_part); ++k) {
            set_up_one(k);
        }
    };
    const std::size_t parts = (c.size() + per_part - 1) / per_part;
    Team alone(1);
    (team != nullptr ? *team : alone).run(parts, set_up_part);
    c.first.assign(1, 0);
    for (std::size_t k = 0; k < c.size(); ++k) {
        const auto block = static_cast<std::size_t>(c.i[k]) / spheres_per_block;
        c.first.resize(std::max(c.first.size(), block + 1), static_cast<std::uint32_t>(k));
    }
    c.first.resize(blocks_of(spheres.size()) + 1, static_cast<std::uint32_t>(c.size()));
    c.incidence = make_incidence(spheres.size(), c.i, c.j);
}

} // namespace

Contacts search_contacts(const Spheres& spheres, const Bonds& bonds, const Clusters& clusters, const std::vector<Material>& materials,
                         const std::vector<double>& weight, double skin, const Contacts& old, Team* team) {
    auto pairs = find_pairs(spheres.position, spheres.radius, 1.0, skin, team);
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
    set_up(spheres, materials, weight, c, team);
    return c;
}

void set_up_contacts(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<double>& weight,
                     Contacts& contacts) {
    set_up(spheres, materials, weight, contacts, nullptr);
}

ContactView Contacts::view() {
    return {i.data(),
            j.data(),
            row_j.data(),
            share.data(),
            contact_distance.data(),
            law.data(),
            {slip.x.data(), slip.y.data(), slip.z.data()},
            {viscous.x.data(), viscous.y.data(), viscous.z.data()},
            normal.data(),
            {force.x.data(), force.y.data(), force.z.data()},
            active.data(),
            touching.data(),
            pulls,
            rolls};
}

ContactEnergies contact_forces(const SphereView& spheres, const Contacts& contacts, const ContactView& view, std::size_t block,
                               const ContactStep& step, Loads& loads) {
    static const ContactKernel kernel = PROVETA_PICK(contact_kernel);
    ContactEnergies sum;
    kernel(spheres, view, loads.rows(), contacts.first[block], contacts.first[block + 1], step, sum);
    return sum;
}

} // namespace proveta
