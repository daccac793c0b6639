// The stiffness tensor of a bond network from uniform strain states.
#pragma once

#include "core/statics/elastic.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Stiffness in Voigt's order xx, yy, zz, yz, zx, xy (engineering shear strains), Pa, and what it comes to.
struct StiffnessTensor {
    Eigen::Matrix<double, 6, 6> voigt = Eigen::Matrix<double, 6, 6>::Zero();
    double bulk_modulus = 0.0;   ///< K: mean of Voigt's and Reuss's average over all directions, Pa
    double shear_modulus = 0.0;  ///< G: the same, Pa
    double young_modulus = 0.0;  ///< 9 K G / (3 K + G), Pa
    double poisson_ratio = 0.0;  ///< (3 K - 2 G) / (2 (3 K + G))
    double anisotropy = 0.0;     ///< universal index 5 G_V/G_R + K_V/K_R - 6, 0 if isotropic (Ranganathan, Ostoja-Starzewski 2008)
    double from_isotropic = 0.0; ///< |C - C_iso| / |C| with the nearest isotropic tensor
    int iterations = 0;
};

/// The network's skin follows six uniform strains, turning freely; stress (Love-Weber) and strain are averaged over the inner 60 % of
/// width and height, so that the layer under the skin does not count. skin: 1 for spheres at the surface. Networks in space
/// only. Throws NotSolvable, std::invalid_argument for a plate or when the inner region holds too few spheres.
StiffnessTensor stiffness_tensor(const Shape& shape, const Spheres& spheres, const Bonds& bonds, const std::vector<std::uint8_t>& skin,
                                 double tolerance = 1e-7);

/// The same figures of a given tensor.
StiffnessTensor isotropic_figures(const Eigen::Matrix<double, 6, 6>& voigt);

} // namespace proveta
