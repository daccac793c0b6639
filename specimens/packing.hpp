// Random dense packings by relaxation of overlapping spheres.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/geometry/vector_field.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Spheres in space. Lengths in m.
struct Packing {
    VectorField centre;
    std::vector<double> radius;
};

/// How far a relaxation went.
struct Relaxation {
    int iterations = 0;
    double residual = 0.0; ///< mean net force over mean contact force
};

/// Places spheres of the given radii at random in the shape and relaxes their overlaps (harmonic repulsion, minimised by FIRE: E. Bitzek
/// et al., Phys. Rev. Lett. 97, 170201, 2006) until net forces are `tolerance` of the contact forces. Every sphere stays inside, its
/// centre at least a radius from the surface, which makes flat, well covered ends and sides. The solid fraction, overlaps counted twice,
/// is given by the radii. Same seed, same packing, whatever the number of threads. progress (0 to 1) may be empty.
Packing pack(const Shape& shape, const std::vector<double>& radii, std::uint64_t seed, double tolerance, Relaxation& report,
             const std::function<void(double)>& progress = {});

} // namespace proveta
