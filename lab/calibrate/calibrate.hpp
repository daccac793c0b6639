// Finding the card that reproduces what was measured.
#pragma once

#include <string>
#include <vector>

#include "lab/calibrate/confidence.hpp"
#include "lab/calibrate/residual_model.hpp"
#include "lab/calibrate/residuals.hpp"

namespace proveta {

/// A trial of a calibration with what came of it.
struct CalibrationTrial {
    std::string phase;  ///< "search", "finish"
    bool whole = false; ///< on the decks' whole specimens
    std::vector<double> u;
    TrialResult result;
    Deviations deviations; ///< as found, without correction
};

/// A round on whole specimens.
struct Round {
    std::size_t trial = 0;     ///< index among the trials
    double expected = 0.0;     ///< score that the corrected search had found
    double score = 0.0;        ///< score on whole specimens
    std::vector<double> shift; ///< what is added to the deviations of small specimens from here on
};

/// All that a calibration found.
struct CalibrationOutcome {
    std::vector<CalibrationTrial> trials; ///< in the order asked
    std::vector<Round> rounds;
    std::size_t best = 0;    ///< index among the trials
    TrialResult predictions; ///< of the tests that were not fitted; no jobs when there are none
    std::optional<Confidence> confidence;

    [[nodiscard]] const CalibrationTrial& best_trial() const { return trials[best]; }
};

/// Told between the batches.
using CalibrationProgress = std::function<void(const std::string& phase, const CalibrationOutcome& so_far)>;

/// Searches on small specimens, then in rounds on whole ones: each evaluates the best of the search, and the difference between whole and
/// small specimens there is added to the deviations of all small ones before the search goes on (space mapping: Bandler et al., IEEE Trans.
/// Microw. Theory Tech. 42 (1994) 2536). Every trial goes through the book, so that a calibration that was ended goes on without repeating
/// any. Throws std::runtime_error when no trial at all gave every target, and what the book throws.
CalibrationOutcome calibrate(const CalibrationPlan& plan, const std::vector<Target>& targets, TrialBook& book,
                             const CalibrationProgress& progress);

/// The card of a trial, with its evidence.
input::Json calibrated_card(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                            const TrialFolders& folders);

} // namespace proveta
