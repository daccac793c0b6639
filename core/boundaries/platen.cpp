#include "core/boundaries/platen.hpp"

#include <algorithm>

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
        if (face.reaches(foot, spheres.radius[s]) && foot.distance <= (1.0 + capping) * spheres.radius[s]) {
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
        if (foot.distance > touch + skin || foot.distance < 0.0) { // behind the surface: escaped, not pressed
            continue;
        }
        // Whether a sphere lies under a strip is settled at the start: one that came in from its edge would be deep in it at once.
        if (!p.face.reaches(p.foot(spheres.start.at(s)), spheres.radius[s])) {
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
            cap.k_t = m.shear_ratio() * cap.k_n;
            cap.friction = p.friction;
            cap.tension = p.bonded && p.capped[s] > 0.0;
            p.law.push_back(cap);
        }
    }
}

WallSums platen_forces(const Spheres& spheres, Platen& p, const SphereBlock& block, const ContactStep& step, Loads& loads) {
    WallSums sum;
    const ListedRange range = listed_in(p.sphere, block);
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        const auto [distance, n, aside] = p.foot(spheres.position.at(s));
        WallHistory history{p.slip.at(k), p.viscous.at(k)};
        const auto load =
            advance_wall(spheres, s, p.law[k], p.contact_distance[k], {distance, n, p.velocity * p.face.axis}, step, history, sum);
        p.slip.set(k, history.slip);
        p.viscous.set(k, history.viscous);
        p.force.set(k, load.force);
        loads.add(s, load.force, load.torque);
    }
    return sum;
}

} // namespace proveta
