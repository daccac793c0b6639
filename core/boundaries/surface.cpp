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
            for (const Vec3& v : {t.point, t.history.slip, t.history.viscous}) {
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
             vector(flat.values, 3 * k),
             {vector(flat.values, 3 * k + 1), vector(flat.values, 3 * k + 2)},
             Vec3::Zero()});
    }
}

namespace {

// What a block of spheres finds.
struct Listed {
    std::vector<std::int32_t> sphere;
    std::vector<std::uint32_t> faces; // how many of each
    std::vector<std::uint32_t> face;
};

void list_block(const Spheres& spheres, double skin, const Surface& surface, std::size_t begin, std::size_t end, Listed& out) {
    const auto box = surface.tree.box(); // only spheres in the intersection of both domains look for faces
    for (std::size_t s = begin; s < end && !box.isEmpty(); ++s) {
        const Vec3 own = surface.to_own(spheres.position.at(s));
        const double reach = spheres.radius[s] + skin;
        if (box.squaredExteriorDistance(own) > reach * reach) {
            continue;
        }
        const std::size_t before = out.face.size();
        surface.tree.near(own, reach, out.face);
        const auto kept = std::remove_if(out.face.begin() + static_cast<std::ptrdiff_t>(before), out.face.end(),
                                         [&](std::uint32_t face) { return !cuts(surface.geometry, face, own, reach); });
        out.face.erase(kept, out.face.end());
        if (out.face.size() > before) {
            out.sphere.push_back(static_cast<std::int32_t>(s));
            out.faces.push_back(static_cast<std::uint32_t>(out.face.size() - before));
        }
    }
}

} // namespace

void search_surface(const Spheres& spheres, const std::vector<Material>& materials, double skin, Surface& surface, Team* team) {
    std::vector<Listed> found(blocks_of(spheres.size()));
    const auto look = [&](std::size_t part) {
        const std::size_t begin = part * spheres_per_block;
        list_block(spheres, skin, surface, begin, std::min(spheres.size(), begin + spheres_per_block), found[part]);
    };
    Team alone(1);
    (team != nullptr ? *team : alone).run(found.size(), look);
    surface.sphere.clear();
    surface.near_first.assign(1, 0);
    surface.near_face.clear();
    for (const auto& block : found) {
        surface.sphere.insert(surface.sphere.end(), block.sphere.begin(), block.sphere.end());
        for (const auto n : block.faces) {
            surface.near_first.push_back(surface.near_first.back() + n);
        }
        surface.near_face.insert(surface.near_face.end(), block.face.begin(), block.face.end());
    }
    set_up_surface(spheres, materials, surface);
}

void set_up_surface(const Spheres& spheres, const std::vector<Material>& materials, Surface& surface) {
    std::vector<LoosePair> pairs;
    pairs.reserve(materials.size());
    for (const auto& m : materials) {
        pairs.push_back(wall_pair(m, surface.material, surface.friction));
    }
    surface.law.clear();
    for (const auto id : surface.sphere) {
        const auto s = static_cast<std::size_t>(id);
        surface.law.push_back(wall_contact(pairs[static_cast<std::size_t>(spheres.material[s])],
                                           {spheres.radius[s], spheres.mass[s], spheres.inertia[s]}, spheres.section(s)));
    }
    surface.touches.resize(blocks_of(spheres.size()));
}

namespace {

// Takes the history of the old contact nearest to a point, and takes it away from the others that might want it.
WallHistory inherit(std::vector<SurfaceTouch>& old, std::size_t begin, std::size_t end, const Vec3& point, double bound) {
    std::size_t nearest = end;
    double square = bound * bound;
    for (std::size_t k = begin; k < end; ++k) {
        const double d = (old[k].point - point).squaredNorm();
        if (old[k].sphere >= 0 && d <= square) {
            square = d;
            nearest = k;
        }
    }
    if (nearest == end) {
        return {};
    }
    old[nearest].sphere = -1;
    return old[nearest].history;
}

} // namespace

WallSums surface_forces(const Spheres& spheres, Surface& surface, std::size_t number, const SphereBlock& block, double elapsed, double dt,
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
        while (begin < old.size() && old[begin].sphere < surface.sphere[k]) {
            ++begin;
        }
        std::size_t end = begin;
        while (end < old.size() && old[end].sphere == surface.sphere[k]) {
            ++end;
        }
        for (const auto& contact : found) {
            const Vec3 point = surface.origin + turn * contact.point;
            const double distance = std::sqrt(contact.square);
            const Vec3 velocity = surface.velocity_at(point);
            const Vec3 normal = surface.normal_at(contact, centre - point, distance);
            const Vec3 turning = 0.5 * normal.dot(surface.motion.spin + spheres.spin.at(s)) * normal;
            const double way = (velocity - spheres.velocity.at(s)).norm() + spheres.spin.at(s).norm() * radius;
            SurfaceTouch touch{surface.sphere[k], contact.face, contact.feature, contact.index, contact.point, {}, {}};
            touch.history = inherit(old, begin, end, contact.point, 1.01 * way * elapsed + 1e-9 * radius);
            const auto load = advance_wall(spheres, s, surface.law[k], radius, {distance, normal, velocity, surface.motion.spin, turning},
                                           elapsed, dt, touch.history, sum);
            touch.force = load.force;
            sum.torque -= (point - surface.origin).cross(load.force);
            loads.add(s, load.force, load.torque);
            touches.push_back(touch);
        }
        begin = end;
    }
    return sum;
}

} // namespace proveta
