// The particles: rigid spheres, one array per quantity.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/vector_field.hpp"
#include "core/particles/sphere_view.hpp"

namespace proveta {

/// Spheres of a specimen. All arrays have one entry per sphere; SI units. Velocities live half a step behind the positions (leapfrog
/// form of velocity Verlet): `position` at time t, `velocity` and `spin` at t - dt/2 when a step begins.
struct Spheres {
    VectorField position;         ///< centres, m
    VectorField velocity;         ///< m/s
    VectorField spin;             ///< angular velocity, rad/s
    VectorField start;            ///< centres at the start of the test, m
    std::vector<double> radius;   ///< m
    std::vector<double> mass;     ///< kg
    std::vector<double> inertia;  ///< 2/5 m R^2; of a disc 1/2 m R^2, kg m^2
    std::vector<int> group;       ///< cohesive group: only spheres of one group are bonded
    std::vector<int> material;    ///< index into the model's materials
    std::vector<std::int64_t> id; ///< number in the file or recipe that the sphere came from
    bool planar = false;          ///< discs of unit thickness in the plane y = 0, about axis y; set before any is added

    bool packed =
        true; ///< as they start they press on nothing: overlaps of a packing store no energy. False: overlaps press from the start

    [[nodiscard]] std::size_t size() const { return radius.size(); }

    [[nodiscard]] SphereView view() const;

    /// Volume of a sphere, or of a disc of 1 m thickness, m3.
    [[nodiscard]] double volume(std::size_t k) const;
    /// Largest section, m2: pi R^2 of a sphere, 2 R of a disc of 1 m thickness.
    [[nodiscard]] double section(std::size_t k) const;

    /// Appends a sphere at rest. centre and radius in m, density in kg/m3.
    void add(const Vec3& centre, double r, double density, int cohesive_group = 0, int material_index = 0);
    /// As `Model::visit_state`, for which spheres there are and what they are, without where they are. Throws std::runtime_error when
    /// the quantities are not as many each.
    template <class Visit> void visit_members(Visit&& visit);
    /// Appends a sphere of another set as it is.
    void append(const Spheres& from, std::size_t k);

  private:
    void fit_members();
};

template <class Visit> void Spheres::visit_members(Visit&& visit) {
    std::vector<double> numbers(id.begin(), id.end()); // exact up to 2^53
    visit("member_id", numbers);
    visit("member_radius", radius);
    visit("member_mass", mass);
    visit("member_inertia", inertia);
    visit("member_group", group);
    visit("member_material", material);
    visit("member_start_x", start.x);
    visit("member_start_y", start.y);
    visit("member_start_z", start.z);
    id.assign(numbers.begin(), numbers.end());
    fit_members();
}

/// m; 0 without any.
double mean_radius(const Spheres& spheres);

} // namespace proveta
