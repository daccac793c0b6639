// Keys, stages and stop rules that tests share.
#pragma once

#include <optional>
#include <string>

#include "core/input/declare.hpp"
#include "lab/controls/servo.hpp"
#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Ends of a test, whichever comes first.
struct StopRules {
    double axial_strain = 0.005; ///< nominal, from platen travel since the loading began, in the sense of the test
    double post_peak_drop = 0.6; ///< share of the peak deviatoric stress that has been lost
    input::NumberOrWord time{0.0, "never"};
    std::string parted = "go_on";
};

void declare(input::Visitor& v, StopRules& rules);

/// Why the test is over. The drop counts only once the peak stands out: a hundredth of the loading ago, and after bonds have
/// broken.
std::optional<std::string> stopped_by(const StopRules& rules, const BenchView& bench);

/// Why the stress has fallen far enough to stop; the drop alone.
std::optional<std::string> stopped_by_drop(double drop, const BenchView& bench);

/// Friction on a platen's face: a number, "lubricated" (0) or "glued" (no lateral slip).
void declare_friction(input::Visitor& v, input::NumberOrWord& friction);
double friction_value(const input::NumberOrWord& friction);

/// How fast platens close.
struct ClosingRate {
    input::NumberOrWord rate{0.0, "auto"}; ///< closing speed, m/s, each platen moving at half of it; "auto": led by `RateControl`
    input::NumberOrWord ramp{0.0, "auto"};
    std::string check = "off";

    [[nodiscard]] bool automatic() const { return !rate.word.empty(); }
};

/// Unloading and reloading at a point of the loading.
struct Cycle {
    input::NumberOrWord axial_strain{0.0, "none"}; ///< since the loading began
    input::NumberOrWord axial_stress{0.0, "none"}; ///< deviatoric part, in the sense of the test, Pa
    double unload_to = 0.1;                        ///< of the deviatoric stress there
};

void declare(input::Visitor& v, Cycle& cycle);

/// Keys of a "loading" section whose platens close, or part.
struct AxialLoading {
    ClosingRate rate;
    std::vector<Cycle> cycles;
    std::string control = "platens";
    input::NumberOrWord girth_rate{0.0, "auto"};
};

/// with_girth: the test may be led by the girth.
void declare_axial(input::Visitor& v, AxialLoading& loading, bool with_girth);

/// What the cycles contradict, and a rate at which the test would not end. limit, time: axial strain and stop.time that end the test.
void check_axial(const AxialLoading& loading, double limit, const input::NumberOrWord& time, const Deck& deck, input::Problems& problems);

/// What `axial_stages` needs besides the keys.
struct AxialTarget {
    double strain = 0.0;       ///< that ends the loading
    double first_damage = 0.0; ///< strain below which no bond fails, for "auto"
    double pressure = 0.0;     ///< on the side meanwhile, Pa
    double share = 1.0;        ///< of the test's samples
};

/// The loading with its cycles. pace: factor on all speeds.
std::vector<Stage> axial_stages(const AxialLoading& loading, const BenchView& bench, const AxialTarget& target, double pace);

/// Lowest strain at which a bond of the model may fail in tension when it is pulled alone; infinite when none can.
double lowest_tensile_strain(const Bonds& bonds);

/// What a servo of the platens' stress needs to know of the specimen.
StressServo::Settings servo_settings(const BenchView& bench, double speed_limit);

/// A stage under a stress that grows on all sides from zero to `pressure` along half a cosine during `ramp` seconds, the platens led by a
/// servo.
Stage isotropic_stage(const BenchView& bench, double pressure, double ramp, double speed_limit, double share, double pace);
/// The same stress held for some crossings of a wave.
Stage hold_stage(const BenchView& bench, double pressure, double speed_limit, double share);

/// Axial strain per pressure all round, and axial stress per axial strain, that a servo reckons with: those of an elastic body of the
/// material; of loose matter, what its wave speed tells.
struct ElasticGuess {
    double young, poisson;
};
ElasticGuess elastic_guess(const BenchView& bench);

} // namespace proveta
