// What the tests of a campaign say of themselves.
#pragma once

#include <vector>

#include "core/input/json.hpp"
#include "lab/trials/book.hpp"

namespace proveta {

/// For each test by name, over all trials and specimens: "good", whether all were loaded quasi-statically; "verdict", in words, that of the
/// first that was not; "tests" that are complete, and how many of them are "good_tests" and "rate_checked"; "largest_rate_difference" of a
/// peak from that at half the rate, null where none was checked.
input::Json verdicts_of(const std::vector<TrialResult>& trials);

} // namespace proveta
