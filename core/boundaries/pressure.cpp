#include "core/boundaries/pressure.hpp"

namespace proveta {

double pressure_forces(const Spheres& spheres, Pressure& p, const SphereBlock& block, double dt, Loads& loads) {
    double work = 0.0;
    const ListedRange range = listed_in(p.sphere, block);
    for (std::size_t k = range.begin; k < range.end; ++k) {
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
        loads.add(s, force, Vec3::Zero());
    }
    return work;
}

} // namespace proveta
