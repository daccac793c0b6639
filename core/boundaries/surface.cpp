#include "core/boundaries/surface.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

Surface::Surface(std::string called, SurfaceMesh mesh, const Material& wall, double friction_coefficient)
    : name(std::move(called)), geometry(std::move(mesh)), tree(geometry.mesh), material(wall), friction(friction_coefficient) {
    for (const auto& v : geometry.mesh.vertex) {
        reach_ = std::max(reach_, v.norm());
    }
}

void Surface::move(double dt) {
    motion = drive;
    origin += dt * motion.velocity;
    if (!motion.spin.isZero()) {
        attitude = (rotation::turn(motion.spin, dt) * attitude).normalized();
    }
}

const LooseContact& Surface::law_of(const SurfaceTouch& touch) const {
    return law[static_cast<std::size_t>(std::lower_bound(sphere.begin(), sphere.end(), touch.sphere) - sphere.begin())];
}

double Surface::overlap_of(const SurfaceTouch& touch, const Spheres& spheres) const {
    const auto s = static_cast<std::size_t>(touch.sphere);
    return spheres.radius[s] - (to_own(spheres.position.at(s)) - touch.point).norm();
}

double Surface::stiffness_along(const Vec3& direction, const Spheres& spheres) const {
    double sum = 0.0;
    for (const auto& block : touches) {
        for (const auto& touch : block) {
            const Vec3 normal = (spheres.position.at(static_cast<std::size_t>(touch.sphere)) - to_space(touch.point)).normalized();
            const Stiffness k = stiffness_at(law_of(touch), overlap_of(touch, spheres));
            const double straight = normal.dot(direction) * normal.dot(direction);
            sum += k.k_n * straight + k.k_t * (1.0 - straight);
        }
    }
    return sum;
}

