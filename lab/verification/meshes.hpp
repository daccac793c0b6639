// Our counterparts of the meshes of table 5.3: relaxed packings with the same counts, radii, porosity and coordination (the thesis's are
// GiD meshes).
#pragma once

#include <string>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "specimens/specimen.hpp"
#include "specimens/statistics.hpp"

namespace proveta::verification {

/// A specimen with its pairs to bond.
struct Mesh {
    std::string name;
    Specimen specimen;
    SpecimenStatistics statistics;
    Spheres spheres; ///< in the specimen's order
    std::vector<Pair> pairs;
    std::vector<std::uint8_t> skin;
    double beta = 0.0;         ///< interaction range used
    double coordination = 0.0; ///< mean number of pairs a sphere

    /// Bonds with areas by the material's rule; given: areas for the rule `laguerre`.
    [[nodiscard]] Bonds bonds(const Material& material, const Areas* given = nullptr) const;
};

/// Bonds a specimen's spheres to the wished mean coordination; 0: those that touch.
Mesh make_mesh(std::string name, Specimen specimen, double coordination);

/// Plates 5 x 10 cm like 2D-1 to 2D-4, and like 2D-5 the square lattice of 13 x 25 discs of 2 mm radius (5.2 x 10 cm). k from 1 to 5.
Mesh plate_mesh(int k);

/// Cylinders 15 x 30 cm like 3D-1 and 3D-2. k is 1 or 2.
Mesh cylinder_mesh(int k);

/// A cylinder 15 x 30 cm with the statistics of 3D-2 but another number of spheres and coordination 10, the program's default.
Mesh small_cylinder(std::int64_t spheres, std::int64_t seed);

} // namespace proveta::verification
