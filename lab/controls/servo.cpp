#include "lab/controls/servo.hpp"

#include <algorithm>
#include <cmath>

#include "lab/protocols/protocol.hpp"

namespace proveta {

namespace {

// Gains per crossing of a wave. The specimen integrates the speed and answers after half a crossing: with a proportional gain of 0.4 the
// loop keeps a phase margin of some 75 degrees, the integral, a tenth of it per crossing, costs 15 of them.
constexpr double proportional = 0.4;
constexpr double integral = 0.04;
constexpr double clock_memory = 2.0; // crossings over which the speed is averaged that the clock goes by

constexpr double slowest_clock = 0.01; // of the true one: what gives way for good is not waited for
constexpr double slow = 0.01;          // of the strain, per crossing
constexpr double girth_gain = 0.3;
constexpr double girth_lag = 0.5; // crossings over which the speed follows what the loop asks for

} // namespace

void StressServo::begin(const BenchView&, const Drive&) {
    clock_ = 0.0;
    speed_ = 0.0;
    integral_ = 0.0;
}

Drive StressServo::drive(const BenchView& bench) {
    const double dt = bench.model.dt();
    const double crossing = bench.crossing();
    const double pace = settings_.calm_speed > 0.0 ? std::clamp(settings_.calm_speed / std::max(speed_, 1e-300), slowest_clock, 1.0) : 1.0;
    const double p = pressure_(clock_);
    const double expected = settings_.compliance * (pressure_(clock_ + pace * dt) - p) / dt; // strain per s
    const double error = p - bench.stress();
    const double asked = expected + (proportional * error + integral * integral_ / crossing) / (settings_.stiffness * crossing);
    const double most = settings_.speed_limit / bench.press.length;
    const double given = std::clamp(asked, -most, most);
    if (given == asked || error * asked < 0.0) {
        integral_ += error * dt;
    }
    clock_ += pace * dt;
    const double speed = given * bench.press.length;
    speed_ += (speed - speed_) * std::min(1.0, dt / (clock_memory * crossing));
    return {speed, p};
}

void GirthServo::begin(const BenchView& bench, const Drive& last) {
    begun_ = bench.model.time();
    from_ = -bench.girth_strain();
    speed_ = last.closing;
    limit_ = std::min(std::fabs(last.closing), slow * bench.strain() * bench.wave_speed);
    limit_ = std::max(limit_, least_ * bench.wave_speed);
    if (rate_ <= 0.0) {
        rate_ = lateral_ * limit_ / bench.press.length;
    }
    limit_ = std::max(limit_, rate_ * bench.press.length / lateral_);
    speed_ = std::min(speed_, limit_);
}

Drive GirthServo::drive(const BenchView& bench) {
    const double crossing = bench.crossing();
    const double most = limit_ * lateral_ / bench.press.length * crossing / girth_gain; // that the limit answers to: the aim waits there
    double behind = from_ + rate_ * (bench.model.time() - begun_) + bench.girth_strain();
    from_ -= std::max(0.0, behind - most);
    behind = std::min(behind, most);
    const double asked = (rate_ + girth_gain * behind / crossing) * bench.press.length / lateral_;
    const double given = std::clamp(asked, -limit_, limit_);
    speed_ += (given - speed_) * std::min(1.0, bench.model.dt() / (girth_lag * crossing));
    return {speed_, pressure_};
}

void StressServo::visit_state(const std::string& prefix, StateVisitor& visit) {
    visit(prefix + "clock", clock_);
    visit(prefix + "speed", speed_);
    visit(prefix + "integral", integral_);
}

void GirthServo::visit_state(const std::string& prefix, StateVisitor& visit) {
    visit(prefix + "rate", rate_);
    visit(prefix + "begun", begun_);
    visit(prefix + "from", from_);
    visit(prefix + "limit", limit_);
    visit(prefix + "speed", speed_);
}

} // namespace proveta
