// From a deck to a specimen in the press: spheres, bonds, platens.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/model.hpp"
#include "lab/deck.hpp"
#include "specimens/laguerre.hpp"
#include "specimens/statistics.hpp"

namespace proveta {

/// A specimen in the press, ready to be loaded, with what is known of it.
struct Bench {
    Specimen specimen;
    SpecimenStatistics statistics;
    Partition partition;
    double beta = 0.0;                     ///< interaction range used
    double coordination = 0.0;             ///< mean number of bonds a sphere
    std::optional<double> area_factor;     ///< alpha = 40 P / N_c, where a card leaves it to the specimen
    std::optional<LaguerreAreas> laguerre; ///< where a card's area rule wants it
    std::size_t dropped = 0;               ///< pairs within reach that are not bonded, because they share no facet
    double wave_speed = 0.0;               ///< sqrt(a E / rho) of the deck's material, m/s
    std::uint64_t specimen_hash = 0;
    std::vector<std::uint8_t> skin; ///< of the model's spheres, in its order
    Press press;                    ///< its platens and pressures are the model's
    std::unique_ptr<Model> model;
};

/// Spheres in space-filling order, with materials and groups from the deck's regions.
Spheres make_spheres(const Specimen& specimen, const Deck& deck, std::vector<Material>& materials);

/// Sets up the deck's test on a specimen. Throws InputError when deck and specimen do not fit together.
Bench set_up(const Deck& deck, Specimen specimen);

/// Hash of a specimen's spheres: equal if and only if the bits are.
std::uint64_t hash_of(const Specimen& specimen);

} // namespace proveta
