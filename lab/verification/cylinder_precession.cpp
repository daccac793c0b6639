// Free precession of a cylinder (thesis 2.7.3, fig. 2.24).
#include <cmath>
#include <numbers>

#include "core/motion/rotation.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

namespace cylinder_precession_case {

constexpr double height = 1.5, radius = 0.5, density = 1.0, until = 0.5; // m, m, kg/m3, s
const double mass = density * std::numbers::pi * radius * radius * height;
const double axial = 0.5 * mass * radius * radius;
const double across = mass * (3.0 * radius * radius + height * height) / 12.0;
const Vec3 spin(0, 1, 100); // rad/s

// Euler's equations of a body of revolution: the spin across the axis turns in the body at the rate (1 - I_a/I_t) w_z.
double local_x(double t) { return std::sin((1.0 - axial / across) * spin.z() * t); }

// The axis turns about the angular momentum at the rate |H| / I_t.
Vec3 axis(double t) {
    const Vec3 h(0, across * spin.y(), axial * spin.z());
    return Eigen::AngleAxisd(h.norm() / across * t, h.normalized()) * Vec3::UnitZ();
}

struct Motion {
    report::Curve local;
    double spin_error = 0.0, axis_error = 0.0, momentum_error = 0.0, energy_error = 0.0;
};

template <class Advance> Motion rotate(const char* name, const char* colour, double dt, Advance advance) {
    rotation::State s = rotation::start({across, across, axial}, rotation::Quaternion::Identity(), spin);
    const Vec3 h = s.momentum;
    const double energy = rotation::energy(s);
    Motion out;
    out.local = {name, {}, {}, colour};
    const int steps = static_cast<int>(std::lround(until / dt));
    const int every = std::max(1, steps / 500);
    for (int n = 0; n <= steps; ++n) {
        const double t = n * dt;
        const double x = (s.attitude.conjugate() * s.spin).x();
        out.spin_error = std::max(out.spin_error, std::fabs(x - local_x(t)));
        out.axis_error = std::max(out.axis_error, (s.attitude * Vec3::UnitZ() - axis(t)).norm());
        out.momentum_error = std::max(out.momentum_error, (s.momentum - h).norm() / h.norm());
        out.energy_error = std::max(out.energy_error, std::fabs(rotation::energy(s) / energy - 1.0));
        if (n % every == 0) {
            out.local.x.push_back(t);
            out.local.y.push_back(x);
        }
        advance(s, Vec3::Zero(), dt);
    }
    return out;
}

Outcome compute() {
    const double dt = 1e-3; // a tenth of a radian a step
    const Motion rk4 = rotate("RK4, step 1e-3 s", "#1f4e79", dt, rotation::advance_rk4);
    const Motion half = rotate("RK4, step 5e-4 s", "#1e7b46", 0.5 * dt, rotation::advance_rk4);
    const Motion direct = rotate("direct, step 1e-3 s", "#c0392b", dt, rotation::advance_direct);
    const Motion tenth = rotate("direct, step 1e-4 s", "#b9770e", 0.1 * dt, rotation::advance_direct);
    Outcome out;
    // The scheme averages rotation vectors without commutators, which makes it one of second order: 2 % of the amplitudes, 1 rad/s and the
    // half angle of the cone, 0.02, over 25 radians of precession with a tenth of a radian a step.
    out.checks = {{"RK4: local w_x, largest error", 0.0, rk4.spin_error, 0.02, Compare::absolute, "rad/s", "\"much more accurate\""},
                  {"RK4: direction of the axis, largest error", 0.0, rk4.axis_error, 4e-4, Compare::absolute, "", ""},
                  {"RK4: angular momentum, largest relative error", 0.0, rk4.momentum_error, 1e-14, Compare::absolute, "", ""},
                  {"RK4: energy, largest relative error", 0.0, rk4.energy_error, 1e-6, Compare::absolute, "", ""},
                  {"RK4: order of local w_x, at least", 1.9, std::log2(rk4.spin_error / half.spin_error), 0.0, Compare::at_least, "", ""},
                  {"direct at a tenth of the step: local w_x, error over RK4's", 2.0, tenth.spin_error / rk4.spin_error, 0.0,
                   Compare::at_least, "", "worse than RK4"},
                  {"direct: local w_x, largest error", 0.0, direct.spin_error, 0.0, Compare::reported, "rad/s", ""},
                  {"direct: energy, largest relative error", 0.0, direct.energy_error, 0.0, Compare::reported, "", ""}};
    report::Curve exact{"exact", {}, {}, "#111111"};
    for (int k = 0; k <= 500; ++k) {
        exact.x.push_back(until * k / 500.0);
        exact.y.push_back(local_x(exact.x.back()));
    }
    out.plots = {{"Precession of a cylinder: local spin across the axis (fig. 2.24)",
                  "time [s]",
                  "local w_x [rad/s]",
                  {exact, rk4.local, direct.local, tenth.local},
                  {}}};
    out.notes = {"The scheme (2.95-2.97) is of second order in the attitude, not of fourth: an average of rotation vectors leaves out "
                 "their commutators."};
    return out;
}

} // namespace cylinder_precession_case

Case cylinder_precession() {
    using namespace cylinder_precession_case;
    return {"cylinder-precession", "2.7.3", "Torque-free precession of a cylinder by RK4 on quaternions and by direct integration.", false,
            compute};
}

} // namespace proveta::verification
