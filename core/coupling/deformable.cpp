#include "core/coupling/deformable.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace proveta {

namespace {

double mean_node_mass(const Solid& solid) {
    return std::accumulate(solid.mass().begin(), solid.mass().end(), 0.0) / static_cast<double>(solid.nodes());
}

} // namespace

Deformable::Deformable(Solid body, const Material& surface, double friction_coefficient, Coupling how, double on_side)
    : solid(std::move(body)), skin(skin_of(solid.mesh()), solid.position), material(surface), friction(friction_coefficient), coupling(how),
      side(on_side), listed_at(solid.position) {}

double Deformable::way() const {
    double farthest = 0.0;
    for (std::size_t k = 0; k < listed_at.size(); ++k) {
        farthest = std::max(farthest, (solid.position[k] - listed_at[k]).squaredNorm());
    }
    return std::sqrt(farthest);
}

double Deformable::renumber(const std::vector<std::int32_t>& now, std::size_t spheres) {
    std::vector<SkinTouch> kept;
    double lost = 0.0;
    for (const auto& block : touches) {
        for (const auto& touch : block) {
            const auto to = now[static_cast<std::size_t>(touch.sphere)];
            if (to >= 0) {
                kept.push_back(touch);
                kept.back().sphere = to;
            } else {
                lost += touch.stored;
            }
        }
    }
    std::stable_sort(kept.begin(), kept.end(), [](const SkinTouch& a, const SkinTouch& b) { return a.sphere < b.sphere; });
    touches.assign(blocks_of(spheres), {});
    loads.assign(blocks_of(spheres), {});
    for (const auto& touch : kept) {
        touches[static_cast<std::size_t>(touch.sphere) / spheres_per_block].push_back(touch);
    }
    return lost;
}

Deformable::Flat Deformable::flattened() const {
    Flat flat;
    flat.lists.push_back(static_cast<std::int32_t>(sphere.size()));
    flat.lists.insert(flat.lists.end(), sphere.begin(), sphere.end());
    for (const auto* list : {&near_first, &near_face}) {
        for (const auto k : *list) {
            flat.lists.push_back(static_cast<std::int32_t>(k));
        }
    }
    for (const auto& v : listed_at) {
        flat.values.insert(flat.values.end(), v.begin(), v.end());
    }
    for (const auto& block : touches) {
        for (const auto& t : block) {
            flat.touches.insert(flat.touches.end(), {t.sphere, static_cast<std::int32_t>(t.triangle)});
            for (const Vec3& v : {t.at, t.history.slip, t.history.viscous, t.force, t.point}) {
                flat.values.insert(flat.values.end(), v.begin(), v.end());
            }
            flat.values.push_back(t.stored);
        }
    }
    return flat;
}

void Deformable::restore(const Flat& flat) {
    const auto n = static_cast<std::ptrdiff_t>(flat.lists[0]);
    const auto begin = flat.lists.begin() + 1;
    sphere.assign(begin, begin + n);
    near_first.assign(begin + n, begin + 2 * n + 1);
    near_face.assign(begin + 2 * n + 1, flat.lists.end());
    const double* value = flat.values.data();
    const auto vector = [&] {
        value += 3;
        return Vec3(value[-3], value[-2], value[-1]);
    };
    for (auto& v : listed_at) {
        v = vector();
    }
    for (auto& block : touches) {
        block.clear();
    }
    for (std::size_t k = 0; k < flat.touches.size() / 2; ++k) {
        SkinTouch t{flat.touches[2 * k], static_cast<std::uint32_t>(flat.touches[2 * k + 1]), vector(), {}};
        t.history.slip = vector();
        t.history.viscous = vector();
        t.force = vector();
        t.point = vector();
        t.stored = *value++;
        touches[static_cast<std::size_t>(t.sphere) / spheres_per_block].push_back(t);
    }
}

void search_deformable(const Spheres& spheres, const std::vector<Material>& materials, double skin, Deformable& body, Team& team) {
    body.skin.follow(body.solid.position, body.solid.velocity, team);
    body.tree = FaceTree(body.skin.geometry().mesh);
    list_near(
        spheres, skin, body.skin.geometry(), body.tree, [](const Vec3& p) { return p; }, team, body);
    body.listed_at = body.solid.position;
    set_up_deformable(spheres, materials, body);
}

