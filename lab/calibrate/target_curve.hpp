// A measured curve as a target: what a laboratory's file holds, made to what a test gives.
#pragma once

#include <string>
#include <vector>

#include "lab/calibrate/input.hpp"
#include "lab/series/mean_curve.hpp"

namespace proveta {

/// A curve that is compared with, SI, in the sense of the test.
struct TargetCurve {
    SampledCurve measured;             ///< all points in the order in which they were measured
    SampledCurve compared;             ///< those by which x goes on beyond all before, within the range that counts
    double toe = 0.0;                  ///< strain that was taken off as toe
    std::vector<std::string> notes;    ///< which columns were read as what
    std::vector<std::string> warnings; ///< what is not compared, or was left out
};

/// Loads a target's curve. test: the deck's test, "ucs". last: x at which the test ends, infinite where nothing says it. young: E of the
/// deck's card in Pa, which a curve of another unit's size is warned of against; 0: unknown. Throws
/// std::runtime_error naming the file and what is wrong: columns, units that contradict the factors, too few points, and values that cannot
/// be the material's, with the factor that would make them so.
TargetCurve load_target_curve(const TargetInput& target, const std::string& test, double last, double young = 0.0);

} // namespace proveta
