// A pressure on the side and how the specimen is brought under it.
#pragma once

#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Keys of a "loading" section with a pressure on the side.
struct Confinement {
    double pressure = 4.5e6; ///< Pa
    input::NumberOrWord ramp{0.0, "auto"};
    double speed_limit = 1.0; ///< of the platens on their servo, m/s
};

void declare(input::Visitor& v, Confinement& confinement);

/// What cannot be confined: plates.
void check_sides(const Deck& deck, input::Problems& problems);

/// Refuses a ramp that the platens cannot follow: one that asks an elastic specimen for a closing beyond the speed limit.
void check_confinement(const Confinement& confinement, const Deck& deck, input::Problems& problems);

/// All round to the pressure and a pause; nothing without a pressure. share: of the test's samples.
std::vector<Stage> isotropic_stages(const Confinement& confinement, const BenchView& bench, double share, double pace);

} // namespace proveta
