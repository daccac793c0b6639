// Running several tests at once, to one folder.
#pragma once

#include <functional>

#include "lab/run.hpp"
#include "lab/series/member_result.hpp"
#include "lab/series/plan.hpp"

namespace proveta {

/// What someone who has planned a series makes of it besides.
struct SeriesExtra {
    std::vector<report::Scalar> results;
    std::vector<report::Plot> plots;            ///< shown before the series' own
    std::vector<report::TextTable> tables;      ///< the same
    std::vector<report::KeyFigure> key_figures; ///< in the place of the series' own, if there are any
    std::vector<std::string> warnings;
    std::string csv_name;  ///< file for `csv`; empty: none
    report::TextTable csv; ///< SI units
};
using SeriesStudy = std::function<SeriesExtra(const std::vector<MemberResult>&)>;

/// Says, on stderr, what the user should know of the tests of a plan, a series or one, before they run. Throws InputError with all problems
/// that can be told without making a specimen.
void check_members(const Plan& plan);

/// Carries out the members of a series, several at once as threads and memory allow, each in a folder of its own within the series' folder,
/// where it leaves the same bytes as by itself; writes what the series says as a whole, and prints it on stdout. threads: of all members
/// together. Members of one recipe share a specimen. A member that fails does not stop the others; an interrupt stops all. study: adds
/// to the report and the summary. Throws
/// InputError, before anything is written, when a member's input is wrong.
RunStatus run_series(const Plan& plan, const RunOptions& options, int threads, const SeriesStudy& study = {});

} // namespace proveta
