#include "lab/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/input/units.hpp"
#include "lab/controls/closing.hpp"
#include "lab/controls/servo.hpp"
#include "lab/deck.hpp"
#include "lab/derived.hpp"
#include "lab/fragments.hpp"

namespace proveta {

using input::Unit;

namespace {

constexpr double longest_test = 1e6; // crossings of a wave: a thousand times what an automatic rate takes

} // namespace

void declare(input::Visitor& v, StopRules& r) {
    v.number("axial_strain", r.axial_strain, Unit::none, {0.0, 0.5, true, false},
             "nominal axial strain, since the loading began, at which the test ends");
    v.number("post_peak_drop", r.post_peak_drop, Unit::none, {0.0, 1.0, true, false},
             "share of the peak deviatoric stress whose loss ends the test; 1: never");
    v.number_or_word("time", r.time, {{"never", "however long it takes"}}, Unit::time, {0.0, 1e6, true, false},
                     "time of the test, as a clock in the laboratory would show it, at which it ends");
    v.choice("parted", r.parted,
             {{"go_on", "a parted specimen is loaded on"}, {"stop", "ends when no piece reaches from platen to platen"}},
             "all bonds of some section have failed");
}

namespace {

// No piece that holds together by bonds touches both loading platens.
bool parted(const Model& model) {
    const auto piece = fragments(model);
    std::vector<std::uint8_t> touches(model.spheres.size(), 0);
    for (std::size_t p = 0; p < 2; ++p) {
        for (const auto s : model.walls.platens[p].sphere) {
            touches[static_cast<std::size_t>(piece[static_cast<std::size_t>(s)])] |= static_cast<std::uint8_t>(1u << p);
        }
    }
    return std::find(touches.begin(), touches.end(), 3) == touches.end();
}

} // namespace

std::optional<std::string> stopped_by_drop(double drop, const BenchView& bench) {
    const LoadingTrack& t = bench.track;
    const bool stands_out = t.looks - t.look_at_peak > std::max(8.0, 0.01 * t.looks) && bench.model.broken() > 0;
    if (drop < 1.0 && stands_out && t.deviator < (1.0 - drop) * t.peak) {
        return fmt::format("stress fell by {:.0f} % from its peak", 100.0 * drop);
    }
    return std::nullopt;
}

std::optional<std::string> stopped_by(const StopRules& rules, const BenchView& bench) {
    if (bench.track.looks == 0.0) {
        return std::nullopt;
    }
    if (bench.track.strain >= rules.axial_strain * (1.0 - 1e-9)) {
        return fmt::format("axial strain of {:.4g} reached", rules.axial_strain);
    }
    if (rules.time.word.empty() && bench.model.time() >= rules.time.number) {
        return fmt::format("time of {:.4g} s reached", rules.time.number);
    }
    constexpr double looks_a_parting = 32.0; // it takes a walk through all bonds
    if (rules.parted == "stop" && std::fmod(bench.track.looks, looks_a_parting) == 0.0 && bench.model.broken() > 0 && parted(bench.model)) {
        return "the specimen has parted";
    }
    return stopped_by_drop(rules.post_peak_drop, bench);
}

void declare_friction(input::Visitor& v, input::NumberOrWord& friction) {
    v.number_or_word("platen_friction", friction, {{"lubricated", "no friction"}, {"glued", "no lateral slip"}}, Unit::none,
                     input::between(0, 10), "Coulomb friction between specimen and platens");
}

double friction_value(const input::NumberOrWord& friction) {
    if (friction.word == "glued") {
        return glued;
    }
    return friction.word == "lubricated" ? 0.0 : friction.number;
}

void declare(input::Visitor& v, Cycle& c) {
    v.number_or_word("axial_strain", c.axial_strain, {{"none", "by stress"}}, Unit::none, {0.0, 0.5, true, false},
                     "axial strain since the loading began at which the platens turn back");
    v.number_or_word("axial_stress", c.axial_stress, {{"none", "by strain"}}, Unit::pressure, input::above(0),
                     "deviatoric stress at which the platens turn back");
    v.number("unload_to", c.unload_to, Unit::none, {0.0, 1.0, false, true}, "share of the deviatoric stress there to which they unload");
}

void declare_axial(input::Visitor& v, AxialLoading& l, bool with_girth) {
    v.number_or_word("rate", l.rate.rate, {{"auto", "fast while the specimen is elastic, slow where bonds break"}}, Unit::velocity,
                     {0.0, 10.0, true, false}, "speed at which the platens approach or part, each moving at half of it");
    v.number_or_word("ramp", l.rate.ramp, {{"auto", "the time in which a wave crosses the specimen twenty times"}}, Unit::time,
                     input::at_least(0), "time in which the platens reach their speed, unless \"rate\" is \"auto\"");
    v.choice("rate_check", l.rate.check,
             {{"off", "the verdict says that the rate was not checked"},
              {"half_rate", "the test is run again to just past its peak with all speeds halved, which takes twice as many steps to there, "
                            "and the verdict compares the peaks"}},
             "confirmation that the rate does not matter");
    v.list("cycles", l.cycles, "unloading and reloading, in the order in which the loading meets them");
    if (with_girth) {
        v.choice(
            "control", l.control,
            {{"platens", "the closing of the platens leads the whole test"},
             {"girth", "from the first failed bonds on, the circumferential gauge does: the platens give way when cracks open too fast"}},
            "what leads the test");
        v.number_or_word("girth_rate", l.girth_rate,
                         {{"auto", "that of an elastic specimen closing by a hundredth of its strain while a wave crosses it"}}, Unit::none,
                         {0.0, 1e4, true, false}, "growth of the circumferential strain under \"control\": \"girth\", 1/s");
    }
}

void check_axial(const AxialLoading& l, double limit, const input::NumberOrWord& time, const Deck& deck, input::Problems& problems) {
    const std::string& source = deck.source;
    const Card& card = deck.material.values;
    const double crossings = limit * std::sqrt(card.young_modulus / card.density) / l.rate.rate.number;
    if (!l.rate.automatic() && !time.word.empty() && !deck.protocol->granular() && crossings > longest_test) {
        problems.push_back(
            {source, "/loading/rate", input::format_quantity(l.rate.rate.number, Unit::velocity),
             fmt::format("at least {:.2g} m/s: slower, a strain of {:.3g} takes more than {:.0g} crossings of a wave, of some "
                         "hundred steps each, and no end is in sight",
                         l.rate.rate.number * crossings / longest_test, limit, longest_test),
             "\"auto\" is as slow as need be; or less strain in stop.axial_strain, or a time in stop.time"});
    }
    double last = 0.0;
    for (std::size_t k = 0; k < l.cycles.size(); ++k) {
        const Cycle& c = l.cycles[k];
        const std::string path = fmt::format("/loading/cycles/{}", k);
        const bool by_strain = c.axial_strain.word.empty();
        if (by_strain == c.axial_stress.word.empty()) {
            problems.push_back({source, path, by_strain ? "both axial_strain and axial_stress" : "neither axial_strain nor axial_stress",
                                "one of them", ""});
        } else if (by_strain) {
            if (c.axial_strain.number <= last) {
                problems.push_back({source, path + "/axial_strain", fmt::format("{:.4g}", c.axial_strain.number),
                                    fmt::format("more than {:.4g}, the strain of the cycle before", last),
                                    "list cycles in ascending order"});
            } else if (c.axial_strain.number >= limit) {
                problems.push_back({source, path + "/axial_strain", fmt::format("{:.4g}", c.axial_strain.number),
                                    fmt::format("less than {:.4g}, at which the test ends", limit), "raise stop.axial_strain"});
            }
            last = c.axial_strain.number;
        }
    }
}

namespace {

// Where a loading stands, known to all its stages.
struct Path {
    double origin = std::numeric_limits<double>::quiet_NaN(); // strain at which the loading began, once it has
    double turned_strain = 0.0;                               // at the last turn back
    double turned_stress = 0.0;                               // deviatoric stress there, Pa
};

// Bonds that fail at next to no strain have no strength worth any care, and at speeds of the scale of that strain a test would never end.
// It goes on steadily, in so many crossings of a wave: inertia makes some hundredths of a megapascal of it.
bool weak(const AxialTarget& t) { return t.first_damage < 2e-5; } // that of concrete is some 1e-4
constexpr double weak_crossings = 4000.0;

std::shared_ptr<Control> closing_control(const AxialLoading& l, const BenchView& bench, const AxialTarget& t, double pace) {
    if (l.rate.automatic()) {
        const double length = bench.press.length;
        if (weak(t)) {
            return std::make_shared<SteadyClosing>(pace * t.strain / weak_crossings * bench.wave_speed, 20.0 * bench.crossing(),
                                                   t.pressure);
        }
        const RateScale scale{length, bench.wave_speed, t.first_damage, steps_between_looks(length, bench.wave_speed, bench.model.dt())};
        return std::make_shared<LedClosing>(scale, pace, t.pressure);
    }
    const double ramp = (l.rate.ramp.word == "auto" ? 20.0 * bench.crossing() : l.rate.ramp.number) / pace;
    return std::make_shared<SteadyClosing>(pace * l.rate.rate.number, ramp, t.pressure);
}

} // namespace

std::vector<Stage> axial_stages(const AxialLoading& l, const BenchView& bench, const AxialTarget& target, double pace) {
    const auto path = std::make_shared<Path>();
    const auto strain = [path](const BenchView& b) {
        if (std::isnan(path->origin)) {
            path->origin = b.strain();
        }
        return b.strain() - path->origin;
    };
    const auto deviator = [p = target.pressure](const BenchView& b) { return b.stress() - p; };
    const auto control = closing_control(l, bench, target, pace);
    constexpr double cycle_share = 0.08; // of the loading's samples
    const double unloading = l.rate.automatic() ? 0.0 : pace * l.rate.rate.number;

    std::vector<Stage> stages;
    for (std::size_t k = 0; k < l.cycles.size(); ++k) {
        const Cycle c = l.cycles[k];
        const bool by_strain = c.axial_strain.word.empty();
        const auto done = [=](const BenchView& b) {
            path->turned_strain = strain(b);
            path->turned_stress = deviator(b);
            return by_strain ? path->turned_strain / c.axial_strain.number : path->turned_stress / c.axial_stress.number;
        };
        stages.push_back({"loading", Stage::Kind::loading, target.share * (by_strain ? c.axial_strain.number / target.strain : 0.3),
                          std::make_shared<Braked>(control, done), done});
        stages.push_back({fmt::format("unloading {}", k + 1), Stage::Kind::cycling, target.share * cycle_share,
                          std::make_shared<Unloading>(unloading, pace, target.pressure), [=](const BenchView& b) {
                              const double fall = (1.0 - c.unload_to) * path->turned_stress;
                              return fall > 0.0 ? (path->turned_stress - deviator(b)) / fall : 1.0; // else there is nothing to unload
                          }});
        stages.push_back({fmt::format("reloading {}", k + 1), Stage::Kind::cycling, target.share * cycle_share, control,
                          [=](const BenchView& b) { return strain(b) / path->turned_strain; }});
    }
    const auto to_end = [=](const BenchView& b) { return strain(b) / target.strain; };
    if (l.control == "girth") {
        stages.push_back({"loading", Stage::Kind::loading, 0.3 * target.share, control, [=](const BenchView& b) {
                              const double failed =
                                  static_cast<double>(b.model.broken()) / (0.001 * static_cast<double>(b.model.bonds.size()));
                              return std::max(failed, to_end(b));
                          }});
        const double rate = l.girth_rate.word.empty() ? pace * l.girth_rate.number : 0.0;
        stages.push_back({"loading by girth", Stage::Kind::loading, target.share,
                          std::make_shared<GirthServo>(rate, 2.0 * elastic_guess(bench).poisson, target.pressure,
                                                       weak(target) ? target.strain / weak_crossings : 0.0),
                          [=](const BenchView& b) { return std::max(to_end(b), -b.girth_strain() / target.strain); }});
    } else {
        stages.push_back({"loading", Stage::Kind::loading, target.share, control, to_end});
    }
    stages.back().memory = [path](const std::string& prefix, StateVisitor& visit) {
        visit(prefix + "origin", path->origin);
        visit(prefix + "turned_strain", path->turned_strain);
        visit(prefix + "turned_stress", path->turned_stress);
    };
    return stages;
}

double lowest_tensile_strain(const Bonds& bonds) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& block : bonds.blocks) {
        const double strength = bonds.groups[block.group].tensile_limit();
        for (auto b = block.begin; b < block.end; ++b) {
            lowest = std::min(lowest, strength * bonds.area[b] / (bonds.stiffness[b] * bonds.length[b]));
        }
    }
    return lowest;
}