void set_up_deformable(const Spheres& spheres, const std::vector<Material>& materials, Deformable& body) {
    body.law = wall_contacts(spheres, materials, body.material, body.friction, body.sphere);
    if (!body.solid.mesh().membranes.empty()) {
        // A sphere that meets a sheet swings against the few nodes there, not against a wall: dashpots go with the root of the reduced
        // mass.
        const double node = mean_node_mass(body.solid);
        for (std::size_t k = 0; k < body.law.size(); ++k) {
            const double lighter = std::sqrt(node / (node + spheres.mass[static_cast<std::size_t>(body.sphere[k])]));
            body.law[k].c_n *= lighter;
            body.law[k].c_t *= lighter;
        }
    }
    body.touches.resize(blocks_of(spheres.size()));
    body.loads.resize(blocks_of(spheres.size()));
}

void collect_node_loads(Deformable& body) {
    for (const auto& block : body.loads) {
        for (const auto& load : block) {
            body.solid.contact[load.node] += load.force;
        }
    }
}

double sphere_share(const Deformable& body, double sphere_mass) { return 1.0 + std::sqrt(sphere_mass / mean_node_mass(body.solid)); }

namespace {

// Bounds on the weights that a sphere's contacts may have on nodes until the next search: each face's shape functions at its nearest
// point, grown by their slope over how far the circle of contact may reach.
struct NodeWeights {
    std::vector<std::uint32_t> node;
    std::vector<double> weight;

    void clear() {
        node.clear();
        weight.clear();
    }
    void raise(std::uint32_t n, double w) {
        const auto at = std::find(node.begin(), node.end(), n);
        if (at == node.end()) {
            node.push_back(n);
            weight.push_back(std::min(w, 1.0));
        } else {
            double& known = weight[static_cast<std::size_t>(at - node.begin())];
            known = std::min(1.0, std::max(known, w));
        }
    }
};

void raise_weights(const Skin& skin, std::uint32_t t, const Vec3& centre, double reach, NodeWeights& out) {
    const auto v = skin.geometry().corners(t);
    const Vec3 at = skin.coordinates(t, nearest_on_face(skin.geometry(), t, centre).point);
    const double twice_area = (v[1] - v[0]).cross(v[2] - v[0]).norm();
    Vec3 high;
    for (int c = 0; c < 3; ++c) {
        const double slope = (v[static_cast<std::size_t>((c + 2) % 3)] - v[static_cast<std::size_t>((c + 1) % 3)]).norm() / twice_area;
        high[c] = std::min(1.0, at[c] + reach * slope);
    }
    // Of a quadrilateral's triangle a node bears its corner's share and a quarter of the centroid's.
    std::array<std::pair<std::uint32_t, double>, 12> share;
    std::size_t n = 0;
    skin.each_node(t, high, [&](std::uint32_t node, double w) {
        const auto known = std::find_if(share.begin(), share.begin() + n, [&](const auto& s) { return s.first == node; });
        if (known == share.begin() + n) {
            share[n++] = {node, w};
        } else {
            known->second += w;
        }
    });
    for (std::size_t k = 0; k < n; ++k) {
        out.raise(share[k].first, share[k].second);
    }
}

} // namespace

double stable_step(const Deformable& body, const Spheres& spheres, double growth, double skin) {
    auto demand = body.solid.demands();
    const auto& mass = body.solid.mass();
    NodeWeights weights;
    for (std::size_t k = 0; k < body.sphere.size(); ++k) {
        const auto s = static_cast<std::size_t>(body.sphere[k]);
        const Vec3 centre = spheres.position.at(s);
        const double radius = spheres.radius[s];
        double nearest = radius + skin;
        for (const auto face : body.faces_near(k)) {
            nearest = std::min(nearest, std::sqrt(nearest_on_face(body.skin.geometry(), face, centre).square));
        }
        const double overlap = std::max(radius - nearest, 0.0) + growth;
        const Stiffness c = stiffness_at(body.law[k], overlap);
        const double circle = std::sqrt(std::min(overlap, radius) * (2.0 * radius - std::min(overlap, radius)));
        weights.clear();
        for (const auto face : body.faces_near(k)) {
            raise_weights(body.skin, face, centre, circle + skin, weights);
        }
        const double share = sphere_share(body, spheres.mass[s]);
        const double rest = share / (share - 1.0); // Young's inequality: 1/share + 1/rest = 1
        for (std::size_t n = 0; n < weights.node.size(); ++n) {
            const auto node = weights.node[n];
            demand[node].stiffness += rest * weights.weight[n] * std::max(c.k_n, c.k_t) / mass[node];
            demand[node].damping += rest * weights.weight[n] * std::max(c.c_n, c.c_t) / mass[node];
        }
    }
    double lowest = 1e300;
    for (const auto& d : demand) {
        const double root = std::sqrt(d.damping * d.damping + 4.0 * d.stiffness);
        lowest = std::min(lowest, d.stiffness > 0.0 ? 4.0 / (d.damping + root) : 1e300);
    }
    return lowest;
}

} // namespace proveta
