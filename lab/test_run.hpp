// The test itself: stages, samples, stop rules; no files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/bench.hpp"
#include "lab/failure_event.hpp"
#include "lab/instruments.hpp"
#include "lab/rate_check.hpp"
#include "lab/snapshot.hpp"
#include "reports/record/record.hpp"
#include "specimens/checkpoint.hpp"

namespace proveta {

/// What a test left behind, apart from the model.
struct TestData {
    report::Table curve;
    report::Table energy;
    std::vector<FailureEvent> events;
    std::vector<report::Picture> pictures; ///< before, at peak, 20 % past it, at the end
    std::vector<Snapshot> moments;         ///< the same moments, to be drawn
    std::vector<std::string> stages;       ///< names of those that were begun
    std::string stopped_by;
    std::optional<RateCheck> rate_check; ///< empty: none was made
    std::string failure;                 ///< non-empty: the calculation failed, and how
    bool interrupted = false;
    double seconds = 0.0; ///< that the loading took, by the clock on the wall
};

/// How a test is run other than as its deck says.
struct TestVariant {
    double pace = 1.0;       ///< factor on all speeds
    double until_drop = 1.0; ///< also ends when this share of the peak stress has been lost; 1: never
};

/// Hooks of whoever watches the test.
struct TestHooks {
    std::function<void(const TestData&, double done)> progress; ///< at every sample and now and then; done 0 to 1
    std::function<void()> fields;                               ///< the fields are to be written
    std::function<bool()> interrupted;                          ///< whether to stop, looked at as often as `progress` is called
    /// A moment to keep the state at, now and then; `must`: a stage begins, or the test was interrupted. May be empty.
    std::function<void(const VisitState& state, bool must)> keep = nullptr;
    /// Restores a state that was kept: the test, its bench newly set up, goes on from there. Empty: it begins.
    std::function<void(const VisitState& state)> restore = nullptr;
};

/// Runs the protocol on the bench, as it was set up, until it stops. A test that was kept, ended and restored ends the same to the bit.
TestData run_protocol(const Deck& deck, Bench& bench, const TestHooks& hooks, const TestVariant& variant = {});

} // namespace proveta
