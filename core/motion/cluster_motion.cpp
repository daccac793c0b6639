#include "core/motion/cluster_motion.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

// One vector quantity through a step: momentum (linear or angular) under a load, with its velocity before. Returns the work of the damping.
double kick(Vec3& momentum, const Vec3& load, const Vec3& velocity, double alpha, bool viscous, double dt) {
    if (viscous) { // -c p with the mean momentum of the step
        const double half = 0.5 * alpha * dt;
        const Vec3 after = (momentum * (1.0 - half) + dt * load) / (1.0 + half);
        const double work = 0.5 * dt * alpha * (momentum + after).dot(velocity);
        momentum = after;
        return work;
    }
    const double speed = velocity.norm();
    const Vec3 damping = speed > 0.0 ? Vec3(-alpha * load.norm() / speed * velocity) : Vec3(Vec3::Zero());
    momentum += dt * (load + damping);
    return -dt * damping.dot(velocity);
}

} // namespace

MotionSums move_clusters(Clusters& clusters, Spheres& spheres, Loads& loads, std::size_t begin, std::size_t end, const MotionRule& rule,
                         double dt, bool first, bool measure) {
    MotionSums sums;
    const double kick_dt = first ? 0.5 * dt : rule.kick > 0.0 ? rule.kick : dt;
    for (std::size_t body = begin; body < end; ++body) {
        const double mass = clusters.mass[body];
        rotation::State& turning = clusters.turning[body];
        Vec3 force = mass * rule.gravity;
        Vec3 torque = Vec3::Zero();
        loads.collect({clusters.first[body], clusters.first[body + 1], 0, 0});
        for (std::size_t s = clusters.first[body]; s < clusters.first[body + 1]; ++s) {
            Load& row = loads.row(s);
            const Vec3 f(row.force[0], row.force[1], row.force[2]);
            force += f;
            torque += Vec3(row.torque[0], row.torque[1], row.torque[2]) + (spheres.position.at(s) - clusters.position[body]).cross(f);
            row = Load{};
        }
        const Vec3 velocity_before = clusters.velocity[body];
        const Vec3 momentum_before = turning.momentum;
        Vec3 momentum = mass * velocity_before;
        sums.damping_work += kick(momentum, force, velocity_before, rule.damping.translation, rule.damping.viscous, kick_dt);
        sums.damping_work += kick(turning.momentum, torque, turning.spin, rule.damping.rotation, rule.damping.viscous, kick_dt);
        clusters.velocity[body] = momentum / mass;
        if (measure) { // at the time of the forces, from the velocities on both sides of it
            const double newer = first ? 0.0 : 0.5;
            const Vec3 v = velocity_before + newer * (clusters.velocity[body] - velocity_before);
            const Vec3 h = momentum_before + newer * (turning.momentum - momentum_before);
            sums.kinetic += 0.5 * mass * v.squaredNorm() + 0.5 * h.dot(rotation::spin_of(turning.attitude, turning.inertia, h));
            sums.unbalanced += force.norm();
        }
        clusters.position[body] += dt * clusters.velocity[body];
        turning.spin = rotation::spin_of(turning.attitude, turning.inertia, turning.momentum);
        rotation::advance_rk4(turning, Vec3::Zero(), dt);
        clusters.place(body, dt, spheres);
        for (std::size_t s = clusters.first[body]; s < clusters.first[body + 1]; ++s) {
            sums.fastest = std::max(sums.fastest, spheres.velocity.at(s).squaredNorm());
            if (!std::isfinite(spheres.velocity.x[s])) {
                sums.fastest = std::nan("");
            }
        }
    }
    return sums;
}

} // namespace proveta
