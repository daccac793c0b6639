// Results for programs and for a terminal.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "lab/test_run.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// The badges as they stand in summary.json.
input::Json verdicts_of(const std::vector<report::Badge>& badges);

/// summary.json: what the test found and nothing of how long it took, so that two runs of one deck have the same to the byte.
input::Json summary(const report::Record& record, const Bench& bench, const TestData& data);

/// Results and verdicts for a terminal.
std::string as_text(const report::Record& record);

} // namespace proveta
