// Targets of a calibration: what is wrong with them is said before anything runs.
#pragma once

#include <string>
#include <vector>

#include "lab/calibrate/input.hpp"

namespace proveta {

/// Appends what is wrong with the keys of a target. at: its JSON pointer; tests: their names as the file has them.
void check_target(const TargetInput& target, const std::string& at, const std::vector<std::string>& tests, const std::string& file,
                  input::Problems& problems);

/// Appends what is wrong with a target's result and value: a result that the test cannot have, or a value of another unit, size or sign
/// than it can have. written: the target as its file has it.
void check_result(const TargetInput& target, const input::Json& written, const std::string& at, const std::vector<TrialTest>& tests,
                  const std::string& file, input::Problems& problems);

} // namespace proveta
