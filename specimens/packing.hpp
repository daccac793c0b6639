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
    double residual = 0.0;             ///< mean net force over mean contact force
    double largest_overlap = 0.0;      ///< of two spheres, over the smaller radius
    std::vector<std::uint32_t> number; ///< of each sphere of the packing in the list of radii
};

/// Places spheres of the given radii at random in the shape and relaxes their overlaps (harmonic repulsion, minimised by FIRE: E. Bitzek
/// et al., Phys. Rev. Lett. 97, 170201, 2006) until net forces are `tolerance` of the contact forces. Every sphere stays inside, its
/// centre at least a radius from the surface, which makes flat, well covered ends and sides. The solid fraction, overlaps counted twice,
/// is given by the radii. The spheres come in an order of space, not in that of their radii. Same seed, same packing, whatever the number
/// of threads. progress (0 to 1) may be empty. enough: largest overlap, over the smaller radius, with which the relaxation may end sooner.
Packing pack(const Shape& shape, const std::vector<double>& radii, std::uint64_t seed, double tolerance, Relaxation& report,
             const std::function<void(double)>& progress = {}, double enough = 0.0);

} // namespace proveta
