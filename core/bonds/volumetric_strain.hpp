// The strain around spheres, for laws whose pores collapse under the mean pressure and not under that of one facet alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/particles/spheres.hpp"

namespace proveta {

struct Bonds;

/// Mean normal strain around each sphere, a third of its change of volume as its bonds' lengths show it (in a plane a half), positive in
/// tension: e_V = sum A l e / (d V), V = sum A l, over its bonds with the lever arm l and the elongation of centres e.
struct VolumetricStrain {
    static constexpr std::int64_t every = 50; ///< steps between two evaluations: pores collapse over thousands
    std::vector<double> strain;               ///< of each sphere; empty: no law asks for it
    std::vector<double> weight_i, weight_j;   ///< of each bond's elongation in e_V of its two spheres, 1/m

    [[nodiscard]] bool active() const { return !strain.empty(); }
};

VolumetricStrain volumetric_strain(const Spheres& spheres, const Bonds& bonds);

/// Brings the strain of spheres begin to end up to their positions.
void measure_volumetric_strain(const Spheres& spheres, Bonds& bonds, std::size_t begin, std::size_t end);

} // namespace proveta
