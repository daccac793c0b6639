// One contact of a sphere with a rigid surface, whatever the surface's form: motion against each other, law, rolling resistance.
#pragma once

#include <algorithm>

#include "core/contacts/loose.hpp"
#include "core/contacts/rolling.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Sums over a surface's contacts of one step, or over those of one block of spheres; energies in J.
struct WallSums {
    double stored = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
    Vec3 reaction = Vec3::Zero(); ///< force of the spheres on the surface, N
    Vec3 torque = Vec3::Zero();   ///< of the spheres on a surface that turns, about its origin, N m
    double thrust = 0.0;          ///< sum of the normal forces, N
    double deepest = 0.0;         ///< largest overlap over the sphere's radius
    int touching = 0;

    void add(const WallSums& other) {
        stored += other.stored;
        friction += other.friction;
        dashpot += other.dashpot;
        reaction += other.reaction;
        torque += other.torque;
        thrust += other.thrust;
        deepest = std::max(deepest, other.deepest);
        touching += other.touching;
    }
};

/// What a contact with a surface remembers.
struct WallHistory {
    Vec3 slip = Vec3::Zero();    ///< elastic tangential displacement, m
    Vec3 viscous = Vec3::Zero(); ///< force of the dashpots on the sphere at the last step, N
};

/// Where a surface is and how it moves at a contact.
struct WallPoint {
    double distance;             ///< of the surface from the sphere's centre, m
    Vec3 normal;                 ///< unit vector from the surface to the centre
    Vec3 velocity;               ///< of the surface's point, m/s
    Vec3 spin = Vec3::Zero();    ///< of the surface, rad/s
    Vec3 turning = Vec3::Zero(); ///< angular velocity that carries the tangential displacement besides the normal's own, rad/s
};

/// Force and torque on the sphere, N and N m.
struct WallLoad {
    Vec3 force, torque;
};

/// A tangential displacement brought into the plane across n as that turns, its size kept.
inline Vec3 across(const Vec3& u, const Vec3& n) {
    const Vec3 flat = u - n * n.dot(u);
    const double size = flat.norm();
    return size > 0.0 ? Vec3(flat * (u.norm() / size)) : flat;
}

/// Advances a contact. contact_distance: at which the sphere begins to touch, m. Adds to the sums, but for their torque.
inline WallLoad advance_wall(const Spheres& spheres, std::size_t s, const LooseContact& law, double contact_distance, const WallPoint& wall,
                             const ContactStep& step, WallHistory& history, WallSums& sum) {
    const Vec3& n = wall.normal;
    const double elapsed = step.elapsed;
    const double overlap = contact_distance - wall.distance;
    const double approach = (wall.velocity - spheres.velocity.at(s)).dot(n) * elapsed;
    // Contact point at the foot of the sphere: the surface slides along its way only where that lies across the normal.
    const Vec3 arm = -wall.distance * n;
    const Vec3 relative = wall.velocity - spheres.velocity.at(s) - spheres.spin.at(s).cross(arm);
    const Vec3 sliding = (relative - n * n.dot(relative)) * elapsed;
    const double slip[3] = {sliding.x(), sliding.y(), sliding.z()};
    const Vec3 old_slip = across(history.slip + elapsed * wall.turning.cross(history.slip), n);
    const Vec3 viscous_t = history.viscous - n * n.dot(history.viscous);
    contact::State<double> state{
        {old_slip.x(), old_slip.y(), old_slip.z()}, history.viscous.dot(n), {viscous_t.x(), viscous_t.y(), viscous_t.z()}};
    const auto r = advance(law, overlap, approach, step, slip, state);
    history.slip = {state.u_t[0], state.u_t[1], state.u_t[2]};
    history.viscous = Vec3(state.viscous_t[0], state.viscous_t[1], state.viscous_t[2]) + state.viscous * n;
    const Vec3 force = Vec3(r.shear[0], r.shear[1], r.shear[2]) + r.normal * n;
    Vec3 torque = arm.cross(force);
    if (law.rolling_arm > 0.0) {
        const Vec3 spin = spheres.spin.at(s) - wall.spin;
        const double relative_spin[3] = {spin.x(), spin.y(), spin.z()};
        const auto rolling = rolling::torque<double>(law.rolling_arm, r.normal, law.reduced_inertia, relative_spin, step.dt);
        torque += Vec3(rolling.torque[0], rolling.torque[1], rolling.torque[2]);
        sum.friction += rolling.power * elapsed;
    }
    sum.reaction -= force;
    sum.thrust += r.normal;
    sum.deepest = std::max(sum.deepest, overlap / spheres.radius[s]);
    sum.touching += r.normal > 0.0 ? 1 : 0;
    sum.stored += r.stored;
    sum.friction += r.friction_work;
    sum.dashpot += r.dashpot_work;
    return {force, torque};
}

} // namespace proveta
