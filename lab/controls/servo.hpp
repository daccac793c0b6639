// Platens that follow a stress, and platens that follow the girth.
#pragma once

#include <functional>

#include "lab/controls/control.hpp"

namespace proveta {

/// Closed loop on the axial stress: the side is under the pressure p(t) and the platens move so that the mean of their stresses is p(t)
/// too. The speed is what an elastic specimen would ask for, plus a proportional and an integral part of the error; both are scaled by
/// the time that a wave takes to cross the specimen, within which no loop can know what it did. The speed is limited, and at the limit
/// the integral waits (no wind-up). Where the specimen yields and the platens would have to run, the clock of p slows down instead.
class StressServo : public Control {
  public:
    struct Settings {
        double compliance = 0.0;  ///< axial strain per pressure all round, 1/Pa
        double stiffness = 0.0;   ///< axial stress per axial strain, Pa
        double speed_limit = 0.0; ///< m/s
        double calm_speed = 0.0;  ///< closing speed beyond which the clock slows, m/s; 0: never
    };

    /// pressure: p in Pa over the clock's time since the stage began, s.
    StressServo(std::function<double(double time)> pressure, const Settings& settings)
        : pressure_(std::move(pressure)), settings_(settings) {}

    void begin(const BenchView& bench, const Drive& last) override;
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    void visit_state(const std::string& prefix, StateVisitor& visit) override;

    [[nodiscard]] double clock() const { return clock_; } ///< s

  private:
    std::function<double(double)> pressure_;
    Settings settings_;
    double clock_ = 0.0;
    double speed_ = 0.0;    // mean closing over the last crossings, m/s
    double integral_ = 0.0; // of the error, Pa s
};

/// Closed loop on the girth: the platens move, back if need be, so that the circumferential gauge grows at a steady rate. This is what
/// keeps a brittle specimen from running away past its peak, where no steady closing is stable.
class GirthServo : public Control {
  public:
    /// rate: growth of the girth, strain per s; 0: as fast as the platens may then close. lateral: circumferential over axial strain that
    /// the loop reckons with; pressure on the side, Pa. The platens close no faster than when the loop took over, nor than a hundredth of
    /// the strain then per crossing of a wave, so that they can still turn back while a crack runs;
    /// least: of that limit, strain per crossing.
    GirthServo(double rate, double lateral, double pressure, double least)
        : rate_(rate), lateral_(lateral), pressure_(pressure), least_(least) {}

    void begin(const BenchView& bench, const Drive& last) override;
    [[nodiscard]] Drive drive(const BenchView& bench) override;
    void visit_state(const std::string& prefix, StateVisitor& visit) override;

  private:
    double rate_, lateral_, pressure_, least_;
    double begun_ = 0.0;
    double from_ = 0.0;  // girth then
    double limit_ = 0.0; // of the closing speed, m/s
    double speed_ = 0.0; // m/s
};

} // namespace proveta
