// A deck with lists stands for several: one a member of the lists' product.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/input/json.hpp"

namespace proveta {

/// Where in a list a deck's value was taken from.
struct ListEntry {
    std::string path; ///< JSON pointer of the list
    std::string list; ///< as written, for messages
    std::size_t index = 0;
    std::size_t size = 0; ///< of the list
};

/// One of the decks that a deck with lists stands for.
struct ExpandedDeck {
    input::Json json;               ///< without lists
    std::string label;              ///< what the lists make of it, e.g. "p_4.5MPa_seed_2"; empty for a deck without lists
    std::vector<ListEntry> entries; ///< one a list
};

/// True when a key that may be a list (loading.confining_pressure, specimen.seed) is one.
bool has_lists(const input::Json& deck);

/// The decks that a deck stands for, the pressures in the outer loop; itself alone if it has no lists. Lists that are empty, too long or
/// name a value twice are appended to `problems`; what else may be wrong with an entry is for read_deck to say.
std::vector<ExpandedDeck> expand(const input::Json& deck, const std::string& file, input::Problems& problems);

/// Lets the keys that may be lists be lists in the schema of a test's decks.
void allow_lists(input::Json& schema);

/// A problem of one of the decks that a deck stands for, with the lists' entries that made it.
struct MemberProblem {
    input::Problem problem;
    std::vector<ListEntry> entries;
};

/// What the user should read: every problem once, problems of a list's value at the place of the entry ("/loading/confining_pressure/2"),
/// or of the list when all entries have the same.
input::Problems merged(const std::vector<MemberProblem>& found);

} // namespace proveta
