#include "core/boundaries/platen.hpp"

#include <algorithm>

#include "core/contacts/rolling.hpp"

namespace proveta {

Platen make_platen(const Spheres& spheres, const Face& face, double position, double friction, double area, double capping) {
    Platen p;
    p.face = face;
    p.position = position;
    p.friction = friction;
    p.capped.assign(spheres.size(), 0.0);
    double discs = 0.0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const auto foot = p.foot(spheres.position.at(s));
        if (foot.within && foot.distance <= (1.0 + capping) * spheres.radius[s]) {
            p.capped[s] = foot.distance;
            discs += spheres.section(s);
        }
    }
    p.area_weight = discs > 0.0 && area > 0.0 ? area / discs : 1.0;
    return p;
}

Platen make_wall(const Spheres& spheres, const Face& face, double position, const Material& material, double friction) {
    Platen p;
    p.face = face;
    p.position = position;
    p.friction = friction;
    p.wall = material;
    p.capped.assign(spheres.size(), 0.0);
    return p;
}

void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& p) {
    const Platen old = p;
    p.sphere.clear();
    p.slip.resize(0);
    p.viscous.resize(0);
    std::size_t before = 0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const double touch = p.capped[s] > 0.0 ? p.capped[s] : spheres.radius[s];
        const auto foot = p.foot(spheres.position.at(s));
        if (!foot.within || foot.distance > touch + skin || foot.distance < 0.0) { // behind the surface: escaped, not pressed
            continue;
        }
        const auto id = static_cast<std::int32_t>(s);
        p.sphere.push_back(id);
        while (before < old.sphere.size() && old.sphere[before] < id) {
            ++before;
        }
        const bool known = before < old.sphere.size() && old.sphere[before] == id;
        p.slip.push_back(known ? old.slip.at(before) : Vec3::Zero());
        p.viscous.push_back(known ? old.viscous.at(before) : Vec3::Zero());
    }
    set_up_platen(spheres, materials, p);
}

void set_up_platen(const Spheres& spheres, const std::vector<Material>& materials, Platen& p) {
    std::vector<LoosePair> pairs;
    for (const auto& m : materials) {
        pairs.push_back(p.wall ? wall_pair(m, *p.wall, p.friction) : LoosePair{});
    }
    p.force.resize(p.sphere.size());
    p.contact_distance.clear();
    p.law.clear();
    for (const auto id : p.sphere) {
        const auto s = static_cast<std::size_t>(id);
        const auto material = static_cast<std::size_t>(spheres.material[s]);
        const double r = spheres.radius[s];
        p.contact_distance.push_back(p.capped[s] > 0.0 ? p.capped[s] : r);
        if (p.wall) {
            p.law.push_back(wall_contact(pairs[material], {r, spheres.mass[s], spheres.inertia[s]}, spheres.section(s)));
        } else {
            const Material& m = materials[material];
            LooseContact cap;
            cap.k_n = m.normal_factor * m.young_modulus * p.area_weight * spheres.section(s) / r;
            cap.k_t = bond_law(m).shear_ratio * cap.k_n;
            cap.friction = p.friction;
            cap.tension = p.bonded && p.capped[s] > 0.0;
            p.law.push_back(cap);
        }
    }
}

void PlatenSums::add(const PlatenSums& other) {
    stored += other.stored;
    friction += other.friction;
    dashpot += other.dashpot;
    reaction += other.reaction;
    thrust += other.thrust;
    touching += other.touching;
}

namespace {

// A tangential displacement brought into the plane across n as that turns, its size kept.
Vec3 across(const Vec3& u, const Vec3& n) {
    const Vec3 flat = u - n * n.dot(u);
    const double size = flat.norm();
    return size > 0.0 ? Vec3(flat * (u.norm() / size)) : flat;
}

} // namespace

PlatenSums platen_forces(const Spheres& spheres, Platen& p, const SphereBlock& block, double elapsed, double dt, Loads& loads) {
    PlatenSums sum;
    const ListedRange range = listed_in(p.sphere, block);
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        const auto [distance, n, within] = p.foot(spheres.position.at(s));
        const double approach = (p.velocity * p.face.axis - spheres.velocity.at(s)).dot(n) * elapsed;
        // Contact point at the foot of the sphere: the platen slides along its axis only where that lies across the normal.
        const Vec3 arm = -distance * n;
        const Vec3 relative = p.velocity * p.face.axis - spheres.velocity.at(s) - spheres.spin.at(s).cross(arm);
        const Vec3 sliding = (relative - n * n.dot(relative)) * elapsed;
        const double slip[3] = {sliding.x(), sliding.y(), sliding.z()};
        const Vec3 old_slip = across(p.slip.at(k), n);
        const Vec3 viscous = p.viscous.at(k);
        const Vec3 viscous_t = viscous - n * n.dot(viscous);
        contact::State<double> state{
            {old_slip.x(), old_slip.y(), old_slip.z()}, viscous.dot(n), {viscous_t.x(), viscous_t.y(), viscous_t.z()}};
        const auto r = advance(p.law[k], p.contact_distance[k] - distance, approach, elapsed, slip, state);
        p.slip.set(k, {state.u_t[0], state.u_t[1], state.u_t[2]});
        p.viscous.set(k, Vec3(state.viscous_t[0], state.viscous_t[1], state.viscous_t[2]) + state.viscous * n);
        const Vec3 force = Vec3(r.shear[0], r.shear[1], r.shear[2]) + r.normal * n;
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
        sum.thrust += r.normal;
        sum.touching += r.normal > 0.0 ? 1 : 0;
        sum.stored += r.stored;
        sum.friction += r.friction_work;
        sum.dashpot += r.dashpot_work;
    }
    return sum;
}

} // namespace proveta
