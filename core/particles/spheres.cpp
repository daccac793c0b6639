#include "core/particles/spheres.hpp"

#include <numbers>
#include <numeric>
#include <stdexcept>

namespace proveta {

using std::numbers::pi;

SphereView Spheres::view() const {
    return {{position.x.data(), position.y.data(), position.z.data()},
            {velocity.x.data(), velocity.y.data(), velocity.z.data()},
            {spin.x.data(), spin.y.data(), spin.z.data()},
            static_cast<std::int32_t>(size())};
}

double Spheres::volume(std::size_t k) const {
    const double r = radius[k];
    return planar ? pi * r * r : 4.0 / 3.0 * pi * r * r * r;
}

double Spheres::section(std::size_t k) const { return planar ? 2.0 * radius[k] : pi * radius[k] * radius[k]; }

void Spheres::add(const Vec3& centre, double r, double density, int cohesive_group, int material_index) {
    for (auto* field : {&position, &start}) {
        field->push_back(centre);
    }
    for (auto* field : {&velocity, &spin}) {
        field->push_back(Vec3::Zero());
    }
    radius.push_back(r);
    const double m = density * volume(radius.size() - 1);
    mass.push_back(m);
    inertia.push_back((planar ? 0.5 : 0.4) * m * r * r);
    group.push_back(cohesive_group);
    material.push_back(material_index);
    id.push_back(static_cast<std::int64_t>(id.size()));
}

// What moves becomes as long as what there is.
void Spheres::fit_members() {
    const std::size_t n = radius.size();
    for (const std::size_t other :
         {id.size(), mass.size(), inertia.size(), group.size(), material.size(), start.x.size(), start.y.size(), start.z.size()}) {
        if (other != n) {
            throw std::runtime_error("the quantities of the spheres are not as many each");
        }
    }
    for (auto* field : {&position, &velocity, &spin}) {
        field->resize(n);
    }
}

void Spheres::append(const Spheres& from, std::size_t k) {
    position.push_back(from.position.at(k));
    velocity.push_back(from.velocity.at(k));
    spin.push_back(from.spin.at(k));
    start.push_back(from.start.at(k));
    radius.push_back(from.radius[k]);
    mass.push_back(from.mass[k]);
    inertia.push_back(from.inertia[k]);
    group.push_back(from.group[k]);
    material.push_back(from.material[k]);
    id.push_back(from.id[k]);
}

double mean_radius(const Spheres& s) {
    return s.size() == 0 ? 0.0 : std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / static_cast<double>(s.size());
}

} // namespace proveta