ElasticGuess elastic_guess(const BenchView& bench) {
    const Model& model = bench.model;
    if (model.bonds.size() == 0) {
        double mass = 0.0;
        for (std::size_t k = 0; k < model.clusters.alone(model.spheres); ++k) {
            mass += model.spheres.mass[k];
        }
        for (const double m : model.clusters.mass) {
            mass += m;
        }
        return {mass / bench.shape.volume() * bench.wave_speed * bench.wave_speed, 0.2};
    }
    // The affine bound of an isotropic network whose bond areas fill space; k = k_t / k_n.
    const Material& m = model.materials.front();
    const double k = m.shear_ratio();
    return {m.normal_factor * m.young_modulus * (2.0 + 3.0 * k) / (4.0 + k), std::max((1.0 - k) / (4.0 + k), 0.0)};
}

StressServo::Settings servo_settings(const BenchView& bench, double speed_limit) {
    const ElasticGuess e = elastic_guess(bench);
    return {(1.0 - 2.0 * e.poisson) / e.young, e.young, speed_limit};
}

Stage isotropic_stage(const BenchView& bench, double pressure, double ramp, double speed_limit, double share, double pace) {
    const double duration = ramp / pace;
    const auto p = [=](double time) { return pressure * smooth_start(time, duration); };
    auto settings = servo_settings(bench, speed_limit);
    settings.calm_speed = 1.6 * pressure / duration * settings.compliance * bench.press.length; // the steepest of an elastic specimen
    const auto control = std::make_shared<StressServo>(p, settings);
    return {"isotropic", Stage::Kind::preparing, share, control, [=](const BenchView&) { return control->clock() / duration; }};
}

Stage hold_stage(const BenchView& bench, double pressure, double speed_limit, double share) {
    const double duration = 10.0 * bench.crossing();
    const auto control = std::make_shared<StressServo>([=](double) { return pressure; }, servo_settings(bench, speed_limit));
    return {"hold", Stage::Kind::preparing, share, control, [=](const BenchView&) { return control->clock() / duration; }};
}

} // namespace proveta
