// Running several tests at once, to one folder.
#pragma once

#include "lab/run.hpp"
#include "lab/series/plan.hpp"

namespace proveta {

/// Carries out the members of a series, several at once as threads and memory allow, each in a folder of its own within the series' folder,
/// where it leaves the same bytes as by itself; writes what the series says as a whole, and prints it on stdout. threads: of all members
/// together. Members of one recipe share a specimen. A member that fails does not stop the others; an interrupt stops all. Throws
/// InputError, before anything is written, when a member's input is wrong.
RunStatus run_series(const Plan& plan, const RunOptions& options, int threads);

} // namespace proveta
