// From the members of a series to what is reported of it.
#pragma once

#include <string>
#include <vector>

#include "lab/series/member_result.hpp"
#include "lab/series/seed_groups.hpp"
#include "lab/series/strengths.hpp"

namespace proveta {

/// All that a series has found.
struct SeriesResults {
    std::string status; ///< complete, interrupted or failed
    std::vector<MemberResult> members;
    std::vector<SeedGroup> groups;
    std::optional<StrengthEnvelope> envelope;
    std::vector<report::Scalar> scalars; ///< of the envelope, then ratios of strengths
};

/// What follows from the members. The series is interrupted as long as one of them is, or was not run.
SeriesResults evaluate(std::vector<MemberResult> members);

/// Every result that a member has, and the name of every verdict: each once, in the order of the members.
std::vector<report::Scalar> all_results(const std::vector<MemberResult>& members);
std::vector<std::string> all_badges(const std::vector<MemberResult>& members);

/// Where a group's mean curve is written, relative to the series' folder.
std::string mean_curve_file(const SeedGroup& group);

/// How the members ended, in a sentence.
std::string ending(const SeriesResults& results);

/// The series' page.
report::Record series_record(const Plan& plan, const SeriesResults& results);

/// summary.json of a series.
input::Json series_summary(const report::Record& record, const SeriesResults& results);

/// series.csv: one row a member, results in SI units; a cell is empty where a test does not have the result or could not find it.
report::TextTable series_table(const SeriesResults& results);

/// The outcome for a terminal.
std::string series_text(const report::Record& record, const SeriesResults& results);

} // namespace proveta
