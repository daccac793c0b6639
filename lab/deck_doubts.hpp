// What a deck may well not mean although it can be run.
#pragma once

#include <string>
#include <vector>

#include "core/input/quantities.hpp"
#include "lab/deck.hpp"

namespace proveta {

/// Values that are likely to lack their unit, and bonds whose stiffness and strengths do not go together: each a sentence that begins with
/// the JSON path.
std::vector<std::string> doubts_of(const Deck& deck);

/// Of declared numbers, those that are likely to lack their unit; the same sentences.
std::vector<std::string> likely_without_unit(const std::vector<input::DeclaredQuantity>& all);

} // namespace proveta
