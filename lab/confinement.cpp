#include "lab/confinement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/input/units.hpp"
#include "lab/deck.hpp"
#include "lab/stages.hpp"

namespace proveta {

namespace {

constexpr double crossings = 60.0; // of a wave: the servo, which answers after one, stays within 1 %

} // namespace

void declare(input::Visitor& v, Confinement& c) {
    v.number("confining_pressure", c.pressure, input::Unit::pressure, {0.0, 1e10, false, false}, "pressure on the side; 0: none");
    v.number_or_word("pressure_ramp", c.ramp, {{"auto", "the time in which a wave crosses the specimen sixty times"}}, input::Unit::time,
                     input::above(0), "time in which the pressure is brought up");
    v.number("servo_speed_limit", c.speed_limit, input::Unit::velocity, {0.0, 100.0, true, false},
             "largest closing speed of the platens while they follow the pressure");
}

void check_sides(const Deck& deck, input::Problems& problems) {
    if (deck.specimen.file.empty() && deck.specimen.shape == "plate") {
        problems.push_back({deck.source, "/specimen/shape", "\"plate\"", "a solid with a side to press on: cylinder, disc or prism", ""});
    }
    if (deck.specimen.file.empty() && deck.specimen.spheres < 200) {
        problems.push_back({deck.source, "/specimen/spheres", std::to_string(deck.specimen.spheres),
                            "at least 200 spheres, so that the side has enough to be pressed on", "13,500 give a good curve"});
    }
}

void check_confinement(const Confinement& c, const Deck& deck, input::Problems& problems) {
    if (!c.ramp.word.empty() || c.pressure <= 0.0) {
        return;
    }
    const Card& card = deck.material.values;
    constexpr double longest = 1e6; // crossings of a wave
    const double crossing = deck.specimen.height / std::sqrt(card.young_modulus / card.density);
    if (deck.specimen.file.empty() && !deck.protocol->granular() && c.ramp.number > longest * crossing) {
        problems.push_back({deck.source, "/loading/pressure_ramp", input::format_quantity(c.ramp.number, input::Unit::time),
                            fmt::format("at most {}, a million crossings of a wave of some hundred steps each: no end is in sight of more",
                                        input::format_quantity(longest * crossing, input::Unit::time)),
                            "\"auto\" is as slow as need be"});
    }
    const double compliance = (1.0 - 2.0 * card.poisson_ratio) / card.young_modulus; // of a solid one
    const double speed =
        0.5 * std::numbers::pi * c.pressure / c.ramp.number * compliance * deck.specimen.height; // steepest point of the ramp
    if (speed > c.speed_limit) {
        problems.push_back(
            {deck.source, "/loading/pressure_ramp", input::format_quantity(c.ramp.number, input::Unit::time),
             fmt::format("a ramp that the platens can follow: {} in this time asks for {:.3g} m/s, beyond the limit of {:.3g} m/s",
                         input::format_quantity(c.pressure, input::Unit::pressure), speed, c.speed_limit),
             fmt::format("at least {}, or a higher servo_speed_limit, or \"auto\"",
                         input::format_quantity(c.ramp.number * speed / c.speed_limit, input::Unit::time))});
    }
}

std::vector<Stage> isotropic_stages(const Confinement& c, const BenchView& bench, double share, double pace) {
    if (c.pressure <= 0.0) {
        return {};
    }
    const double ramp = c.ramp.word.empty() ? c.ramp.number : crossings * bench.crossing();
    return {isotropic_stage(bench, c.pressure, ramp, c.speed_limit, share, pace),
            hold_stage(bench, c.pressure, c.speed_limit, 0.2 * share)};
}

} // namespace proveta
