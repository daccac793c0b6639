#include "core/boundaries/pressure.hpp"

namespace proveta {

double pressure_forces(Spheres& spheres, Pressure& p, double dt) {
    p.force.resize(p.sphere.size());
    double work = 0.0;
    for (std::size_t k = 0; k < p.sphere.size(); ++k) {
        const auto s = static_cast<std::size_t>(p.sphere[k]);
        Vec3 normal = p.normal.at(k);
        if (p.radial) {
            const Vec3 out(spheres.position.x[s], spheres.position.y[s], 0.0);
            const double r = out.norm();
            normal = r > 0.0 ? Vec3(out / r) : normal;
        }
        const Vec3 force = -p.value * p.area[k] * normal;
        work += 0.5 * dt * (force + p.force.at(k)).dot(spheres.velocity.at(s));
        p.force.set(k, force);
        spheres.external_force.add(s, force);
    }
    return work;
}

} // namespace proveta
