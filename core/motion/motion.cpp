#include "core/motion/motion.hpp"

#include "core/motion/motion_kernel.hpp"
#include "core/parallel/instruction_set.hpp"

namespace proveta {

MotionSums move_spheres(Spheres& s, Loads& loads, const SphereBlock& block, const MotionRule& rule, double dt, bool first, bool measure) {
    static const MotionKernel kernel = PROVETA_PICK(motion_kernel);
    loads.collect(block);
    const auto pointers = [](VectorField& f, double*(&out)[3]) {
        out[0] = f.x.data();
        out[1] = f.y.data();
        out[2] = f.z.data();
    };
    MotionView view{};
    pointers(s.position, view.position);
    pointers(s.velocity, view.velocity);
    pointers(s.spin, view.spin);
    view.mass = s.mass.data();
    view.inertia = s.inertia.data();
    view.rows = loads.rows();
    const bool half_behind = rule.scheme == Scheme::velocity_verlet;
    MotionStep step{};
    step.dt = dt;
    step.kick_dt = !half_behind ? dt : first ? 0.5 * dt : rule.kick > 0.0 ? rule.kick : dt;
    step.newer = half_behind && !first ? 0.5 : 0.0;
    for (int c = 0; c < 3; ++c) {
        step.gravity[c] = rule.gravity[c];
    }
    step.damping = rule.damping;
    step.measure = measure;
    MotionSums out;
    kernel(view, step, rule.scheme, block.begin, block.end, out);
    return out;
}

} // namespace proveta
