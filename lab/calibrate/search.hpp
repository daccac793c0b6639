// Which trials are worth their time next.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/calibrate/residual_model.hpp"

namespace proveta {

/// Points of the unit cube to try next, `count` of them. A function of the trials so far and of the seed alone, so that a search repeats
/// itself whatever order its trials end in, and goes on from where it was. The first are random. method, as in `SearchInput`: "global":
/// dlib's search (upper bounds by Lipschitz constants in turn with a trust region: Malherbe and Vayatis, ICML 2017; King's LIPO-TR), on
/// log(1 + score^2), told all earlier trials; "models": `ResidualModel` around the best trial; "mixed": half and half.
std::vector<std::vector<double>> propose(const std::vector<SearchPoint>& samples, std::size_t dimensions, std::size_t count,
                                         const std::string& method, std::uint64_t seed);

/// The sample of the least score among the complete ones; samples.size() when there is none.
std::size_t best_sample(const std::vector<SearchPoint>& samples);

} // namespace proveta
