// The plots of a calibration's page.
#pragma once

#include <vector>

#include "lab/calibrate/calibrate_report.hpp"

namespace proveta {

/// What a target is compared with: the best trial, or the predictions of tests that were not fitted.
const TrialResult& result_for(const Target& target, const std::vector<Target>& targets, const CalibrationOutcome& outcome);

/// Scores over the trials.
report::Plot progress_plot(const CalibrationOutcome& outcome);

/// The score along each parameter about the best.
report::Plot profile_plot(const CalibrationPlan& plan, const Confidence& confidence);

/// Curves that are targets, with those of the card.
std::vector<report::Plot> curve_plots(const std::vector<Target>& targets, const CalibrationOutcome& outcome, const TrialFolders& folders);

} // namespace proveta