double Surface::renumber(const Spheres& old, const std::vector<std::int32_t>& now, std::size_t spheres) {
    std::vector<SurfaceTouch> kept;
    double lost = 0.0;
    for (const auto& block : touches) {
        for (const auto& touch : block) {
            const auto s = static_cast<std::size_t>(touch.sphere);
            if (now[s] >= 0) {
                kept.push_back(touch);
                kept.back().sphere = now[s];
            } else {
                lost += stored_energy(law_of(touch), overlap_of(touch, old), touch.history.slip.norm());
            }
        }
    }
    std::stable_sort(kept.begin(), kept.end(), [](const SurfaceTouch& a, const SurfaceTouch& b) { return a.sphere < b.sphere; });
    touches.assign(blocks_of(spheres), {});
    for (const auto& touch : kept) {
        touches[static_cast<std::size_t>(touch.sphere) / spheres_per_block].push_back(touch);
    }
    // Whoever asks for a contact's law before spheres are listed anew, as a servo does, finds it under the new number.
    std::vector<std::pair<std::int32_t, LooseContact>> listed;
    for (std::size_t k = 0; k < sphere.size(); ++k) {
        if (const auto number = now[static_cast<std::size_t>(sphere[k])]; number >= 0) {
            listed.emplace_back(number, law[k]);
        }
    }
    std::sort(listed.begin(), listed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    sphere.clear();
    law.clear();
    for (const auto& [number, its] : listed) {
        sphere.push_back(number);
        law.push_back(its);
    }
    near_first.assign(sphere.size() + 1, 0);
    near_face.clear();
    return lost;
}

Surface::Flat Surface::flattened() const {
    Flat flat;
    for (const Vec3& v :
         {origin, Vec3(attitude.vec()), Vec3(attitude.w(), 0, 0), motion.velocity, motion.spin, sums.reaction, sums.torque}) {
        flat.pose.insert(flat.pose.end(), v.begin(), v.end());
    }
    flat.lists.push_back(static_cast<std::int32_t>(sphere.size()));
    flat.lists.insert(flat.lists.end(), sphere.begin(), sphere.end());
    for (const auto* list : {&near_first, &near_face}) {
        for (const auto k : *list) {
            flat.lists.push_back(static_cast<std::int32_t>(k));
        }
    }
    for (const auto& block : touches) {
        for (const auto& t : block) {
            flat.touches.insert(flat.touches.end(),
                                {t.sphere, static_cast<std::int32_t>(t.face), static_cast<std::int32_t>(t.feature), t.index});
            for (const Vec3& v : {t.point, t.history.slip, t.history.viscous, t.force}) {
                flat.values.insert(flat.values.end(), v.begin(), v.end());
            }
        }
    }
    return flat;
}

void Surface::restore(const Flat& flat) {
    const auto vector = [](const std::vector<double>& from, std::size_t k) { return Vec3(from[3 * k], from[3 * k + 1], from[3 * k + 2]); };
    origin = vector(flat.pose, 0);
    attitude.vec() = vector(flat.pose, 1);
    attitude.w() = flat.pose[6];
    motion = {vector(flat.pose, 3), vector(flat.pose, 4)};
    sums.reaction = vector(flat.pose, 5);
    sums.torque = vector(flat.pose, 6);
    const auto n = static_cast<std::ptrdiff_t>(flat.lists[0]);
    const auto begin = flat.lists.begin() + 1;
    sphere.assign(begin, begin + n);
    near_first.assign(begin + n, begin + 2 * n + 1);
    near_face.assign(begin + 2 * n + 1, flat.lists.end());
    for (auto& block : touches) {
        block.clear();
    }
    for (std::size_t k = 0; k < flat.touches.size() / 4; ++k) {
        const auto* t = &flat.touches[4 * k];
        touches[static_cast<std::size_t>(t[0]) / spheres_per_block].push_back(
            {t[0],
             static_cast<std::uint32_t>(t[1]),
             static_cast<Feature>(t[2]),
             static_cast<std::uint8_t>(t[3]),
             vector(flat.values, 4 * k),
             {vector(flat.values, 4 * k + 1), vector(flat.values, 4 * k + 2)},
             vector(flat.values, 4 * k + 3)});
    }
}

void search_surface(const Spheres& spheres, const std::vector<Material>& materials, double skin, Surface& surface, Team* team) {
    Team alone(1);
    list_near(
        spheres, skin, surface.geometry, surface.tree, [&](const Vec3& p) { return surface.to_own(p); }, team != nullptr ? *team : alone,
        surface);
    set_up_surface(spheres, materials, surface);
}

std::vector<LooseContact> wall_contacts(const Spheres& spheres, const std::vector<Material>& materials, const Material& wall,
                                        double friction, const std::vector<std::int32_t>& listed) {
    std::vector<LoosePair> pairs;
    pairs.reserve(materials.size());
    for (const auto& m : materials) {
        pairs.push_back(wall_pair(m, wall, friction));
    }
    std::vector<LooseContact> out;
    for (const auto id : listed) {
        const auto s = static_cast<std::size_t>(id);
        out.push_back(wall_contact(pairs[static_cast<std::size_t>(spheres.material[s])],
                                   {spheres.radius[s], spheres.mass[s], spheres.inertia[s]}, spheres.section(s)));
    }
    return out;
}

void set_up_surface(const Spheres& spheres, const std::vector<Material>& materials, Surface& surface) {
    surface.law = wall_contacts(spheres, materials, surface.material, surface.friction, surface.sphere);
    surface.touches.resize(blocks_of(spheres.size()));
}

WallSums surface_forces(const Spheres& spheres, Surface& surface, std::size_t number, const SphereBlock& block, const ContactStep& step,
                        Loads& loads) {
    WallSums sum;
    thread_local std::vector<FaceContact> found;
    thread_local std::vector<SurfaceTouch> old;
    auto& touches = surface.touches[number];
    old.swap(touches);
    touches.clear();
    const ListedRange range = listed_in(surface.sphere, block);
    std::size_t begin = 0;
    const Mat3 turn = surface.attitude.toRotationMatrix();
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto s = static_cast<std::size_t>(surface.sphere[k]);
        const double radius = spheres.radius[s];
        const Vec3 centre = spheres.position.at(s);
        const Vec3 own = turn.transpose() * (centre - surface.origin);
        double_hierarchy(surface.geometry, surface.faces_near(k), own, radius, found);
        const std::size_t end = end_of_touches(old, begin, surface.sphere[k]);
        for (const auto& contact : found) {
            const Vec3 point = surface.origin + turn * contact.point;
            const double distance = std::sqrt(contact.square);
            const Vec3 velocity = surface.velocity_at(point);
            const Vec3 normal = surface.normal_at(contact, centre - point, distance);
            const Vec3 turning = 0.5 * normal.dot(surface.motion.spin + spheres.spin.at(s)) * normal;
            const double way =
                (velocity - spheres.velocity.at(s)).norm() + (spheres.spin.at(s).norm() + surface.motion.spin.norm()) * radius;
            SurfaceTouch touch{surface.sphere[k], contact.face, contact.feature, contact.index, contact.point, {}, {}};
            const std::size_t before = nearest_touch(old, begin, end, contact.point, 1.01 * way * step.elapsed + 1e-9 * radius,
                                                     [](const SurfaceTouch& t) { return t.point; });
            if (before < end) {
                touch.history = old[before].history;
                old[before].sphere = -1;
            }
            const auto load = advance_wall(spheres, s, surface.law[k], radius, {distance, normal, velocity, surface.motion.spin, turning},
                                           step, touch.history, sum);
            touch.force = load.force;
            sum.torque -= (point - surface.origin).cross(load.force);
            loads.add(s, load.force, load.torque);
            touches.push_back(touch);
        }
        for (std::size_t gone = begin; gone < end; ++gone) {
            if (old[gone].sphere >= 0) { // what a contact that has ended still held goes in its last step
                const Vec3 point = surface.origin + turn * old[gone].point;
                const double distance = std::max((centre - point).norm(), radius);
                advance_wall(spheres, s, surface.law[k], radius, {distance, (centre - point).normalized(), surface.velocity_at(point)},
                             step, old[gone].history, sum);
            }
        }
        begin = end;
    }
    return sum;
}

} // namespace proveta
