// From a specimen and a deck to a bond network with the card's elasticity.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "lab/deck.hpp"
#include "lab/elastic/calibration.hpp"
#include "specimens/laguerre.hpp"
#include "specimens/statistics.hpp"

namespace proveta {

/// Calibration of one of the deck's materials.
struct MaterialCalibration {
    std::string name; ///< of the card
    ElasticCalibration result;
};

/// Bonds of the law facet that are too long to release their fracture energy (docs/theory.md).
struct LongBonds {
    std::size_t count = 0;
    double longest_allowed = 0.0; ///< m; 0: no bond of that law
};

/// What is known of a network.
struct NetworkFacts {
    double beta = 0.0;                     ///< interaction range used
    double coordination = 0.0;             ///< mean number of bonds a sphere
    std::optional<double> area_factor;     ///< alpha = 40 P / N_c, where a card leaves it to the specimen
    std::optional<LaguerreAreas> laguerre; ///< where a card's area rule wants it
    std::size_t dropped = 0;               ///< pairs within reach that are not bonded, because they share no facet
    LongBonds long_bonds;
    std::vector<MaterialCalibration> calibrations;
};

/// Bonded spheres.
struct Network : NetworkFacts {
    Spheres spheres; ///< in space-filling order
    std::vector<Material> materials;
    std::vector<std::uint8_t> skin; ///< of the spheres
    Bonds bonds;
    std::vector<double> weight; ///< area weights of the spheres, for later contacts
    Clusters clusters;          ///< stones, where the specimen is loose
};

/// Spheres in space-filling order, with materials and groups from the deck's regions.
Spheres make_spheres(const Specimen& specimen, const Deck& deck, std::vector<Material>& materials);

/// Hash of a specimen's spheres and stones: equal if and only if the bits are.
std::uint64_t hash_of(const Specimen& specimen);

/// Bonds the specimen as the deck says; each card whose elasticity is to be calibrated gets the factors with which the whole specimen,
/// made of it alone and in one cohesive group, would have the card's E and nu. Throws InputError when deck and specimen do not fit.
Network make_network(const Deck& deck, const Specimen& specimen, const SpecimenStatistics& statistics);

} // namespace proveta
