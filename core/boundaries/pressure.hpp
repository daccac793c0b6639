// A pressure on the surface of a bonded specimen: forces on its surface spheres (thesis 5.5.3).
#pragma once

#include <vector>

#include "core/contacts/loads.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Pressure p on a set of spheres, each standing for a piece of the surface: F = -p A n. The pieces add up to the surface they stand for.
/// Normals of a lateral surface follow the specimen as it deforms: they point from the axis (x = y = 0) to where the sphere is now.
struct Pressure {
    double value = 0.0;               ///< Pa, positive presses inwards
    std::vector<std::int32_t> sphere; ///< ascending
    std::vector<double> area;         ///< m2
    VectorField normal;               ///< outward, at the start
    bool radial = false;              ///< a cylinder's side: normals follow
    VectorField force;                ///< of the last step, N
};

/// Adds the forces of the pressure on one block of spheres to the loads. `force` has one entry a sphere of the pressure. Returns the work
/// done in the step of dt seconds, J.
double pressure_forces(const Spheres& spheres, Pressure& pressure, const SphereBlock& block, double dt, Loads& loads);

} // namespace proveta
