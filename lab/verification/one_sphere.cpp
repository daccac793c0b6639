#include "lab/verification/one_sphere.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace proveta::verification {

Material OneSphere::material() const {
    Material m;
    m.density = density;
    m.young_modulus = young;
    m.poisson_ratio = poisson;
    m.contact_law = law;
    m.contact_restitution = restitution;
    return m;
}

double OneSphere::mass() const { return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

double OneSphere::hertz_stiffness() const {
    const double plane_strain = young / (1.0 - poisson * poisson);
    return 4.0 / 3.0 * (rigid_wall ? plane_strain : 0.5 * plane_strain) * std::sqrt(radius);
}

double OneSphere::overlap(double force) const { return std::pow(force / hertz_stiffness(), 2.0 / 3.0); }

Surface OneSphere::surface(SurfaceMesh mesh) const {
    Material wall = material();
    if (rigid_wall) {
        wall.young_modulus = std::numeric_limits<double>::infinity();
    }
    return {"wall", std::move(mesh), wall, friction};
}

Model make_model(const OneSphere& kind, const std::vector<Vec3>& centres, std::vector<Surface> surfaces, double dt) {
    Spheres s;
    for (const auto& centre : centres) {
        s.add(centre, kind.radius, kind.density);
    }
    const Material m = kind.material();
    std::vector<double> weight;
    Bonds none = make_bonds(s, {m}, {}, std::vector<std::uint8_t>(s.size(), 0), weight);
    Numerics numerics;
    numerics.damping = {0.0, 0.0};
    numerics.gravity = {0, 0, -9.81};
    numerics.time_step = dt;
    return {std::move(s), {m}, std::move(none), std::move(weight), Walls({}, std::move(surfaces)), numerics};
}

LedSphere::LedSphere(const OneSphere& kind, SurfaceMesh mesh, double speed, double dt, int every)
    : materials_{kind.material()}, surface_(kind.surface(std::move(mesh))), dt_(dt), skin_(1.01 * speed * dt * every), every_(every) {
    spheres_.add(Vec3::Zero(), kind.radius, kind.density);
}

void LedSphere::go(const Vec3& to) {
    if (step_ == 0) {
        spheres_.position.set(0, to);
    }
    spheres_.velocity.set(0, (to - spheres_.position.at(0)) / dt_);
    spheres_.position.set(0, to);
    if (step_++ % every_ == 0) {
        search_surface(spheres_, materials_, skin_, surface_);
    }
    surface_.sums = surface_forces(spheres_, surface_, 0, loads_.blocks()[0], {dt_, dt_}, loads_);
}

double LedSphere::tangential_forces() const {
    double sum = 0.0;
    for (const auto& t : touches()) {
        const Vec3 n = (spheres_.position.at(0) - surface_.to_space(t.point)).normalized();
        sum += (t.force - n * n.dot(t.force)).norm();
    }
    return sum;
}

} // namespace proveta::verification
