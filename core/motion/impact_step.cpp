#include "core/motion/impact_step.hpp"

#include <cmath>
#include <numbers>

namespace proveta {

namespace {

constexpr double none = 1e300;

double of_pairs(const Spheres& s, const Contacts& c, double steps) {
    double lowest = none;
#pragma omp parallel for schedule(static) reduction(min : lowest) if (c.size() > 256)
    for (std::size_t k = 0; k < c.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.i[k]);
        const auto j = static_cast<std::size_t>(c.j[k]);
        const Vec3 to = s.position.at(j) - s.position.at(i);
        const double distance = to.norm();
        const double speed = (s.velocity.at(i) - s.velocity.at(j)).dot(to) / distance;
        lowest = std::min(lowest, impact_step(c.law[k], speed, c.contact_distance[k] - distance, steps));
    }
    return lowest;
}

// How fast a contact closes, m/s, and how far its point is from the sphere's centre, m.
struct Closing {
    double speed, distance;
};

// Over the faces that listed spheres touch or are about to. own: takes a point to the frame of the geometry; closing: of a contact, by its
// sphere and that one's centre.
template <class ToOwn, class ClosingOf>
double of_faces(const Spheres& s, const NearFaces& near, const std::vector<LooseContact>& law, const SurfaceGeometry& geometry, double skin,
                double steps, const ToOwn& own, const ClosingOf& closing_of) {
    double lowest = none;
    std::vector<FaceContact> found;
    for (std::size_t e = 0; e < near.sphere.size(); ++e) {
        const auto k = static_cast<std::size_t>(near.sphere[e]);
        const Vec3 centre = s.position.at(k);
        double_hierarchy(geometry, near.faces_near(e), own(centre), s.radius[k] + skin, found);
        for (const auto& contact : found) {
            const Closing closing = closing_of(contact, k, centre);
            lowest = std::min(lowest, impact_step(law[e], closing.speed, s.radius[k] - closing.distance, steps));
        }
    }
    return lowest;
}

double of_surface(const Spheres& s, const Surface& surface, double skin, double steps) {
    return of_faces(
        s, surface, surface.law, surface.geometry, skin, steps, [&](const Vec3& centre) { return surface.to_own(centre); },
        [&](const FaceContact& contact, std::size_t k, const Vec3& centre) -> Closing {
            const Vec3 point = surface.to_space(contact.point);
            const Vec3 to = centre - point;
            const double distance = to.norm();
            const Vec3 driven = surface.drive.velocity + surface.drive.spin.cross(point - surface.origin);
            return {(driven - s.velocity.at(k)).dot(surface.normal_at(contact, to, distance)), distance};
        });
}

double of_body(const Spheres& s, const Deformable& body, double skin, double steps) {
    return of_faces(
        s, body, body.law, body.skin.geometry(), skin, steps, [](const Vec3& centre) { return centre; },
        [&](const FaceContact& contact, std::size_t k, const Vec3& centre) -> Closing {
            const double distance = std::sqrt(contact.square);
            if (distance == 0.0) { // without a direction
                return {0.0, 0.0};
            }
            const Vec3 velocity = body.skin.velocity(contact.face, body.skin.coordinates(contact.face, contact.point));
            return {(velocity - s.velocity.at(k)).dot(centre - contact.point) / distance, distance};
        });
}

} // namespace

double impact_step(const LooseContact& c, double speed, double overlap, double steps) {
    if (!(speed > 0.0)) {
        return none;
    }
    const double motion = 0.5 * c.reduced_mass * speed * speed;
    const double held = stored_energy(c, overlap, 0.0);
    if (held > motion) {
        return none;
    }
    double duration = std::numbers::pi * std::sqrt(c.reduced_mass / c.k_n);
    if (c.law == ContactLaw::hertz) { // at the largest overlap the springs hold 4/15 k_n delta^(5/2)
        const double deepest = std::pow(3.75 * (motion + held) / c.k_n, 0.4);
        duration = 2.94328 * deepest / std::sqrt(2.0 * (motion + held) / c.reduced_mass);
    }
    const double damping = 0.5 * c.c_n / std::sqrt(c.reduced_mass * c.k_n);
    return duration / (steps * (1.0 + damping));
}

double impact_step(const Spheres& spheres, const Contacts& contacts, const Walls& walls, double skin, double steps) {
    double lowest = of_pairs(spheres, contacts, steps);
    for (const auto& surface : walls.surfaces) {
        lowest = std::min(lowest, of_surface(spheres, surface, skin, steps));
    }
    for (const auto& body : walls.bodies) {
        lowest = std::min(lowest, of_body(spheres, body, skin, steps));
    }
    return lowest;
}

} // namespace proveta
