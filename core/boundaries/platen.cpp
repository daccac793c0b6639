#include "core/boundaries/platen.hpp"

#include <algorithm>

#include "core/contacts/linear_law.hpp"

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

void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& p) {
    Platen old = p;
    p.sphere.clear();
    for (auto* array : {&p.contact_distance, &p.stiffness, &p.shear_stiffness, &p.slip_x, &p.slip_y}) {
        array->clear();
    }
    std::size_t before = 0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        const double r = spheres.radius[s];
        const double touch = p.capped[s] > 0.0 ? p.capped[s] : r;
        const double distance = (spheres.position.z[s] - p.position) * p.inward;
        if (distance > touch + skin || distance < 0.0) { // behind the plane: escaped, not pressed
            continue;
        }
        const Material& m = materials[static_cast<std::size_t>(spheres.material[s])];
        const auto id = static_cast<std::int32_t>(s);
        p.sphere.push_back(id);
        p.contact_distance.push_back(touch);
        p.stiffness.push_back(m.normal_factor * m.young_modulus * p.area_weight * spheres.section(s) / r);
        p.shear_stiffness.push_back(bond_law(m).shear_ratio * p.stiffness.back());
        while (before < old.sphere.size() && old.sphere[before] < id) {
            ++before;
        }
        const bool known = before < old.sphere.size() && old.sphere[before] == id;
        p.slip_x.push_back(known ? old.slip_x[before] : 0.0);
        p.slip_y.push_back(known ? old.slip_y[before] : 0.0);
    }
}

PlatenEnergies platen_forces(Spheres& spheres, Platen& p, double dt) {
    PlatenEnergies sum;
    p.reaction = Vec3::Zero();
    p.force.resize(p.sphere.size());
    p.touching = 0;
    for (std::size_t k = 0; k < p.sphere.size(); ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        const double distance = (spheres.position.z[s] - p.position) * p.inward;
        const double approach = (p.velocity - spheres.velocity.z[s]) * p.inward * dt;
        // Contact point at the foot of the sphere: platen's velocity there minus the sphere's.
        const Vec3 arm(0.0, 0.0, -distance * p.inward);
        const Vec3 at_contact = spheres.velocity.at(s) + spheres.spin.at(s).cross(arm);
        const double slip[3] = {-at_contact.x() * dt, -at_contact.y() * dt, 0.0};
        double u_t[3] = {p.slip_x[k], p.slip_y[k], 0.0};
        const linear::Parameters<double> law{p.stiffness[k], p.shear_stiffness[k], 0.0, p.friction};
        const auto r = linear::advance<double>(law, p.contact_distance[k] - distance, approach, dt, slip, u_t);
        p.slip_x[k] = u_t[0];
        p.slip_y[k] = u_t[1];
        const Vec3 force(r.shear[0], r.shear[1], r.normal * p.inward);
        p.force.set(k, force);
        spheres.external_force.add(s, force);
        spheres.external_torque.add(s, arm.cross(force));
        p.reaction -= force;
        p.touching += r.normal > 0.0 ? 1 : 0;
        sum.stored += r.stored;
        sum.friction += r.friction_work;
        sum.dashpot += r.dashpot_work;
    }
    return sum;
}

} // namespace proveta
