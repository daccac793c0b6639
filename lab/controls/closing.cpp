#include "lab/controls/closing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/protocols/protocol.hpp"

namespace proveta {

double smooth_start(double time, double ramp) {
    return time >= ramp ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * std::max(time, 0.0) / ramp));
}

void SteadyClosing::begin(const BenchView& bench, const Drive& last) {
    begun_ = bench.model.time();
    from_ = last.closing;
}

Drive SteadyClosing::drive(const BenchView& bench) {
    return {from_ + (speed_ - from_) * smooth_start(bench.model.time() - begun_, ramp_), pressure_};
}

void SteadyClosing::visit_state(const std::string& prefix, StateVisitor& visit) {
    visit(prefix + "begun", begun_);
    visit(prefix + "from", from_);
}

void LedClosing::begin(const BenchView& bench, const Drive& last) {
    rate_.start(last.closing);
    if (std::isnan(origin_)) {
        origin_ = bench.strain();
    }
}

Drive LedClosing::drive(const BenchView&) { return {rate_.rate(), pressure_}; }

bool LedClosing::looks(const BenchView& bench) const { return rate_.looks_at(bench.model.steps()); }

void LedClosing::stepped(const BenchView& bench, bool looked) {
    if (looked) {
        const Ledger& l = bench.model.ledger();
        const double lower = bench.model.walls.platens[0].load();
        const double upper = bench.model.walls.platens[1].load();
        rate_.observe({bench.strain() - origin_, l.platens + l.pressure, l.damage, l.kinetic, l.elastic, l.plastic,
                       bench.model.measures().unbalanced_ratio,
                       std::fabs(lower - upper) / std::max(0.5 * std::fabs(lower + upper), 1e-300)});
    }
    rate_.advance(bench.model.dt());
}

void LedClosing::visit_state(const std::string& prefix, StateVisitor& visit) {
    rate_.visit([&](const char* name, double& value) { visit(prefix + name, value); });
    visit(prefix + "origin", origin_);
}

Drive Braked::drive(const BenchView& bench) {
    constexpr double crossings = 3.0; // in which a specimen that closes at the fastest rate comes to rest, without a wave
    constexpr double slowest = 0.01;  // of the strain, per crossing: about what the platens go on while they turn
    Drive drive = control_->drive(bench);
    const double done = done_(bench);
    if (done > 0.5) {
        drive.closing = std::min(drive.closing, std::max((1.0 - done) / crossings, slowest) * bench.strain() * bench.wave_speed);
    }
    return drive;
}

void Unloading::begin(const BenchView& bench, const Drive& last) {
    begun_ = bench.model.time();
    from_ = last.closing;
    to_ = speed_ > 0.0 ? -speed_ : -0.05 * pace_ * bench.strain() * bench.wave_speed;
    ramp_ = 5.0 * bench.crossing();
}

Drive Unloading::drive(const BenchView& bench) {
    return {from_ + (to_ - from_) * smooth_start(bench.model.time() - begun_, ramp_), pressure_};
}

void Unloading::visit_state(const std::string& prefix, StateVisitor& visit) {
    visit(prefix + "begun", begun_);
    visit(prefix + "from", from_);
    visit(prefix + "to", to_);
    visit(prefix + "ramp", ramp_);
}

} // namespace proveta
