// The half-rate check: is the peak still the same when everything goes half as fast?
#pragma once

#include <cstdint>
#include <optional>

#include "reports/record/record.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

struct Deck;
struct TestHooks;

/// What a test at half the rate said.
struct RateCheck {
    double peak = 0.0;       ///< at half the rate, Pa
    double difference = 0.0; ///< size of the peak's difference between rate and half rate, over the latter
    std::int64_t steps = 0;  ///< taken by the check
};

/// Runs the deck's test on the specimen again with all speeds halved until 15 % of the peak stress have been lost. curve: of the test
/// itself; hooks: of the second one, whose fields are not written. Empty when it was interrupted or failed.
std::optional<RateCheck> check_rate(const Deck& deck, const Specimen& specimen, const report::Table& curve, TestHooks hooks);

} // namespace proveta
