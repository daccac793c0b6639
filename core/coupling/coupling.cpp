// The forces between spheres and the skin of a deformable body (thesis 4.3 and appendix B).
//
// The contacts and their laws are those of rigid surfaces, with two additions of the Area Distributed Method: of several contacts of one
// sphere each counts by its share of the area that all faces have inside the circles that the sphere cuts out of their planes (B.1), and
// each one's force goes to the faces that gave way to it by their areas, at the centroids of these (4.64).
//
// Against the source: it is not only the normal force that is scaled but the contact's stiffness, so that springs keep their energy; the
// circle is that of the cut, a^2 = R^2 - h^2, twice as large as Hertz's R delta, because with Hertz's a sphere over a convex edge would
// have no area at all and its force no place to go. Where the centroid of the areas is not the contact point, the nodes would bear another
// moment than the sphere: a couple over the same nodes makes up for the difference, and carries rolling resistance too.
#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "core/coupling/circle_triangle.hpp"
#include "core/coupling/deformable.hpp"

namespace proveta {

namespace {

// What one sphere does to the nodes.
struct SphereOnNodes {
    std::vector<NodeLoad> load;
    std::vector<double> weight; // of each, for the couple

    void clear() {
        load.clear();
        weight.clear();
    }
    void add(std::uint32_t node, const Vec3& force, double w) {
        for (std::size_t k = 0; k < load.size(); ++k) {
            if (load[k].node == node) {
                load[k].force += force;
                weight[k] += w;
                return;
            }
        }
        load.push_back({node, force});
        weight.push_back(w);
    }
};

// Shared by the functions below, kept between calls so that nothing is allocated in the loop.
struct Scratch {
    std::vector<FaceContact> found;
    std::vector<SlaveFace> slaves;
    std::vector<Piece> piece;          // of each slave
    std::vector<double> area;          // of each master
    std::vector<std::uint8_t> beyond;  // of each master: the centre is on the wrong side of it
    std::vector<std::uint8_t> ignored; // of each master: seen through the body
    std::vector<SkinTouch> old;        // of the block
    SphereOnNodes nodes;
};

// Areas of all slaves and their sums by masters; the share of each master in the whole.
void share_areas(const Skin& skin, const Vec3& centre, double radius, Scratch& s) {
    s.piece.resize(s.slaves.size());
    s.area.assign(s.found.size(), 0.0);
    double whole = 0.0;
    for (std::size_t k = 0; k < s.slaves.size(); ++k) {
        const auto t = s.slaves[k].face;
        const FacePlane& plane = skin.geometry().plane[t];
        const double height = plane.normal.dot(centre) - plane.offset;
        const double square = radius * radius - height * height;
        s.piece[k] = {};
        if (square > 0.0 && s.ignored[s.slaves[k].master] == 0) {
            const auto v = skin.geometry().corners(t);
            s.piece[k] = circle_triangle(centre - height * plane.normal, std::sqrt(square), v[0], v[1], v[2]);
        }
        s.area[s.slaves[k].master] += s.piece[k].area;
        whole += s.piece[k].area;
    }
    for (auto& area : s.area) {
        area = whole > 0.0 ? area / whole : 1.0 / static_cast<double>(s.found.size());
    }
}

// Puts minus a force on the nodes of a master's slaves, each at the centroid of its piece.
void distribute(const Skin& skin, std::uint32_t master, const Vec3& at, const Vec3& force, double share, Scratch& s) {
    double whole = 0.0;
    for (std::size_t k = 0; k < s.slaves.size(); ++k) {
        whole += s.slaves[k].master == master ? s.piece[k].area : 0.0;
    }
    if (!(whole > 0.0)) { // the sphere only just touches
        skin.each_node(s.found[master].face, at, [&](std::uint32_t node, double w) { s.nodes.add(node, -w * force, w * share); });
        return;
    }
    for (std::size_t k = 0; k < s.slaves.size(); ++k) {
        if (s.slaves[k].master == master && s.piece[k].area > 0.0) {
            const double part = s.piece[k].area / whole;
            const auto t = s.slaves[k].face;
            skin.each_node(t, skin.coordinates(t, s.piece[k].centroid),
                           [&](std::uint32_t node, double w) { s.nodes.add(node, -part * w * force, part * w * share); });
        }
    }
}

// Adds forces without a sum to the nodes whose moment about the centre makes theirs the opposite of the sphere's torque.
void balance(const std::vector<Vec3>& position, const Vec3& centre, const Vec3& torque, SphereOnNodes& nodes) {
    Vec3 missing = -torque;
    for (const auto& l : nodes.load) {
        missing -= (position[l.node] - centre).cross(l.force);
    }
    const auto turn = [&](const auto& weight) {
        double sum = 0.0;
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < nodes.load.size(); ++k) {
            sum += weight(k);
            middle += weight(k) * position[nodes.load[k].node];
        }
        middle /= sum;
        Mat3 inertia = Mat3::Zero();
        for (std::size_t k = 0; k < nodes.load.size(); ++k) {
            const Vec3 arm = position[nodes.load[k].node] - middle;
            inertia += weight(k) * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
        }
        const double trace = inertia.trace();
        if (!(inertia.determinant() > 1e-6 * trace * trace * trace)) {
            return false;
        }
        const Vec3 spin = inertia.ldlt().solve(missing);
        for (std::size_t k = 0; k < nodes.load.size(); ++k) {
            nodes.load[k].force += weight(k) * spin.cross(position[nodes.load[k].node] - middle);
        }
        return true;
    };
    // Nodes that bear much of the force bear much of the couple; where they all but lie on a line, all in equal parts.
    if (!turn([&](std::size_t k) { return std::fabs(nodes.weight[k]); })) {
        turn([](std::size_t) { return 1.0; });
    }
}

// Points out of the skin where a sphere touches it. On an edge or in a corner that is the mean of the faces that meet there, weighted by
// their angles: no single one of them tells which side a point is on (J. A. Baerentzen, H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11
// (2005) 243-253).
Vec3 outwards(const Skin& skin, const FaceContact& contact, const Vec3& centre, double radius, const std::vector<SlaveFace>& slaves) {
    const SurfaceGeometry& g = skin.geometry();
    if (contact.feature == Feature::facet) {
        return g.plane[contact.face].normal;
    }
    Vec3 sum = Vec3::Zero();
    for (const auto& slave : slaves) {
        const FaceContact other = nearest_on_face(g, slave.face, centre);
        if ((other.point - contact.point).norm() > 1e-9 * radius) {
            continue;
        }
        double angle = other.feature == Feature::facet ? 2.0 * std::numbers::pi : std::numbers::pi;
        if (other.feature == Feature::vertex) {
            const auto v = g.corners(slave.face);
            const Vec3& at = v[other.index];
            const Vec3 to = v[(other.index + 1U) % 3] - at, from = v[(other.index + 2U) % 3] - at;
            angle = std::atan2(to.cross(from).norm(), to.dot(from));
        }
        sum += angle * g.plane[slave.face].normal;
    }
    return sum;
}

// Which contacts lie on the wrong side, and which of them do not count. Whether the centre has crossed the skin is told by the nearest
// one. If it has not, what is seen from behind is the far side of a convex edge, whose rim stands out of the tangent plane where the near
// side is dented: it faces away and cannot push.
void find_sides(const Skin& skin, double side, const Vec3& centre, double radius, Scratch& s) {
    s.beyond.assign(s.found.size(), 0);
    s.ignored.assign(s.found.size(), 0);
    for (std::size_t c = 0; c < s.found.size() && side != 0.0; ++c) {
        const FaceContact& contact = s.found[c];
        s.beyond[c] = side * (centre - contact.point).dot(outwards(skin, contact, centre, radius, s.slaves)) < 0.0;
        s.ignored[c] = s.beyond[c] && !s.beyond[0];
    }
}

LooseContact scaled(LooseContact c, double share) {
    c.k_n *= share;
    c.k_t *= share;
    c.c_n *= share;
    c.c_t *= share;
    c.reduced_mass *= share;
    return c;
}

} // namespace

