// Platens that close at a steady speed, at one that the test leads itself, or go back to unload.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "lab/controls/control.hpp"
#include "lab/controls/rate_control.hpp"

namespace proveta {

/// Share of a change that has been made: from 0 to 1 along half a cosine during `ramp` seconds: no jump in velocity or acceleration, so
/// that no stress wave starts.
double smooth_start(double time, double ramp);

/// A steady speed in m/s, reached smoothly during `ramp` seconds from whatever the press did before; at a constant pressure.
class SteadyClosing : public Control {
  public:
    SteadyClosing(double speed, double ramp, double pressure) : speed_(speed), ramp_(ramp), pressure_(pressure) {}

    void begin(const BenchView& bench, const Drive& last) override;
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    void visit_state(const std::string& prefix, StateVisitor& visit) override;

  private:
    double speed_, ramp_, pressure_;
    double begun_ = 0.0;
    double from_ = 0.0;
};

/// The speed that `RateControl` chooses, at a constant pressure. One object may lead several stages of a test, which then share what it has
/// learnt.
class LedClosing : public Control {
  public:
    LedClosing(const RateScale& scale, double pace, double pressure) : rate_(scale, pace), pressure_(pressure) {}

    void begin(const BenchView& bench, const Drive& last) override;
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    [[nodiscard]] bool looks(const BenchView& bench) const override;
    void stepped(const BenchView& bench, bool looked) override;
    void visit_state(const std::string& prefix, StateVisitor& visit) override;

  private:
    RateControl rate_;
    double pressure_;
    double origin_ = std::numeric_limits<double>::quiet_NaN(); // strain at which the loading began, once it has
};

/// Another control, slowed down where the stage comes to its end, so that the platens turn back there and not a ramp later.
class Braked : public Control {
  public:
    /// done: share of the stage that is done, as `Stage::done` has it.
    Braked(std::shared_ptr<Control> control, std::function<double(const BenchView&)> done)
        : control_(std::move(control)), done_(std::move(done)) {}

    void begin(const BenchView& bench, const Drive& last) override { control_->begin(bench, last); }
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    [[nodiscard]] bool looks(const BenchView& bench) const override { return control_->looks(bench); }
    void stepped(const BenchView& bench, bool looked) override { control_->stepped(bench, looked); }
    void visit_state(const std::string& prefix, StateVisitor& visit) override { control_->visit_state(prefix, visit); }

  private:
    std::shared_ptr<Control> control_;
    std::function<double(const BenchView&)> done_;
};

/// The platens go back, at a steady speed in m/s or, with 0, at a twentieth of the strain per crossing of a wave: nothing breaks on
/// unloading. pace: factor on the latter.
class Unloading : public Control {
  public:
    Unloading(double speed, double pace, double pressure) : speed_(speed), pace_(pace), pressure_(pressure) {}

    void begin(const BenchView& bench, const Drive& last) override;
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    void visit_state(const std::string& prefix, StateVisitor& visit) override;

  private:
    double speed_, pace_, pressure_;
    double begun_ = 0.0;
    double from_ = 0.0;
    double to_ = 0.0;
    double ramp_ = 0.0;
};

} // namespace proveta
