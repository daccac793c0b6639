// The start of a uniaxial compression test without a test: the linear elastic solve between the platens, read by the same gauges.
#pragma once

#include "core/boundaries/platen.hpp"
#include "core/statics/elastic.hpp"
#include "lab/gauges.hpp"

namespace proveta {

/// What the gauges of a uniaxial test show at its very start.
struct UniaxialReading {
    double young_modulus = 0.0;  ///< platen stress over the middle gauge's strain, Pa
    double poisson_ratio = 0.0;  ///< minus the girth's over the middle gauge's strain
    double travel_modulus = 0.0; ///< platen stress over platen travel by height, Pa
    ElasticSolution solution;    ///< for a platen travel of a millionth of the height
};

/// Presses a network between two platens along z, in contact with what the platens of a test cap (axial_press), every contact
/// closed and, with friction, stuck: contacts of a test that slide at once are not represented. materials: of the spheres, for the
/// stiffness of the contacts. start: an earlier solution to begin from. Throws NotSolvable, std::invalid_argument for ends without spheres.
UniaxialReading press_uniaxially(const Shape& shape, const Spheres& spheres, const std::vector<Material>& materials, const Bonds& bonds,
                                 bool friction, const ElasticSolution* start = nullptr, double tolerance = 1e-8);

} // namespace proveta
