// An axis with round ticks.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace proveta::report {

struct Axis {
    double low, high, tick;

    Axis(double from, double to) : low(from), high(to), tick(1.0) {
        if (!(high > low)) {
            high = low + 1.0;
        }
        const double raw = (high - low) / 6.0;
        const double power = std::pow(10.0, std::floor(std::log10(raw)));
        const double lead = raw / power;
        tick = power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
        low = std::floor(low / tick + 1e-9) * tick;
        high = std::ceil(high / tick - 1e-9) * tick;
    }
    /// 0 at the low end, 1 at the high one.
    [[nodiscard]] double at(double v) const { return (v - low) / (high - low); }
    /// What stands at the tick v.
    [[nodiscard]] std::string label(double v) const { return fmt::format("{:.6g}", std::fabs(v) < 1e-9 * tick ? 0.0 : v); }
};

} // namespace proveta::report
