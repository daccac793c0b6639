#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "specimens/memory.hpp"
#include "specimens/sphere_file.hpp"

namespace proveta {

namespace {

using input::MatchedColumn;
using input::Unit;
using input::WantedColumn;

constexpr std::size_t most_named = 8; // lines with a fault
constexpr const char* ways = "say what the columns are: --columns x,y,z,r (d: diameter, -: not used)";

struct SphereColumns {
    std::optional<MatchedColumn> x, y, z, r, d, group;
};

SphereColumns by_headings(const input::TextTable& table) {
    const auto find = [&](const char* name, std::vector<std::string> names, Unit unit) {
        return input::match_column(table, {name, std::move(names), unit, 1.0});
    };
    const auto along = [](const std::string& c) {
        return std::vector<std::string>{c,          c + "c",         "c" + c,      c + " c",     "centre " + c,     "center " + c,
                                        "pos " + c, "position " + c, c + " coord", "coord " + c, c + " coordinate", "x0:" + c};
    };
    return {find("x", along("x"), Unit::length),
            find("y", along("y"), Unit::length),
            find("z", along("z"), Unit::length),
            find("radius", {"r", "rad", "radius", "radii", "sphere radius", "ball radius"}, Unit::length),
            find("diameter", {"d", "dia", "diam", "diameter", "sphere diameter", "ball diameter"}, Unit::length),
            find("cohesive group", {"group", "cohesive group", "grp"}, Unit::none)};
}

SphereColumns by_list(const input::TextTable& table, const std::string& list) {
    SphereColumns out;
    std::istringstream words(list);
    std::string word;
    std::size_t at = 0;
    for (; std::getline(words, word, ','); ++at) {
        std::optional<MatchedColumn>* slot = word == "x"       ? &out.x
                                             : word == "y"     ? &out.y
                                             : word == "z"     ? &out.z
                                             : word == "r"     ? &out.r
                                             : word == "d"     ? &out.d
                                             : word == "group" ? &out.group
                                                               : nullptr;
        if (slot == nullptr && word != "-") {
            throw std::runtime_error("--columns: \"" + word + "\" is none of x, y, z, r, d, group and -");
        }
        if (slot != nullptr && *slot) {
            throw std::runtime_error("--columns: \"" + word + "\" is there twice");
        }
        if (at >= table.columns().size()) {
            throw std::runtime_error(
                fmt::format("{}: --columns names more columns than the {} that there are", table.file(), table.columns().size()));
        }
        if (slot != nullptr) {
            const auto& unit = table.columns()[at].unit;
            *slot = MatchedColumn{at, input::unit_factor(unit, word == "group" ? Unit::none : Unit::length).value_or(1.0), ""};
        }
    }
    return out;
}

// Where nothing says what the columns are: x, y, z, r. Radius first, or diameters, look the same but for what a packing can be.
SphereColumns by_order(const input::TextTable& table) {
    const std::size_t width = table.columns().size();
    if (width < 4 || width > 5) {
        throw std::runtime_error(fmt::format("{}: {} columns without headings where x y z r, and perhaps a group, are expected{}; {}",
                                             table.file(), width, table.passed_over().empty() ? "" : "; " + table.passed_over(), ways));
    }
    const auto& first = table.numbers(0);
    const auto counts = [&] {
        for (std::size_t k = 0; k < first.size(); ++k) {
            if (first[k] != first[0] + static_cast<double>(k)) {
                return false;
            }
        }
        return first.size() > 2 && first[0] == std::floor(first[0]);
    };
    if (counts()) {
        throw std::runtime_error(
            fmt::format("{}: no headings, and the first column counts the rows: is it a number? {}", table.file(), ways));
    }
    const auto positive = [&](std::size_t c) {
        const auto& values = table.numbers(c);
        return std::all_of(values.begin(), values.end(), [](double v) { return v > 0.0; });
    };
    // A radius varies less than a place does, which goes from one end of the specimen to the other.
    const auto spread = [&](std::size_t c) {
        const auto& values = table.numbers(c);
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return *high - *low;
    };
    if (positive(0) && spread(0) < std::min({spread(1), spread(2), spread(3)})) {
        throw std::runtime_error(
            fmt::format("{}: no headings, and the first column looks more like the radius than the fourth; {}", table.file(), ways));
    }
    SphereColumns out{MatchedColumn{0, 1.0, ""}, MatchedColumn{1, 1.0, ""}, MatchedColumn{2, 1.0, ""}, MatchedColumn{3, 1.0, ""}, {}, {}};
    if (width == 5) {
        out.group = MatchedColumn{4, 1.0, "read column 5 as cohesive group"};
    }
    return out;
}

} // namespace

ReadSpheres read_sphere_table(const std::string& file, const std::string& columns) {
    require_file(file);
    const input::TextTable table(file, largest_file);
    ReadSpheres out;
    const SphereColumns found = !columns.empty() ? by_list(table, columns) : table.has_headings() ? by_headings(table) : by_order(table);
    for (const auto& [name, place] : {std::pair{"x", &found.x}, {"y", &found.y}, {"z", &found.z}}) {
        if (!*place) {
            throw std::runtime_error(fmt::format("{}: no column is {}; it has {}; {}", file, name, table.description(), ways));
        }
    }
    if (found.r.has_value() == found.d.has_value()) {
        throw std::runtime_error(fmt::format("{}: {}; it has {}; {}", file,
                                             found.r ? "a radius and a diameter" : "no column is the radius or the diameter",
                                             table.description(), ways));
    }
    const MatchedColumn& size = found.r ? *found.r : *found.d;
    const double half = found.r ? 1.0 : 0.5;

    // A unit in one heading holds for the rest; two that differ are each as they say.
    std::vector<bool> used(table.columns().size(), false);
    double factor = 0.0;
    std::string unit;
    const std::vector<const std::optional<MatchedColumn>*> lengths{&found.x, &found.y, &found.z, found.r ? &found.r : &found.d};
    for (const auto* c : lengths) {
        used[(*c)->index] = true;
        if (const std::string& own = table.columns()[(*c)->index].unit; !own.empty()) {
            out.in_metres = true;
            factor = (*c)->factor;
            unit = own;
        }
    }
    for (const auto* c : lengths) {
        const auto& column = table.columns()[(*c)->index];
        if (!(*c)->said.empty()) {
            out.notes.push_back((*c)->said);
        }
        if (out.in_metres && column.unit.empty()) {
            out.notes.push_back(fmt::format("'{}' says no unit and is taken in {} as the others are", column.heading, unit));
        }
    }
    if (found.group) {
        used[found.group->index] = true;
        if (!found.group->said.empty()) {
            out.notes.push_back(found.group->said);
        }
    }
    const auto values = [&](const MatchedColumn& c) {
        auto numbers = table.values(c.index);
        const double by = out.in_metres && table.columns()[c.index].unit.empty() ? factor : c.factor;
        for (double& v : numbers) {
            v *= by;
        }
        return numbers;
    };
    for (std::size_t c = 0; c < used.size(); ++c) {
        if (!used[c] && !table.columns()[c].heading.empty()) {
            out.warnings.push_back(fmt::format("column \"{}\" is not used", table.columns()[c].heading));
        } else if (!used[c]) {
            out.warnings.push_back(fmt::format("column {} is not used", c + 1));
        }
    }
    const auto x = values(*found.x);
    const auto y = values(*found.y);
    const auto z = values(*found.z);
    const auto r = values(size);
    const auto group = found.group ? values(*found.group) : std::vector<double>(table.rows(), 0.0);
    out.spheres.reserve(table.rows());
    const auto fault = [&](std::size_t k) {
        for (const auto& [value, column] :
             {std::pair{x[k], found.x->index}, {y[k], found.y->index}, {z[k], found.z->index}, {r[k], size.index}}) {
            if (!std::isfinite(value)) {
                return table.is_text(k, column) ? fmt::format("\"{}\" is no number", table.cell(k, column).substr(0, 40))
                                                : std::string("a place or a size is missing");
            }
        }
        return r[k] <= 0.0 ? fmt::format("{} {:.6g} is not positive", found.r ? "radius" : "diameter", r[k])
                           : fmt::format("\"{}\" is no number of a group; {}", table.cell(k, found.group->index), ways);
    };
    std::vector<std::string> wrong;
    for (std::size_t k = 0; k < table.rows(); ++k) {
        const bool whole = group[k] == std::floor(group[k]) && std::fabs(group[k]) <= std::numeric_limits<int>::max();
        if (std::isfinite(x[k] + y[k] + z[k]) && r[k] > 0.0 && std::isfinite(r[k]) && whole) {
            out.spheres.push_back({{x[k], y[k], z[k]}, half * r[k], static_cast<int>(group[k]), static_cast<long long>(table.line(k))});
            continue;
        }
        wrong.push_back(fmt::format("line {}: {}", table.line(k), fault(k)));
        if (wrong.size() == most_named) {
            wrong.emplace_back("...");
            break;
        }
    }
    if (!wrong.empty()) {
        throw std::runtime_error(fmt::format("{}: {}", file, fmt::join(wrong, "; ")));
    }
    return out;
}

} // namespace proveta
