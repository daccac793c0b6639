// What the data of a test say against its own results: each a sentence for the warnings, or empty.
#pragma once

#include <string>
#include <vector>

#include "lab/axial_results.hpp"
#include "lab/bench.hpp"
#include "materials/card.hpp"

namespace proveta {

/// Few spheres carry what a platen presses with. touching: of each loading platen at the start.
std::string few_at_platens(const std::vector<std::size_t>& touching);

/// The network is not of the coordination that cards of the program hold for, on which strengths depend. planar: discs in a plane.
std::string unlike_the_cards(const Card& card, double coordination, bool planar);

/// The curve falls off a peak and rises above it again.
std::string recovered_peak(const Loading& loading);

/// Bonds failed while the specimen was unloaded. bonds: number of all.
std::string broken_by_unloading(const report::Table& curve, const std::vector<FailureEvent>& events, std::size_t bonds, double sense);

/// The Young's modulus among the results is not the card's, where that is the specimen's, or could not be measured.
std::string modulus_off(const Card& card, const std::vector<report::Scalar>& results, const Measured& measured);

/// All of these for a test of a bonded specimen.
std::vector<std::string> doubts_about(const Card& card, const Bench& bench, const std::vector<report::Scalar>& results,
                                      const Measured& measured);

} // namespace proveta
