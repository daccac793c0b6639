// Controls and stop rules that tests share.
#pragma once

#include <optional>
#include <string>

#include "core/input/declare.hpp"
#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Speed over final speed, from 0 to 1 along half a cosine during `ramp` seconds: no jump in velocity or acceleration, so that no
/// stress wave starts.
double smooth_start(double time, double ramp);

/// Ends of a test, whichever comes first.
struct StopRules {
    double axial_strain = 0.005; ///< nominal, from platen travel
    double post_peak_drop = 0.6; ///< share of the peak stress that has been lost
};

void declare(input::Visitor& v, StopRules& rules);

/// Why the test is over, from the samples so far. The drop counts only once the peak stands out: at least five samples ago and after
/// bonds have broken.
std::optional<std::string> stopped_by(const StopRules& rules, const report::Table& curve);

/// Friction on a platen's face: a number, "lubricated" (0) or "glued" (no lateral slip).
void declare_friction(input::Visitor& v, input::NumberOrWord& friction);
double friction_value(const input::NumberOrWord& friction);

} // namespace proveta
