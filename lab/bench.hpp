// From a deck to a specimen in the press: spheres, bonds, platens.
#pragma once

#include <cstdint>

#include "core/model.hpp"
#include "lab/network.hpp"

namespace proveta {

/// A specimen in the press, ready to be loaded, with what is known of it.
struct Bench : NetworkFacts {
    Specimen specimen;
    SpecimenStatistics statistics;
    Partition partition;
    double wave_speed = 0.0; ///< sqrt(a E / rho) of the deck's material, of loose matter that of its pack, m/s
    double grain = 0.0;      ///< mean diameter of a sphere, or of the sphere of a stone's volume, m
    std::uint64_t specimen_hash = 0;
    Press press; ///< its platens and pressures are the model's
    std::unique_ptr<Model> model;
};

/// Sets up the deck's test on a specimen. Throws InputError when deck and specimen do not fit together.
Bench set_up(const Deck& deck, Specimen specimen);

} // namespace proveta
