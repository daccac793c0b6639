// Which tests the decks on a command line ask for.
#pragma once

#include <string>
#include <vector>

#include "lab/deck.hpp"

namespace proveta {

/// A test of a series.
struct Member {
    std::string name; ///< of its folder within the series'
    Deck deck;
};

/// The tests to run: one, or a series.
struct Plan {
    bool series = false; ///< true for several decks, a deck with lists, or the manifest of a series; it may have a single member then
    std::string title;
    std::string study;           ///< what a series varies that is a study: "rate", "step" or "size"; empty: it is none
    std::vector<Member> members; ///< in the order of the decks and their lists; names and decks differ
};

/// Reads decks, deck by deck: each a deck, a deck with lists, or the manifest.json of an earlier run or series. settings: "a.b=v", applied
/// to all of them, lists included. Throws InputError with every problem of every member, each said once.
Plan read_plan(const std::vector<std::string>& files, const std::vector<std::string>& settings);

/// manifest.json of a series: what is needed to repeat it. hashes: of the members' specimens, one a member.
input::Json series_manifest(const Plan& plan, const std::vector<std::string>& hashes, const std::string& command, const std::string& status,
                            const std::string& started, const std::string& folder);

} // namespace proveta
