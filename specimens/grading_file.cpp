#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/input/column_heading.hpp"
#include "core/input/text_table.hpp"
#include "specimens/grading.hpp"

namespace proveta {

namespace {

using input::Json;
using input::Unit;

constexpr const char* wanted = "columns such as \"Sieve (mm)\" and \"Passing (%)\"";

// Numbers of a column; none may be missing.
std::vector<double> column(const input::TextTable& table, const input::WantedColumn& named, double& factor) {
    const auto found = input::match_column(table, named);
    if (!found) {
        throw std::runtime_error(fmt::format("{}: no column of {} among {}", table.file(), named.name, table.description()));
    }
    factor = table.columns()[found->index].unit.empty() ? 0.0 : found->factor;
    const auto& values = table.numbers(found->index);
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) {
            throw std::runtime_error(fmt::format("{}: line {}: the {} is missing", table.file(), table.line(k), named.name));
        }
    }
    return values;
}

Json points_of(const std::string& file) {
    const input::TextTable table(file);
    double metres = 0.0;
    double share = 0.0;
    const auto size = column(table,
                             {"sieve size",
                              {"sieve", "sieves", "sieve size", "sieve opening", "opening", "size", "diameter", "d", "grain size",
                               "particle size", "particle diameter"},
                              Unit::length,
                              1.0},
                             metres);
    const auto passing = column(table,
                                {"share passing",
                                 {"passing", "percent passing", "% passing", "cumulative passing", "mass passing", "finer", "percent finer",
                                  "% finer", "p", "undersize"},
                                 Unit::none,
                                 1.0},
                                share);
    if (metres == 0.0) {
        throw std::runtime_error(file + ": the sieve sizes have no unit; name it in their heading, as in \"Sieve (mm)\"");
    }
    if (share == 0.0) {
        const double most = *std::max_element(passing.begin(), passing.end());
        if (most != 1.0 && most != 100.0) {
            throw std::runtime_error(fmt::format("{}: {:.6g} passes the widest sieve: neither 1 nor 100 per cent, of which the unit "
                                                 "could be told; name it in the heading, as in \"Passing (%)\"",
                                                 file, most));
        }
        share = 1.0 / most;
    }
    std::vector<GradingPoint> points(size.size());
    for (std::size_t k = 0; k < size.size(); ++k) {
        points[k] = {size[k] * metres, passing[k] * share};
    }
    if (points.front().diameter > points.back().diameter) { // the widest sieve first, as sieves are stacked
        std::reverse(points.begin(), points.end());
    }
    while (points.size() > 1 && points[1].passing == 0.0) {
        points.erase(points.begin());
    }
    while (points.size() > 1 && points[points.size() - 2].passing == 1.0) {
        points.pop_back();
    }
    Json out = Json::array();
    for (auto& point : points) {
        out.push_back(input::write(point));
    }
    return out;
}

} // namespace

void read_grading_files(Json& json, const std::string& folder, const std::string& source, const std::string& path,
                        input::Problems& problems) {
    if (json.is_array()) {
        for (std::size_t k = 0; k < json.size(); ++k) {
            read_grading_files(json[k], folder, source, fmt::format("{}/{}", path, k), problems);
        }
    }
    if (!json.is_object()) {
        return;
    }
    for (auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        if (key != "grading" || !value.is_string()) {
            read_grading_files(value, folder, source, at, problems);
            continue;
        }
        const std::string name = value.get<std::string>();
        value = Json::array();
        try {
            value = points_of((std::filesystem::path(folder) / name).string());
        } catch (const std::exception& error) {
            problems.push_back({source, at, "\"" + name + "\"", fmt::format("a table with {}", wanted), error.what()});
        }
    }
}

void allow_grading_files(Json& schema) {
    if (!schema.is_structured()) {
        return;
    }
    for (auto& [key, value] : schema.items()) {
        if (key == "grading" && value.is_object() && value.value("type", "") == "array") {
            const Json list = value;
            value = {{"description", list.value("description", "") + "; or the name of a table"}, {"anyOf", {list, {{"type", "string"}}}}};
        } else {
            allow_grading_files(value);
        }
    }
}

} // namespace proveta
