// Building the bond network.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "core/bonds/bonds.hpp"

namespace proveta {

namespace {

std::vector<Pair> same_group(const Spheres& s, std::vector<Pair> pairs) {
    std::erase_if(pairs, [&](const Pair& p) { return s.group[static_cast<std::size_t>(p.i)] != s.group[static_cast<std::size_t>(p.j)]; });
    return pairs;
}

// Gap of a pair over the sum of radii: the smallest beta that bonds it.
double needed_beta(const Spheres& s, const Pair& p) {
    const auto i = static_cast<std::size_t>(p.i);
    const auto j = static_cast<std::size_t>(p.j);
    return (s.position.at(j) - s.position.at(i)).norm() / (s.radius[i] + s.radius[j]) - 1.0;
}

} // namespace

void Bonds::resize(std::size_t n) {
    i.resize(n);
    j.resize(n);
    mode.resize(n, 0);
    for (auto* array : {&length, &area, &stiffness, &dashpot, &plastic, &damage_n, &damage_t, &damage_work}) {
        array->resize(n, 0.0);
    }
    slip.resize(n);
    forces.resize(n);
}

BondView Bonds::view() {
    return {i.data(),
            j.data(),
            length.data(),
            area.data(),
            stiffness.data(),
            dashpot.data(),
            {slip.x.data(), slip.y.data(), slip.z.data()},
            plastic.data(),
            damage_n.data(),
            damage_t.data(),
            damage_work.data(),
            mode.data(),
            forces.data(),
            normal.data(),
            shear.data(),
            criterion.data(),
            stored.data(),
            {rotation.x.data(), rotation.y.data(), rotation.z.data()},
            {couple.x.data(), couple.y.data(), couple.z.data()},
            damped};
}

std::vector<Pair> bonded_pairs(const Spheres& spheres, const BondingRule& rule, double& beta) {
    if (rule.coordination <= 0.0) {
        beta = std::max(rule.beta, 0.0);
        return same_group(spheres, find_pairs(spheres.position, spheres.radius, 1.0 + beta, 0.0));
    }
    // The wished number of bonds is met exactly (up to one bond) by taking the pairs with the smallest gaps.
    const auto wanted = static_cast<std::size_t>(std::llround(0.5 * rule.coordination * static_cast<double>(spheres.size())));
    const double mean_radius =
        std::accumulate(spheres.radius.begin(), spheres.radius.end(), 0.0) / std::max<double>(1.0, static_cast<double>(spheres.size()));
    const auto gap = [&](const Pair& p) {
        const double sum = spheres.radius[static_cast<std::size_t>(p.i)] + spheres.radius[static_cast<std::size_t>(p.j)];
        return needed_beta(spheres, p) * (rule.absolute ? sum : 1.0);
    };
    for (const double reach : {0.2, 0.4, 0.8}) {
        auto pairs = same_group(spheres, rule.absolute ? find_pairs(spheres.position, spheres.radius, 1.0, 2.0 * reach * mean_radius)
                                                       : find_pairs(spheres.position, spheres.radius, 1.0 + reach, 0.0));
        std::vector<double> needed(pairs.size());
        std::transform(pairs.begin(), pairs.end(), needed.begin(), gap);
        if (wanted == 0 || pairs.size() < wanted) {
            continue;
        }
        auto sorted = needed;
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(wanted - 1), sorted.end());
        const double widest = std::max(sorted[wanted - 1], 0.0); // overlapping pairs are always bonded
        std::vector<Pair> kept;
        beta = 0.0;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            if (needed[k] <= widest) {
                kept.push_back(pairs[k]);
                beta = std::max(beta, needed_beta(spheres, pairs[k]));
            }
        }
        return kept;
    }
    throw std::runtime_error("no interaction range below 0.8 gives the wished mean coordination");
}

Bonds make_bonds(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<Pair>& pairs,
                 const std::vector<std::uint8_t>& skin, std::vector<double>& weight, const Areas* given) {
    // Material pairs get a law each, in ascending order of their indices.
    auto key = [&](const Pair& p) {
        return std::minmax({spheres.material[static_cast<std::size_t>(p.i)], spheres.material[static_cast<std::size_t>(p.j)]});
    };
    std::map<std::pair<int, int>, std::vector<Pair>> sorted;
    for (const auto& p : pairs) {
        sorted[key(p)].push_back(p);
    }

    std::map<AreaRule, Areas> by_rule;
    Bonds b;
    b.resize(pairs.size());
    weight.assign(spheres.size(), 1.0);
    std::map<Pair, std::size_t> place;
    const bool mixed = sorted.size() > 1;
    if (mixed) {
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            place[pairs[k]] = k;
        }
    }
    std::size_t at = 0;
    for (const auto& [both, members] : sorted) {
        const Material m = equivalent(materials[static_cast<std::size_t>(both.first)], materials[static_cast<std::size_t>(both.second)]);
        auto found = by_rule.find(m.area_rule);
        if (found == by_rule.end()) {
            const bool takes = m.area_rule == AreaRule::laguerre;
            if (takes && (given == nullptr || given->pair.size() != pairs.size() || given->weight.size() != spheres.size())) {
                throw std::invalid_argument("the area rule takes areas that were not given");
            }
            found = by_rule.emplace(m.area_rule, takes ? *given : effective_areas(m.area_rule, spheres, pairs, skin)).first;
        }
        const Areas& areas = found->second;
        const auto law = static_cast<std::uint32_t>(b.laws.size());
        b.laws.push_back(bond_law(m));
        const std::size_t first = at;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const double area = areas.pair[mixed ? place.at(members[k]) : k];
            if (area <= 0.0) {
                continue;
            }
            const auto i = static_cast<std::size_t>(members[k].i);
            const auto j = static_cast<std::size_t>(members[k].j);
            const double d = (spheres.position.at(j) - spheres.position.at(i)).norm();
            b.i[at] = members[k].i;
            b.j[at] = members[k].j;
            b.length[at] = d;
            b.area[at] = m.area_factor * area;
            b.stiffness[at] = m.normal_factor * m.young_modulus * b.area[at] / d;
            const double reduced = spheres.mass[i] * spheres.mass[j] / (spheres.mass[i] + spheres.mass[j]);
            b.dashpot[at] = 2.0 * m.local_damping * std::sqrt(reduced * b.stiffness[at]);
            b.damped = b.damped || m.local_damping > 0.0;
            b.moments = b.moments || m.bond.has_moments();
            b.forces[at].share_i = 0.5 * (d + spheres.radius[i] - spheres.radius[j]) / d;
            ++at;
        }
        for (std::size_t k = first; k < at; k += bond_block) {
            b.blocks.push_back({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(std::min(at, k + bond_block)), law});
        }
        for (std::size_t s = 0; s < spheres.size(); ++s) {
            const int material = spheres.material[s];
            if (both.first == both.second && material == both.first) {
                weight[s] = m.area_factor * areas.weight[s];
            }
        }
    }
    b.resize(at);
    if (b.moments) {
        b.rotation.resize(b.size());
        b.couple.resize(b.size());
    }
    b.incidence = make_incidence(spheres.size(), b.i, b.j);
    return b;
}

} // namespace proveta
