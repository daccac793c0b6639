#include "core/boundaries/platen.hpp"

#include <algorithm>

#include "core/contacts/rolling.hpp"

namespace proveta {

Platen make_platen(const Spheres& spheres, double position, double inward, double friction, double end_area, double capping) {
    Platen p;
    p.position = position;
    p.inward = inward;
    p.friction = friction;
    p.capped.assign(spheres.size(), 0.0);
    double discs = 0.0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const double distance = (spheres.position.z[s] - position) * inward;
        const double r = spheres.radius[s];
        if (distance <= (1.0 + capping) * r) {
            p.capped[s] = distance;
            discs += spheres.section(s);
        }
    }
    p.area_weight = discs > 0.0 ? end_area / discs : 1.0;
    return p;
}

Platen make_wall(const Spheres& spheres, double position, double inward, const Material& face, double friction) {
    Platen p;
    p.position = position;
    p.inward = inward;
    p.friction = friction;
    p.face = face;
    p.capped.assign(spheres.size(), 0.0);
    return p;
}

void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& p) {
    const Platen old = p;
    p.sphere.clear();
    p.slip_x.clear();
    p.slip_y.clear();
    p.viscous.resize(0);
    std::size_t before = 0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const double touch = p.capped[s] > 0.0 ? p.capped[s] : spheres.radius[s];
        const double distance = (spheres.position.z[s] - p.position) * p.inward;
        if (distance > touch + skin || distance < 0.0) { // behind the plane: escaped, not pressed
            continue;
        }
        const auto id = static_cast<std::int32_t>(s);
        p.sphere.push_back(id);
        while (before < old.sphere.size() && old.sphere[before] < id) {
            ++before;
        }
        const bool known = before < old.sphere.size() && old.sphere[before] == id;
        p.slip_x.push_back(known ? old.slip_x[before] : 0.0);
        p.slip_y.push_back(known ? old.slip_y[before] : 0.0);
        p.viscous.push_back(known ? old.viscous.at(before) : Vec3::Zero());
    }
    set_up_platen(spheres, materials, p);
}

void set_up_platen(const Spheres& spheres, const std::vector<Material>& materials, Platen& p) {
    std::vector<LoosePair> pairs;
    for (const auto& m : materials) {
        pairs.push_back(p.face ? wall_pair(m, *p.face, p.friction) : LoosePair{});
    }
    p.force.resize(p.sphere.size());
    p.contact_distance.clear();
    p.law.clear();
    for (const auto id : p.sphere) {
        const auto s = static_cast<std::size_t>(id);
        const auto material = static_cast<std::size_t>(spheres.material[s]);
        const double r = spheres.radius[s];
        p.contact_distance.push_back(p.capped[s] > 0.0 ? p.capped[s] : r);
        if (p.face) {
            p.law.push_back(wall_contact(pairs[material], {r, spheres.mass[s], spheres.inertia[s]}, spheres.section(s)));
        } else {
            const Material& m = materials[material];
            LooseContact cap;
            cap.k_n = m.normal_factor * m.young_modulus * p.area_weight * spheres.section(s) / r;
            cap.k_t = bond_law(m).shear_ratio * cap.k_n;
            cap.friction = p.friction;
            p.law.push_back(cap);
        }
    }
}

void PlatenSums::add(const PlatenSums& other) {
    stored += other.stored;
    friction += other.friction;
    dashpot += other.dashpot;
    reaction += other.reaction;
    touching += other.touching;
}

PlatenSums platen_forces(const Spheres& spheres, Platen& p, const SphereBlock& block, double elapsed, double dt, Loads& loads) {
    PlatenSums sum;
    const ListedRange range = listed_in(p.sphere, block);
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        const double distance = (spheres.position.z[s] - p.position) * p.inward;
        const double approach = (p.velocity - spheres.velocity.z[s]) * p.inward * elapsed;
        // Contact point at the foot of the sphere: platen's velocity there minus the sphere's.
        const Vec3 arm(0.0, 0.0, -distance * p.inward);
        const Vec3 at_contact = spheres.velocity.at(s) + spheres.spin.at(s).cross(arm);
        const double slip[3] = {-at_contact.x() * elapsed, -at_contact.y() * elapsed, 0.0};
        contact::State<double> state{{p.slip_x[k], p.slip_y[k], 0.0}, p.viscous.z[k] * p.inward, {p.viscous.x[k], p.viscous.y[k], 0.0}};
        const auto r = advance(p.law[k], p.contact_distance[k] - distance, approach, elapsed, slip, state);
        p.slip_x[k] = state.u_t[0];
        p.slip_y[k] = state.u_t[1];
        p.viscous.set(k, {state.viscous_t[0], state.viscous_t[1], state.viscous * p.inward});
        const Vec3 force(r.shear[0], r.shear[1], r.normal * p.inward);
        p.force.set(k, force);
        Vec3 torque = arm.cross(force);
        if (p.law[k].rolling_arm > 0.0) {
            const double spin[3] = {spheres.spin.x[s], spheres.spin.y[s], spheres.spin.z[s]};
            const auto rolling = rolling::torque<double>(p.law[k].rolling_arm, r.normal, p.law[k].reduced_inertia, spin, dt);
            torque += Vec3(rolling.torque[0], rolling.torque[1], rolling.torque[2]);
            sum.friction += rolling.power * elapsed;
        }
        loads.add(s, force, torque);
        sum.reaction -= force;
        sum.touching += r.normal > 0.0 ? 1 : 0;
        sum.stored += r.stored;
        sum.friction += r.friction_work;
        sum.dashpot += r.dashpot_work;
    }
    return sum;
}

} // namespace proveta
