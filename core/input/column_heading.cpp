#include "core/input/column_heading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/input/units.hpp"
#include "core/input/words.hpp"

namespace proveta::input {

namespace {

constexpr std::array dimensions{Unit::length,          Unit::area,  Unit::pressure, Unit::density, Unit::velocity, Unit::time,
                                Unit::energy_per_area, Unit::force, Unit::angle,    Unit::rate,    Unit::none,     Unit::angular_velocity,
                                Unit::acceleration};

// Underscores stand for blanks in headings.
std::string bare(std::string_view text) { return std::string(trimmed(text, " \t_")); }

void replace_all(std::string& s, const std::string& from, const std::string& to) {
    for (auto at = s.find(from); at != std::string::npos; at = s.find(from, at + to.size())) {
        s.replace(at, from.size(), to);
    }
}

// Ways of writing that decks do not know.
std::string plain_unit(std::string unit) {
    for (const auto& [from, to] : {std::pair{"²", "2"}, {"³", "3"}, {"µ", "u"}, {"μ", "u"}, {"^", ""}, {"·", ""}, {" ", ""}}) {
        replace_all(unit, from, to);
    }
    return unit;
}

bool is_unit(const std::string& unit) {
    return std::any_of(dimensions.begin(), dimensions.end(), [&](Unit d) { return unit_factor(unit, d).has_value(); });
}

} // namespace

std::optional<double> unit_factor(const std::string& unit, Unit dimension) {
    const std::string u = plain_unit(unit);
    if (u.empty()) {
        return std::nullopt;
    }
    if (dimension == Unit::none) {
        static const std::array<std::pair<const char*, double>, 17> ratios{{{"-", 1.0},
                                                                            {"1", 1.0},
                                                                            {"%", 1e-2},
                                                                            {"percent", 1e-2},
                                                                            {"per cent", 1e-2},
                                                                            {"pct", 1e-2},
                                                                            {"‰", 1e-3},
                                                                            {"permil", 1e-3},
                                                                            {"mm/m", 1e-3},
                                                                            {"mm/mm", 1.0},
                                                                            {"m/m", 1.0},
                                                                            {"microstrain", 1e-6},
                                                                            {"ustrain", 1e-6},
                                                                            {"ue", 1e-6},
                                                                            {"uε", 1e-6},
                                                                            {"um/m", 1e-6},
                                                                            {"millistrain", 1e-3}}};
        const auto at = std::find_if(ratios.begin(), ratios.end(), [&](const auto& r) { return u == r.first; });
        return at == ratios.end() ? std::nullopt : std::optional(at->second);
    }
    std::string of = u;
    if (dimension == Unit::pressure) {
        static const std::array<std::pair<const char*, const char*>, 5> same{
            {{"MN/m2", "MPa"}, {"N/m2", "Pa"}, {"kpa", "kPa"}, {"mpa", "MPa"}, {"Mpa", "MPa"}}};
        for (const auto& [from, to] : same) {
            of = of == from ? to : of;
        }
        if (of == "psi") {
            return 6894.757293168; // pound-force per square inch, NIST SP 811
        }
        if (of == "ksi") {
            return 6894757.293168;
        }
    }
    if (dimension == Unit::time && of == "sec") {
        of = "s";
    }
    const auto q = parse_quantity("1 " + of, dimension);
    return q.problem.empty() ? std::optional(q.value) : std::nullopt;
}

std::string unit_in_brackets(const std::string& cell) {
    std::string unit = bare(cell);
    if (unit.size() > 1 && ((unit.front() == '[' && unit.back() == ']') || (unit.front() == '(' && unit.back() == ')'))) {
        unit = bare(unit.substr(1, unit.size() - 2));
    }
    return is_unit(unit) ? unit : "";
}

bool is_row_of_units(const std::vector<std::string_view>& cells) {
    bool any = false;
    for (const auto cell : cells) {
        const std::string text = bare(cell);
        if (text.empty() || text == "[]") {
            continue;
        }
        if (unit_in_brackets(text).empty()) {
            return false;
        }
        any = true;
    }
    return any;
}

TextColumn column_of_heading(const std::string& heading) {
    TextColumn out{heading, bare(heading), ""};
    const auto split_at = [&](std::size_t name_end, std::size_t unit_begin, std::size_t unit_end) {
        const std::string unit = bare(heading.substr(unit_begin, unit_end - unit_begin));
        const std::string name = bare(heading.substr(0, name_end));
        if (name.empty() || !is_unit(unit)) {
            return false;
        }
        out.name = name;
        out.unit = unit;
        return true;
    };
    for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}, {'{', '}'}}) {
        const auto a = heading.rfind(open);
        const auto b = heading.rfind(close);
        if (a != std::string::npos && b != std::string::npos && a < b && split_at(a, a + 1, b)) {
            return out;
        }
    }
    for (const std::string mark : {" in ", "/", ",", ";", "_", " "}) {
        // From the left, so that "force / kN/m" has the longest unit that is one.
        for (auto at = heading.find(mark); at != std::string::npos; at = heading.find(mark, at + 1)) {
            const std::string unit = bare(heading.substr(at + mark.size()));
            // What counts columns ("strain 1") is no unit without brackets.
            if (unit != "-" && unit != "1" && split_at(at, at + mark.size(), heading.size())) {
                return out;
            }
        }
    }
    return out;
}

std::string plain_name(const std::string& name) {
    std::string out;
    for (const char c : lower_case(bare(name))) {
        const bool gap = c == ' ' || c == '_' || c == '-' || c == '.' || c == '\t';
        if (!gap) {
            out += c;
        } else if (!out.empty() && out.back() != ' ') {
            out += ' ';
        }
    }
    return bare(out);
}

std::optional<MatchedColumn> match_column(const TextTable& table, const WantedColumn& wanted) {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
        if (std::find(wanted.names.begin(), wanted.names.end(), plain_name(table.columns()[c].name)) != wanted.names.end()) {
            found.push_back(c);
        }
    }
    if (found.empty()) {
        return std::nullopt;
    }
    const TextColumn& column = table.columns()[found.front()];
    if (found.size() > 1) {
        throw std::runtime_error(fmt::format("{}: \"{}\" and \"{}\" (columns {} and {}) may both be the {}", table.file(), column.heading,
                                             table.columns()[found[1]].heading, found[0] + 1, found[1] + 1, wanted.name));
    }
    MatchedColumn out{found.front(), wanted.factor, ""};
    if (!column.unit.empty()) {
        const auto factor = unit_factor(column.unit, wanted.unit);
        if (!factor) {
            throw std::runtime_error(
                fmt::format("{}: \"{}\" has the unit {}, which is none of the {}", table.file(), column.heading, column.unit, wanted.name));
        }
        out.factor = *factor;
    }
    out.said = fmt::format("read '{}' as {}{}", column.heading, wanted.name, column.unit.empty() ? "" : ", in " + column.unit);
    return out;
}

} // namespace proveta::input
