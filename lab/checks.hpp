// What can be told of a test before it runs, so that nobody waits for it.
#pragma once

#include <string>
#include <vector>

#include "lab/bench.hpp"

namespace proveta {

/// What the user should know of a deck, whatever its specimen.
std::vector<std::string> warnings_of_deck(const Deck& deck);

/// What the user should know of a specimen in its press.
std::vector<std::string> warnings_in_press(const Bench& bench, const Deck& deck);

/// Puts a stored specimen into its press; of one that is to be made, looks whether there is memory for it. Returns all warnings that can be
/// told. Throws InputError when deck and specimen do not fit together.
std::vector<std::string> check_before(const Deck& deck);

} // namespace proveta
