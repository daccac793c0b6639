// How far a trial is from the targets.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/calibrate/input.hpp"
#include "lab/calibrate/target_curve.hpp"
#include "lab/trials/book.hpp"

namespace proveta {

/// A target ready to be compared with.
struct Target {
    TargetInput input;
    double weight = 1.0; ///< its own times its test's
    TargetCurve file;    ///< of a curve
};

/// Loads the curves. Throws InputError with every problem.
std::vector<Target> make_targets(const CalibrationPlan& plan);

/// One target's part of a trial.
struct Comparison {
    bool found = false;            ///< the trial has what the target speaks of
    double value = 0.0;            ///< of a result, mean over specimens
    SampledCurve curve;            ///< of a curve, mean over specimens at the target's x
    double distance = 0.0;         ///< relative: of a result (value - target) / target, of a curve its root mean square distance
    std::vector<double> deviation; ///< in tolerances; the sum of squares is the square of distance over tolerance where small
};

/// Compares a trial with a target. A result deviates by ln(value / target) / tolerance where both are positive; a curve by what it misses
/// at points evenly over the target's x, over tolerance and root mean square of the target's y. A trial that lacks it deviates by
/// `missing_deviation`.
Comparison compare(const Target& target, const TrialResult& result, const TrialFolders& folders);

/// Deviation, in tolerances, of what a trial has failed to give.
constexpr double missing_deviation = 10.0;

/// All fitted targets' deviations one after the other, each times the root of its share of the weights, so that the sum of squares is the
/// square of the score: the weighted root mean square, in tolerances.
struct Deviations {
    std::vector<double> all;
    bool complete = true; ///< no target was missed for want of a result

    [[nodiscard]] double score() const;
};
Deviations deviations(const std::vector<Target>& targets, const TrialResult& result, const TrialFolders& folders);

/// Which of a test's decks a calibration may end early: the last strain that its targets speak of, or soon after the peak.
void shorten(TrialTest& test, const std::vector<Target>& targets);

} // namespace proveta
