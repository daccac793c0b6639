#include "core/input/units.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/input/words.hpp"

namespace proveta::input {

namespace {

struct Named {
    const char* text;
    double factor;
};

const std::vector<Named>& table(Unit unit) {
    static const std::vector<Named> none{{"", 1.0}, {"%", 1e-2}};
    static const std::vector<Named> length{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}};
    static const std::vector<Named> area{{"m2", 1.0}, {"cm2", 1e-4}, {"mm2", 1e-6}};
    static const std::vector<Named> pressure{{"Pa", 1.0},
                                             {"kPa", 1e3},
                                             {"MPa", 1e6},
                                             {"GPa", 1e9},
                                             {"bar", 1e5},
                                             {"N/mm2", 1e6},
                                             {"kN/m2", 1e3},
                                             {"psi", 6894.757293168},
                                             {"ksi", 6894757.293168}};
    static const std::vector<Named> density{{"kg/m3", 1.0}, {"g/cm3", 1e3}, {"t/m3", 1e3}};
    static const std::vector<Named> velocity{{"m/s", 1.0}, {"mm/s", 1e-3}, {"um/s", 1e-6}, {"mm/min", 1e-3 / 60.0}};
    static const std::vector<Named> time{{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"min", 60.0}, {"h", 3600.0}};
    static const std::vector<Named> energy{{"J/m2", 1.0}, {"N/m", 1.0}, {"N/mm", 1e3}};
    static const std::vector<Named> acceleration{{"m/s2", 1.0}};
    static const std::vector<Named> angle{{"rad", 1.0}, {"deg", std::numbers::pi / 180.0}};
    static const std::vector<Named> angular_velocity{{"rad/s", 1.0}, {"deg/s", std::numbers::pi / 180.0}, {"rpm", std::numbers::pi / 30.0}};
    static const std::vector<Named> force{{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}};
    static const std::vector<Named> rate{{"1/s", 1.0}, {"1/min", 1.0 / 60.0}, {"1/h", 1.0 / 3600.0}};
    static const std::vector<Named> any = [] {
        std::vector<Named> all;
        for (const auto& of :
             {none, length, area, pressure, density, velocity, time, energy, acceleration, angle, angular_velocity, force, rate}) {
            all.insert(all.end(), of.begin(), of.end());
        }
        return all;
    }();
    switch (unit) {
    case Unit::length: return length;
    case Unit::area: return area;
    case Unit::pressure: return pressure;
    case Unit::density: return density;
    case Unit::velocity: return velocity;
    case Unit::time: return time;
    case Unit::energy_per_area: return energy;
    case Unit::acceleration: return acceleration;
    case Unit::angle: return angle;
    case Unit::angular_velocity: return angular_velocity;
    case Unit::force: return force;
    case Unit::rate: return rate;
    case Unit::any: return any;
    case Unit::none: break;
    }
    return none;
}

// As units are written here: without the marks of powers, micro as u.
std::string plain_unit(std::string_view name) {
    std::string out(name);
    for (const auto& [from, to] : {std::pair{"²", "2"}, {"³", "3"}, {"^", ""}, {"µ", "u"}, {"μ", "u"}}) {
        for (auto at = out.find(from); at != std::string::npos; at = out.find(from)) {
            out.replace(at, std::string_view(from).size(), to);
        }
    }
    return out;
}

// What may be meant by a unit that is none.
std::string meant(std::string_view number, std::string_view name, const std::vector<Named>& units) {
    if (name.size() > 1 && name.front() == ',' && std::isdigit(static_cast<unsigned char>(name[1])) != 0) {
        return fmt::format("; decimals have a point: \"{}.{}\"", number, name.substr(1));
    }
    for (const auto& n : units) {
        if (!name.empty() && lower_case(name) == lower_case(n.text)) {
            return fmt::format("; did you mean \"{} {}\"?", number, n.text);
        }
    }
    return "";
}

} // namespace

std::optional<Unit> dimension_of(const std::string& si) {
    for (const Unit u : {Unit::none, Unit::length, Unit::area, Unit::pressure, Unit::density, Unit::velocity, Unit::time,
                         Unit::energy_per_area, Unit::acceleration, Unit::angle, Unit::angular_velocity, Unit::force, Unit::rate}) {
        if (si_unit(u) == si) {
            return u;
        }
    }
    return std::nullopt;
}

std::string si_unit(Unit unit) { return table(unit).front().text; }

std::vector<std::string> accepted_units(Unit unit) {
    std::vector<std::string> out;
    for (const auto& n : table(unit)) {
        if (*n.text != '\0') {
            out.emplace_back(n.text);
        }
    }
    return out;
}

Quantity parse_quantity(const std::string& text, Unit unit) {
    const std::string_view t = trimmed(text);
    double value = 0.0;
    const char* begin = t.data() + (t.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, t.data() + t.size(), value);
    if (error != std::errc() || !std::isfinite(value)) {
        return {0.0, "no finite number in it"};
    }
    const std::string name = plain_unit(trimmed({end, t.data() + t.size()}));
    for (const auto& n : table(unit)) {
        if (name == n.text || (name.empty() && n.factor == 1.0)) {
            return {value * n.factor, ""};
        }
    }
    const auto units = accepted_units(unit);
    if (unit == Unit::any) {
        return {0.0, fmt::format("the unit \"{}\" is unknown{}", name, meant({t.data(), end}, name, table(unit)))};
    }
    return {0.0, fmt::format("the unit \"{}\" is none of {}{}", name, fmt::join(units, ", "), meant({t.data(), end}, name, table(unit)))};
}

std::string format_quantity(double value, Unit unit) {
    if (unit == Unit::none || unit == Unit::any || value == 0.0 || !std::isfinite(value)) {
        return fmt::format("{:.6g}{}{}", value, si_unit(unit).empty() ? "" : " ", si_unit(unit));
    }
    // The largest unit of a power of ten that leaves a number of at least 1.
    const Named* best = &table(unit).front();
    for (const auto& n : table(unit)) {
        const bool metric = unit != Unit::pressure || std::string(n.text).find('/') == std::string::npos;
        const double here = std::fabs(value / n.factor);
        const double there = std::fabs(value / best->factor);
        const bool sixty = std::fabs(std::log10(n.factor) - std::round(std::log10(n.factor))) > 1e-9;
        if (metric && !sixty && n.factor != 1e5 && ((here >= 1.0 && (here < there || there < 1.0)) || (there < 1.0 && here > there))) {
            best = &n;
        }
    }
    return fmt::format("{:.6g} {}", value / best->factor, best->text);
}

std::string format_number(double value) { return fmt::format("{}", value); }

std::string Bounds::text() const {
    if (std::isinf(low) && std::isinf(high)) {
        return "any number";
    }
    if (std::isinf(high)) {
        return fmt::format("{} {:.6g}", low_open ? "above" : "at least", low);
    }
    if (std::isinf(low)) {
        return fmt::format("{} {:.6g}", high_open ? "below" : "at most", high);
    }
    return fmt::format("{} {:.6g} {} {:.6g}", low_open ? "above" : "from", low, high_open ? "and below" : "to", high);
}

} // namespace proveta::input
