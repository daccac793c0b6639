#include "core/contacts/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "core/contacts/cell_grid.hpp"
#include "core/contacts/linear_law.hpp"
#include "core/contacts/pair_kinematics.hpp"

namespace proveta {

void Contacts::resize(std::size_t n) {
    i.resize(n);
    j.resize(n);
    for (auto* array : {&contact_distance, &stiffness, &shear_stiffness, &dashpot, &friction, &normal}) {
        array->resize(n, 0.0);
    }
    slip.resize(n);
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
        const auto [a, b] = pairs[k];
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        c.i[k] = a;
        c.j[k] = b;
        const double touch = spheres.radius[i] + spheres.radius[j];
        c.contact_distance[k] = std::min((spheres.start.at(j) - spheres.start.at(i)).norm(), touch);
        const Material m =
            equivalent(materials[static_cast<std::size_t>(spheres.material[i])], materials[static_cast<std::size_t>(spheres.material[j])]);
        const double area = contact_area(m.area_rule, spheres, i, j, weight[i], weight[j]);
        c.stiffness[k] = m.normal_factor * m.young_modulus * area / touch;
        c.shear_stiffness[k] = bond_law(m).shear_ratio * c.stiffness[k];
        const double reduced = spheres.mass[i] * spheres.mass[j] / (spheres.mass[i] + spheres.mass[j]);
        c.dashpot[k] = 2.0 * linear::damping_ratio(m.contact_restitution) * std::sqrt(reduced * c.stiffness[k]);
        c.friction[k] = m.bond.mu_d;
        c.forces[k].share_i = lever_share(spheres, a, b);
        while (before < old.size() && Pair{old.i[before], old.j[before]} < pairs[k]) {
            ++before;
        }
        if (before < old.size() && Pair{old.i[before], old.j[before]} == pairs[k]) {
            c.slip.set(k, old.slip.at(before));
        }
    }
    c.incidence = make_incidence(spheres.size(), c.i, c.j);
    return c;
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
            const linear::Parameters<double> p{contacts.stiffness[k], contacts.shear_stiffness[k], contacts.dashpot[k],
                                               contacts.friction[k]};
            const auto r =
                linear::advance<double>(p, contacts.contact_distance[k] - pair.distance, -pair.separation * dt, dt, pair.slip, pair.turned);
            contacts.slip.set(k, {pair.turned[0], pair.turned[1], pair.turned[2]});
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

} // namespace proveta
