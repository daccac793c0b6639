// What a calibration leaves to be read.
#pragma once

#include "lab/calibrate/calibrate.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// trials.csv: one row a trial, in the order asked: phase, parameters, score, every target's result or distance.
report::TextTable trials_table(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                               const TrialFolders& folders);

/// The page.
report::Record calibration_record(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                                  const TrialFolders& folders);

/// summary.json.
input::Json calibration_summary(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                                const report::Record& record, const input::Json& card);

} // namespace proveta
