#include "lab/rate_check.hpp"

#include <algorithm>
#include <cmath>

#include "lab/derived.hpp"
#include "lab/test_run.hpp"

namespace proveta {

std::optional<RateCheck> check_rate(const Deck& deck, const Specimen& specimen, const report::Table& curve, TestHooks hooks) {
    Bench bench = set_up(deck, specimen);
    hooks.fields = [] {};
    const TestData slow = run_protocol(deck, bench, hooks, {.pace = 0.5, .until_drop = 0.15});
    const auto stress = loading_of(slow.curve, bench.press.sense).deviator;
    const auto full = loading_of(curve, bench.press.sense).deviator;
    if (slow.interrupted || !slow.failure.empty() || stress.empty() || full.empty()) {
        return std::nullopt;
    }
    RateCheck out;
    out.peak = *std::max_element(stress.begin(), stress.end());
    out.difference = std::fabs(*std::max_element(full.begin(), full.end()) / out.peak - 1.0);
    out.steps = bench.model->steps();
    return out;
}

} // namespace proveta
