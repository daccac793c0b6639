#include "lab/controls/rate_control.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

constexpr double eta_fast = 0.15;        // kinetic over elastic energy 0.2 %
constexpr double eta_slow = 0.015;       // the error of the peak is about as large
constexpr double first_speed = 0.1;      // strain per crossing at the start, over the strain at first damage
constexpr double damage_low = 0.001;     // damage ratio at which the speed begins to fall
constexpr double damage_high = 0.015;    // and at which it is lowest; up to the peak it stays at 0.02 to 0.03
constexpr double damage_memory = 0.08;   // of the work so far, over which the damage ratio is taken
constexpr double aim_kinetic = 0.005;    // half of what the verdict allows, over the elastic energy
constexpr double aim_unbalanced = 0.005; // the same
constexpr double aim_imbalance = 0.01;   // the same, of the platens' forces
constexpr double lowest = 0.5;           // of eta_slow: failure itself may not bring the test to a halt
constexpr double most_gain = 0.1;        // of the strain per crossing: stress differences of 1.2 %

} // namespace

std::int64_t steps_between_looks(double height, double wave_speed, double dt) {
    return std::clamp<std::int64_t>(std::llround(0.25 * height / (wave_speed * dt)), 10, 100);
}

RateControl::RateControl(const RateScale& scale, double pace) : scale_(scale), pace_(pace), aim_(first_speed * scale.first_damage * pace) {}

void RateControl::observe(const RateReading& r) {
    strain_ = std::max(strain_, r.strain);
    const double more_work = std::max(r.work - work_, 0.0);
    const double keep = r.work > 0.0 ? std::exp(-more_work / (damage_memory * r.work)) : 1.0;
    recent_work_ = keep * recent_work_ + more_work;
    recent_damage_ = keep * recent_damage_ + std::max(r.damage - damage_, 0.0);
    work_ = r.work;
    damage_ = r.damage;

    const double ratio = damage_ratio();
    const double along = ratio > 0.0 ? std::clamp(std::log(ratio / damage_low) / std::log(damage_high / damage_low), 0.0, 1.0) : 0.0;
    double share = std::pow(eta_slow / eta_fast, along);
    // Where damage rules, strain goes on growing and stress hardly: the speed does not grow with it.
    if (along < 0.5) {
        slow_from_ = 0.0;
    } else if (along >= 1.0 && slow_from_ == 0.0) {
        slow_from_ = strain_;
    }
    const double stored = r.plastic > 0.0 ? r.elastic / (r.elastic + r.plastic) : 1.0;
    const double base = slow_from_ > 0.0 ? slow_from_ : stored * strain_;
    if (strain_ > 0.5 * scale_.first_damage) { // at the start nothing is stored yet, and nothing can break
        const auto limit = [&](double found, double allowed) { return found > allowed ? allowed / found : 1.0; };
        share *=
            std::sqrt(limit(r.kinetic, aim_kinetic * r.elastic)) * limit(r.unbalanced, aim_unbalanced) * limit(r.imbalance, aim_imbalance);
    }
    share = std::max(share, lowest * eta_slow / eta_fast);
    aim_ = pace_ * share * std::max(eta_fast * base, first_speed * scale_.first_damage);
}

void RateControl::advance(double dt) {
    const double crossings = dt * scale_.wave_speed / scale_.height;
    const double most = most_gain * pace_ * std::max(strain_, 0.25 * scale_.first_damage);
    const double wanted = std::clamp(aim_ - speed_, -most, most);
    gain_ += (wanted - gain_) * std::min(1.0, 2.0 * crossings); // the lag: half a crossing
    speed_ = std::max(std::min(speed_, 0.0), speed_ + gain_ * crossings);
}

} // namespace proveta
