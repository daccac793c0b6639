#include "lab/rate_control.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace proveta {

namespace {

double env(const char* n, double d) {
    const char* v = std::getenv(n);
    return v ? std::atof(v) : d;
}
const double eta_fast = env("RC_FAST", 0.15);        // kinetic over elastic energy 0.2 %
const double eta_slow = env("RC_SLOW", 0.015);       //
const double first_speed = env("RC_SEED", 0.1);      // of the strain at first damage, per crossing
const double damage_low = env("RC_D1", 0.001);       // damage ratio at which the speed begins to fall
const double damage_high = env("RC_D2", 0.015);      // and at which it is lowest
const double memory = env("RC_MEM", 0.08);           // of the work so far, over which the damage ratio is taken
const double most_kinetic = env("RC_KIN", 0.005);    // half of what the verdict allows
const double most_unbalanced = env("RC_UNB", 0.005); //
const double lowest = env("RC_LOW", 0.5);            // of eta_slow: limits may not bring the test to a halt
const double most_gain = env("RC_GAIN", 0.1);        // du per crossing over the strain: stress differences of 1.2 %

} // namespace

std::int64_t steps_between_looks(double height, double wave_speed, double dt) {
    return std::clamp<std::int64_t>(std::llround(0.25 * height / (wave_speed * dt)), 10, 100);
}

RateControl::RateControl(const RateScale& scale, double pace) : scale_(scale), pace_(pace), aim_(first_speed * scale.first_damage * pace) {}

void RateControl::observe(const RateReading& r) {
    strain_ = std::max(strain_, r.strain);
    const double more_work = std::max(r.work - work_, 0.0);
    const double keep = r.work > 0.0 ? std::exp(-more_work / (memory * r.work)) : 1.0;
    recent_work_ = keep * recent_work_ + more_work;
    recent_damage_ = keep * recent_damage_ + std::max(r.damage - damage_, 0.0);
    work_ = r.work;
    damage_ = r.damage;

    const double ratio = damage_ratio();
    const double along = ratio > 0.0 ? std::clamp(std::log(ratio / damage_low) / std::log(damage_high / damage_low), 0.0, 1.0) : 0.0;
    double share = std::pow(eta_slow / eta_fast, along);
    if (strain_ > 0.5 * scale_.first_damage) { // at the start nothing is stored yet, and nothing can break
        const auto limit = [&](double found, double allowed) { return found > allowed ? allowed / found : 1.0; };
        share *= std::sqrt(limit(r.kinetic, most_kinetic * r.elastic)) * limit(r.unbalanced, most_unbalanced);
    }
    share = std::max(share, lowest * eta_slow / eta_fast);
    aim_ = pace_ * share * std::max(eta_fast * strain_, first_speed * scale_.first_damage);
}

void RateControl::advance(double dt) {
    const double crossings = dt * scale_.wave_speed / scale_.height;
    const double most = most_gain * pace_ * std::max(strain_, 0.25 * scale_.first_damage);
    const double wanted = std::clamp(aim_ - speed_, -most, most);
    gain_ += (wanted - gain_) * std::min(1.0, 2.0 * crossings); // the lag: half a crossing
    speed_ = std::max(0.0, speed_ + gain_ * crossings);
}

} // namespace proveta
