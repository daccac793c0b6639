// Carrying a sweep out, or having it carried out elsewhere.
#pragma once

#include <string>

#include "lab/run.hpp"
#include "lab/sweep/sweep.hpp"
#include "lab/trials/book.hpp"

namespace proveta {

/// Where and how.
struct SweepOptions {
    std::string out;     ///< result folder
    std::string command; ///< as typed, for the manifest
    int threads = 0;     ///< 0: as OpenMP has
    bool quiet = false;
    BookMode mode = BookMode::run;
};

/// Carries out what the folder's ledger does not have yet, then writes table, sensitivities and report. Failed as a whole only when every
/// point has failed. Throws InputError for a folder that cannot be used; in the mode `plan`, TrialsPlanned when trials are missing.
RunStatus run_sweep(const Sweep& sweep, const SweepOptions& options);

/// How far a sweep in a folder is, as text; changes nothing there.
std::string sweep_status(const Sweep& sweep, const std::string& out);

} // namespace proveta
