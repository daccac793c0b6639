// Where strains are read on a specimen: the middle gauge length along z, and the girth at mid-height.
#pragma once

#include <cstdint>
#include <vector>

#include "core/particles/spheres.hpp"
#include "specimens/shape.hpp"

namespace proveta {

class Gauges {
  public:
    /// Chooses the gauges' spheres by where the spheres start. Middle gauge: as long as the specimen is wide, at most half its height,
    /// between two bands of three mean radii. Girth: the lateral skin within a sixth of the height about the middle.
    Gauges(const Shape& shape, const Spheres& spheres);

    /// Shortening of the middle gauge over its length. left_out[k] != 0: sphere k is not part of the specimen any more.
    [[nodiscard]] double axial_strain(const VectorField& position, const std::vector<std::uint8_t>& left_out) const;

    /// Shortening of the mean distance of the girth's spheres from the axis, positive when the specimen gets thinner.
    [[nodiscard]] double girth_strain(const VectorField& position, const std::vector<std::uint8_t>& left_out) const;

  private:
    struct Band {
        std::vector<std::size_t> spheres;
        std::vector<double> start; // z, m
        double height = 0.0;       // its mean, m
    };
    [[nodiscard]] static double rise(const Band& band, const VectorField& position, const std::vector<std::uint8_t>& left_out);

    Band lower_, upper_;
    std::vector<std::size_t> girth_;
    std::vector<double> girth_radius_; // distance from the axis at the start, m
};

} // namespace proveta
