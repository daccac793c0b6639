// What a series keeps of a test that has been run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/series/plan.hpp"
#include "lab/test_plots.hpp"

namespace proveta {

struct MemberResult {
    const Member* member = nullptr;
    std::string status = "not run"; ///< or complete, interrupted, failed
    std::string stopped_by;
    std::vector<report::Scalar> results;
    std::vector<report::Badge> badges;
    std::vector<std::string> warnings;
    bool unwritten = false;                   ///< it failed because its files could not be written
    std::vector<input::Problem> refused = {}; ///< it failed because of these: its checkpoints, say
    std::optional<MainCurve> curve;
    double seconds = 0.0; ///< wall time of the loading

    [[nodiscard]] bool complete() const { return status == "complete"; }

    /// A result by name; none when the test has no such result or could not find it.
    [[nodiscard]] std::optional<double> value(const std::string& name) const {
        for (const auto& scalar : results) {
            if (scalar.name == name) {
                return scalar.value;
            }
        }
        return std::nullopt;
    }
};

} // namespace proveta
