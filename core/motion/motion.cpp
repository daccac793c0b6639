#include "core/motion/motion.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

struct Sum {
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
};

void gather_pairs(const std::vector<PairForce>& pairs, const Incidence& incidence, std::size_t sphere, Sum& sum) {
    for (auto k = incidence.offset[sphere]; k < incidence.offset[sphere + 1]; ++k) {
        const PairForce& pair = pairs[incidence.entry[k] >> 1];
        const bool second = (incidence.entry[k] & 1u) != 0;
        const double sign = second ? -1.0 : 1.0;
        const double share = second ? 1.0 - pair.share_i : pair.share_i;
        for (int c = 0; c < 3; ++c) {
            sum.force[c] += sign * pair.force[c];
            sum.torque[c] += share * pair.moment[c];
        }
    }
}

void gather_couples(const VectorField& couples, const Incidence& incidence, std::size_t sphere, Sum& sum) {
    for (auto k = incidence.offset[sphere]; k < incidence.offset[sphere + 1]; ++k) {
        const Vec3 couple = couples.at(incidence.entry[k] >> 1);
        sum.torque += (incidence.entry[k] & 1u) != 0 ? Vec3(-couple) : couple;
    }
}

// One vector quantity (translation or rotation) through one step; returns the work of the damping.
double kick(Vec3& velocity, const Vec3& load, double inertia, double alpha, double dt) {
    const double speed = velocity.norm();
    Vec3 damping = Vec3::Zero();
    if (alpha > 0.0 && speed > 0.0) {
        damping = velocity * (-alpha * load.norm() / speed);
    }
    const Vec3 after = velocity + (load + damping) * (dt / inertia);
    const double work = -0.5 * dt * damping.dot(velocity + after);
    velocity = after;
    return work;
}

} // namespace

MotionSums move_spheres(Spheres& s, const Bonds& bonds, const Contacts& contacts, const BackgroundDamping& damping, double dt,
                        bool measure) {
    constexpr std::size_t block = 256;
    const std::size_t n = s.size();
    std::vector<MotionSums> parts((n + block - 1) / block);
#pragma omp parallel for schedule(static) if (parts.size() > 1)
    for (std::size_t part = 0; part < parts.size(); ++part) {
        MotionSums& out = parts[part];
        for (std::size_t k = part * block; k < std::min(n, (part + 1) * block); ++k) {
            Sum sum{s.external_force.at(k), s.external_torque.at(k)};
            gather_pairs(bonds.forces, bonds.incidence, k, sum);
            if (bonds.moments) {
                gather_couples(bonds.couple, bonds.incidence, k, sum);
            }
            gather_pairs(contacts.forces, contacts.incidence, k, sum);
            Vec3 v = s.velocity.at(k);
            Vec3 w = s.spin.at(k);
            const Vec3 v_before = v;
            const Vec3 w_before = w;
            out.damping_work += kick(v, sum.force, s.mass[k], damping.translation, dt);
            out.damping_work += kick(w, sum.torque, s.inertia[k], damping.rotation, dt);
            out.fastest = std::max(out.fastest, v.squaredNorm());
            if (measure) {
                out.kinetic += 0.125 * (s.mass[k] * (v + v_before).squaredNorm() + s.inertia[k] * (w + w_before).squaredNorm());
                out.unbalanced += sum.force.norm();
                s.force.set(k, sum.force);
                s.torque.set(k, sum.torque);
            }
            s.velocity.set(k, v);
            s.spin.set(k, w);
            s.position.add(k, v * dt);
            s.external_force.set(k, Vec3::Zero());
            s.external_torque.set(k, Vec3::Zero());
        }
    }
    MotionSums total;
    for (const auto& p : parts) {
        total.damping_work += p.damping_work;
        total.fastest = std::max(total.fastest, p.fastest);
        total.kinetic += p.kinetic;
        total.unbalanced += p.unbalanced;
    }
    total.fastest = std::sqrt(total.fastest);
    return total;
}

} // namespace proveta
