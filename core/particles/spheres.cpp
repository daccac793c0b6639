#include "core/particles/spheres.hpp"

#include <numbers>

namespace proveta {

SphereView Spheres::view() const {
    return {{position.x.data(), position.y.data(), position.z.data()},
            {velocity.x.data(), velocity.y.data(), velocity.z.data()},
            {spin.x.data(), spin.y.data(), spin.z.data()}};
}

void Spheres::add(const Vec3& centre, double r, double density, int cohesive_group, int material_index) {
    for (auto* field : {&position, &start}) {
        field->push_back(centre);
    }
    for (auto* field : {&velocity, &spin, &force, &torque, &external_force, &external_torque}) {
        field->push_back(Vec3::Zero());
    }
    const double m = density * 4.0 / 3.0 * std::numbers::pi * r * r * r;
    radius.push_back(r);
    mass.push_back(m);
    inertia.push_back(0.4 * m * r * r);
    group.push_back(cohesive_group);
    material.push_back(material_index);
    id.push_back(static_cast<std::int64_t>(id.size()));
}

} // namespace proveta
