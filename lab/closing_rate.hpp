// How fast platens close: a steady rate, or one that the test itself leads.
#pragma once

#include "core/input/declare.hpp"
#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Keys of a "loading" section that say how fast.
struct ClosingRate {
    input::NumberOrWord rate{0.0, "auto"}; ///< closing speed, m/s, each platen moving at half of it; "auto": led by `RateControl`
    input::NumberOrWord ramp{0.0, "auto"};
    std::string check = "off";

    [[nodiscard]] bool automatic() const { return !rate.word.empty(); }
};

void declare_rate(input::Visitor& v, ClosingRate& rate);

/// Lowest strain at which a bond of the model may fail in tension when it is pulled alone; infinite when none can.
double lowest_tensile_strain(const Bonds& bonds);

/// A stage that closes two platens, the first upwards, the second downwards. first_damage: axial strain below which no bond fails, for
/// "auto"; pace: factor on all speeds.
Stage closing_stage(const ClosingRate& rate, const BenchView& bench, double first_damage, double pace);

} // namespace proveta
