// What leads the press through a stage of a test.
#pragma once

#include <cstdint>

#include "core/state.hpp"

namespace proveta {

struct BenchView;

/// What the press does in a step.
struct Drive {
    double closing = 0.0;  ///< speed at which the platens go on with the loading, m/s; negative: they go back
    double pressure = 0.0; ///< on the side, Pa
};

/// Leads a stage step by step. Everything is a function of the model's state and of the steps taken, so that the same test gives the same
/// drive.
class Control {
  public:
    virtual ~Control() = default;

    /// The stage begins; last: what the press did in the step before.
    virtual void begin(const BenchView& bench, const Drive& last) = 0;
    /// What the press does in the next step.
    [[nodiscard]] virtual Drive drive(const BenchView& bench) = 0;
    /// True when the next step is to be measured for `stepped`.
    [[nodiscard]] virtual bool looks(const BenchView&) const { return false; }
    /// A step was made. looked: it was one that `looks` asked for, and the model's measures and ledger are its own.
    virtual void stepped(const BenchView&, bool looked) { static_cast<void>(looked); }
    /// Names what the drive of later steps depends on, each name after `prefix`, so that a stage can be gone on with in its midst.
    virtual void visit_state(const std::string& prefix, StateVisitor& visit) = 0;
};

} // namespace proveta
