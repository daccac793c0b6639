// What a specimen is like, in numbers.
#pragma once

#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/particles/spheres.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

/// Statistics of a packing. Lengths in m. Of stones the radius is that of the sphere of a stone's volume, neighbours are other stones, and
/// at the surface it is their spheres that count.
struct SpecimenStatistics {
    std::size_t spheres = 0; ///< those of stones too
    std::size_t stones = 0;
    double mean_radius = 0.0;
    double relative_deviation = 0.0; ///< standard deviation of the radii over their mean
    double smallest_radius = 0.0;
    double largest_radius = 0.0;
    double porosity = 0.0;        ///< overlaps counted twice; of stones by their volumes
    double touching = 0.0;        ///< mean number of touching neighbours
    double largest_overlap = 0.0; ///< over the smaller radius of the pair
    double fabric_deviator = 0.0; ///< of the fabric tensor of touching pairs, sqrt(3/2 dev:dev), in a plane sqrt(2 dev:dev); 0: isotropic
    std::size_t outside = 0;      ///< spheres that reach beyond the shape by more than a thousandth of their radius
    std::size_t on_lower_end = 0; ///< spheres within a tenth of their radius of z = 0
    std::size_t on_upper_end = 0;
};

SpecimenStatistics statistics(const Specimen& specimen);

/// Marks spheres that are not surrounded by neighbours: those whose centre is nearer to the surface than 1.2 radii.
std::vector<std::uint8_t> skin_spheres(const Specimen& specimen);

/// How well bond areas fill the specimen (thesis 5.4.1).
struct Partition {
    double section = 0.0;  ///< mean over cuts across the axis of the summed projected bond areas, over the nominal section
    double interior = 0.0; ///< the same within the inner 60 % of the diameter
    double filling = 0.0;  ///< sum(A d) / V; 3 fills space, 2 a plane
};

/// Cuts the network by many planes across z, between a tenth and nine tenths of the height.
Partition partition(const Shape& shape, const Spheres& spheres, const Bonds& bonds);

} // namespace proveta
