// Running a test from a deck to a folder of results.
#pragma once

#include <string>

#include "lab/deck.hpp"

namespace proveta {

struct RunOptions {
    std::string out;     ///< result folder
    std::string command; ///< as typed, for the manifest
    bool quiet = false;
};

/// How a run ended.
enum class RunStatus { complete, interrupted, failed };

/// Makes or loads the specimen, tests it, writes the folder, prints the results on stdout. Throws InputError before anything is
/// written when the input is wrong.
RunStatus run_test(const Deck& deck, const RunOptions& options);

} // namespace proveta
