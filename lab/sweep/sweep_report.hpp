// A sweep as a page, as JSON and as text.
#pragma once

#include "lab/sweep/curves.hpp"

namespace proveta {

/// What the page and the summary are made of.
struct SweepOutcome {
    SweepTable table;
    std::vector<std::vector<Sensitivity>> sensitivities;
    std::vector<TestCurves> curves;
};

report::Record sweep_record(const Sweep& sweep, const SweepOutcome& outcome);

/// summary.json.
input::Json sweep_summary(const Sweep& sweep, const SweepOutcome& outcome, const report::Record& record);

/// What matters, for a terminal.
std::string sweep_text(const Sweep& sweep, const SweepOutcome& outcome, const report::Record& record);

/// Columns of the results that stand for a test, at most four: those asked for, or strengths, stiffness and strain at the peak.
std::vector<std::size_t> main_results(const Sweep& sweep, const SweepTable& table, const std::string& test);

/// The parameters by their influence on a result, the strongest first.
std::vector<std::size_t> by_influence(const std::vector<Sensitivity>& of_result);

} // namespace proveta
