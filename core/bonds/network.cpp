// Building the bond network.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "core/bonds/bonds.hpp"
#include "core/contacts/loads.hpp"
#include "core/contacts/pair_kinematics.hpp"

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
    for (auto* array : {&share, &length, &area, &stiffness, &dashpot, &memory[0], &memory[1], &memory[2], &damage_work}) {
        array->resize(n, 0.0);
    }
    slip.resize(n);
    row_j.resize(n);
    worn.resize(n, 0);
    failures.resize(n);
}

double Bonds::damage(std::size_t bond, const BondGroup& group) const {
    return std::visit(
        [&](const auto& c) {
            using Law = LawOf<decltype(c)>;
            return 1.0 - Law::intact(state<Law>(bond));
        },
        group.law);
}

std::string Bonds::memory_name(std::size_t k) const {
    std::string name;
    for_each_bond_law([&](auto law) {
        using Law = typename decltype(law)::type;
        const bool used = std::any_of(groups.begin(), groups.end(),
                                      [](const BondGroup& g) { return std::holds_alternative<typename Law::Constants>(g.law); });
        typename Law::template State<double> state{};
        std::size_t at = 0;
        Law::members(state, [&](const char* own, double&) {
            if (used && at++ == k && name.find(own) == std::string::npos) {
                name += (name.empty() ? "" : "_or_") + std::string(own);
            }
        });
    });
    return name.empty() ? "memory_" + std::to_string(k) : name; // without bonds there is no law
}

BondView Bonds::view() {
    return {i.data(),
            j.data(),
            row_j.data(),
            length.data(),
            area.data(),
            stiffness.data(),
            share.data(),
            dashpot.data(),
            {slip.x.data(), slip.y.data(), slip.z.data()},
            {memory[0].data(), memory[1].data(), memory[2].data()},
            damage_work.data(),
            mode.data(),
            worn.data(),
            failures.data(),
            {force.x.data(), force.y.data(), force.z.data()},
            normal.data(),
            shear.data(),
            criterion.data(),
            stored.data(),
            {rotation.x.data(), rotation.y.data(), rotation.z.data()},
            {couple.x.data(), couple.y.data(), couple.z.data()},
            dilatation.active() ? dilatation.shift.data() : nullptr,
            dilatation.active() ? dilatation.shift_before.data() : nullptr,
            volumetric.active() ? volumetric.strain.data() : nullptr,
            strength.empty() ? nullptr : strength.data(),
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
    struct PairLaw {
        Material material;
        const Areas* areas = nullptr;
        std::uint32_t group = 0;
    };
    const auto key = [&](const Pair& p) {
        return std::minmax({spheres.material[static_cast<std::size_t>(p.i)], spheres.material[static_cast<std::size_t>(p.j)]});
    };
    std::map<std::pair<int, int>, PairLaw> laws;
    for (const auto& p : pairs) {
        laws.try_emplace(key(p));
    }
    std::map<AreaRule, Areas> by_rule;
    Bonds b;
    b.resize(pairs.size());
    weight.assign(spheres.size(), 1.0);
    for (auto& [both, own] : laws) {
        own.material = equivalent(materials[static_cast<std::size_t>(both.first)], materials[static_cast<std::size_t>(both.second)]);
        const AreaRule rule = own.material.area_rule;
        if (!by_rule.contains(rule)) {
            const bool takes = rule == AreaRule::laguerre;
            if (takes && (given == nullptr || given->pair.size() != pairs.size() || given->weight.size() != spheres.size())) {
                throw std::invalid_argument("the area rule takes areas that were not given");
            }
            by_rule.emplace(rule, takes ? *given : effective_areas(rule, spheres, pairs, skin));
        }
        own.areas = &by_rule.at(rule);
        own.group = static_cast<std::uint32_t>(b.groups.size());
        b.groups.push_back(bond_group(own.material));
        b.damped = b.damped || own.material.local_damping > 0.0;
        b.moments = b.moments || b.groups.back().beams.any();
        for (std::size_t s = 0; s < spheres.size(); ++s) {
            if (both.first == both.second && spheres.material[s] == both.first) {
                weight[s] = own.material.area_factor * own.areas->weight[s];
            }
        }
    }

    struct Entry {
        std::uint32_t block, group;
        std::size_t pair;
    };
    std::vector<Entry> order;
    order.reserve(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const PairLaw& own = laws.at(key(pairs[k]));
        if (own.areas->pair[k] > 0.0) {
            order.push_back({static_cast<std::uint32_t>(pairs[k].i) / spheres_per_block, own.group, k});
        }
    }
    std::sort(order.begin(), order.end(), [&](const Entry& x, const Entry& y) {
        return std::tie(x.block, x.group, pairs[x.pair]) < std::tie(y.block, y.group, pairs[y.pair]);
    });
    b.resize(order.size());
    for (std::size_t at = 0; at < order.size(); ++at) {
        const Entry& entry = order[at];
        const Pair& pair = pairs[entry.pair];
        const PairLaw& own = laws.at(key(pair));
        const Material& m = own.material;
        const auto i = static_cast<std::size_t>(pair.i);
        const auto j = static_cast<std::size_t>(pair.j);
        const Vec3 to = spheres.position.at(j) - spheres.position.at(i);
        const double d = distance_at_rest(to.x(), to.y(), to.z());
        b.i[at] = pair.i;
        b.j[at] = pair.j;
        b.length[at] = d;
        b.area[at] = m.area_factor * own.areas->pair[entry.pair];
        b.stiffness[at] = m.normal_factor * m.young_modulus * b.area[at] / d;
        const double reduced = spheres.mass[i] * spheres.mass[j] / (spheres.mass[i] + spheres.mass[j]);
        b.dashpot[at] = 2.0 * m.local_damping * std::sqrt(reduced * b.stiffness[at]);
        b.share[at] = 0.5 * (d + spheres.radius[i] - spheres.radius[j]) / d;
        const bool starts = at == 0 || order[at - 1].block != entry.block || order[at - 1].group != entry.group;
        if (starts) {
            while (b.first_block.size() <= entry.block) {
                b.first_block.push_back(static_cast<std::uint32_t>(b.blocks.size()));
            }
            b.blocks.push_back({static_cast<std::uint32_t>(at), 0, entry.group});
        }
        b.blocks.back().end = static_cast<std::uint32_t>(at + 1);
    }
    b.first_block.resize(blocks_of(spheres.size()) + 1, static_cast<std::uint32_t>(b.blocks.size()));
    if (b.moments) {
        b.rotation.resize(b.size());
        b.couple.resize(b.size());
    }
    b.incidence = make_incidence(spheres.size(), b.i, b.j);
    std::vector<double> modulus(spheres.size());
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const Material& m = materials[static_cast<std::size_t>(spheres.material[s])];
        modulus[s] = m.averaged_factor * m.normal_factor * m.young_modulus;
    }
    set_dilatation(spheres, modulus, b);
    if (std::any_of(b.groups.begin(), b.groups.end(), [](const BondGroup& g) { return g.volumetric; })) {
        b.volumetric = volumetric_strain(spheres, b);
    }
    return b;
}

} // namespace proveta
