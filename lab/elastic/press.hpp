// The modulus of a bond network without a test: compressed between lubricated ends by the linear elastic solve.
#pragma once

#include "core/statics/elastic.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// What a small compression along z shows.
struct MacroElasticity {
    double young_modulus = 0.0; ///< end force over section and mean axial strain, Pa
    double poisson_ratio = 0.0; ///< minus lateral over axial strain; in space the mean of x and y
    int iterations = 0;         ///< of the solver, 0: direct
};

/// Compresses the network: the spheres that touch an end (within 1.1 of their radius) move by a prescribed amount along z and slide and
/// turn freely. Strains are slopes of a plane fitted to the displacements of the well-bonded spheres in the middle 80 % of the width and 60
/// % of the height, so that the ends, where rows of spheres are held, do not count. Spheres of a single bond can roll about it: a weak
/// anchor keeps them, which alters E by some 1e-7. Throws NotSolvable, std::invalid_argument for ends without spheres.
MacroElasticity press_elastically(const Shape& shape, const Spheres& spheres, const Bonds& bonds,
                                  const ElasticOptions& options = {.anchor = 1e-10});

} // namespace proveta