SkinSums deformable_forces(const Spheres& spheres, Deformable& body, std::size_t number, const SphereBlock& block, const ContactStep& step,
                           Loads& loads) {
    const double elapsed = step.elapsed;
    thread_local Scratch s;
    SkinSums sum;
    auto& touches = body.touches[number];
    auto& on_nodes = body.loads[number];
    s.old.swap(touches);
    touches.clear();
    on_nodes.clear();
    const Skin& skin = body.skin;
    const ListedRange range = listed_in(body.sphere, block);
    std::size_t begin = 0;
    for (const auto& touch : s.old) {
        sum.made -= touch.stored; // what is found again is given back below
    }
    for (std::size_t k = range.begin; k < range.end; ++k) {
        const auto id = static_cast<std::size_t>(body.sphere[k]);
        const double radius = spheres.radius[id];
        const Vec3 centre = spheres.position.at(id);
        const bool by_area = body.coupling == Coupling::area_distributed;
        double_hierarchy(skin.geometry(), body.faces_near(k), centre, radius, s.found, &s.slaves);
        const std::size_t end = end_of_touches(s.old, begin, body.sphere[k]);
        find_sides(skin, body.side, centre, radius, s);
        if (by_area) {
            share_areas(skin, centre, radius, s);
        }
        s.nodes.clear();
        Vec3 torque = Vec3::Zero();
        for (std::uint32_t c = 0; c < s.found.size(); ++c) {
            if (s.ignored[c] != 0) {
                continue;
            }
            const FaceContact& contact = s.found[c];
            const Vec3 face_normal = skin.geometry().plane[contact.face].normal;
            SkinTouch touch{body.sphere[k], contact.face, skin.coordinates(contact.face, contact.point), {}};
            touch.point = contact.point;
            const Vec3 velocity = skin.velocity(contact.face, touch.at);
            double distance = std::sqrt(contact.square);
            Vec3 normal = distance > 0.0 ? Vec3((centre - contact.point) / distance) : face_normal;
            // Whether the centre has crossed the skin.
            if (s.beyond[c] != 0) {
                normal = -normal;
                distance = -distance;
                ++sum.crossed;
            }
            const Vec3 spin = skin.spin(contact.face) * face_normal;
            const Vec3 turning = 0.5 * normal.dot(spin + spheres.spin.at(id)) * normal;
            const double way =
                (velocity - spheres.velocity.at(id)).norm() + (spheres.spin.at(id).norm() + skin.tilt(contact.face)) * radius;
            const std::size_t before = nearest_touch(s.old, begin, end, contact.point, 1.01 * way * elapsed + 1e-9 * radius,
                                                     [&](const SkinTouch& t) { return skin.point(t.triangle, t.at); });
            if (before < end) {
                touch.history = s.old[before].history;
                s.old[before].sphere = -1;
            }
            const LooseContact law = by_area ? scaled(body.law[k], s.area[c]) : body.law[k];
            // What the springs held before they moved, as strong as they are now: changes of share and of contacts make or take energy.
            const double approach = (velocity - spheres.velocity.at(id)).dot(normal) * elapsed;
            sum.made += stored_energy(law, radius - distance - approach, touch.history.slip.norm());
            const double stored = sum.stored;
            const auto load = advance_wall(spheres, id, law, radius, {distance, normal, velocity, spin, turning}, step, touch.history, sum);
            touch.stored = sum.stored - stored;
            touch.force = load.force;
            loads.add(id, load.force, load.torque);
            torque += load.torque;
            if (by_area) {
                distribute(skin, c, touch.at, load.force, s.area[c], s);
            } else {
                skin.each_node(contact.face, touch.at, [&](std::uint32_t node, double w) { s.nodes.add(node, -w * load.force, w); });
            }
            // Less below what the nodes get.
            const Vec3 rolling = load.torque + distance * normal.cross(load.force);
            sum.made += elapsed * (load.force.dot(velocity) + rolling.dot(spin));
            touches.push_back(touch);
        }
        begin = end;
        if (!s.nodes.load.empty()) {
            balance(body.solid.position, centre, torque, s.nodes);
            for (const auto& l : s.nodes.load) {
                sum.made += elapsed * l.force.dot(body.solid.velocity[l.node]);
            }
            on_nodes.insert(on_nodes.end(), s.nodes.load.begin(), s.nodes.load.end());
        }
    }
    return sum;
}

} // namespace proveta
