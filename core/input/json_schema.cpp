#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/json.hpp"
#include "core/input/units.hpp"

namespace proveta::input {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (std::string("\\^$.|?*+()[]{}/").find(c) != std::string::npos) {
            out += '\\';
        }
        out += c;
    }
    return out;
}

// A number within bounds, or a text with a unit.
Json quantity(Unit unit, const Bounds& bounds) {
    Json number = {{"type", "number"}};
    if (std::isfinite(bounds.low)) {
        number[bounds.low_open ? "exclusiveMinimum" : "minimum"] = bounds.low;
    }
    if (std::isfinite(bounds.high)) {
        number[bounds.high_open ? "exclusiveMaximum" : "maximum"] = bounds.high;
    }
    std::vector<std::string> units;
    for (const auto& u : accepted_units(unit)) {
        units.push_back(escaped(u));
    }
    const Json text = {{"type", "string"},
                       {"pattern", fmt::format("^\\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\\s*({})?\\s*$", fmt::join(units, "|"))}};
    return {{"anyOf", Json::array({number, text})}};
}

std::string with_unit(const char* meaning, Unit unit) {
    return si_unit(unit).empty() ? meaning : fmt::format("{} [{}]", meaning, si_unit(unit));
}

} // namespace

Json SchemaWriter::new_object() { return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}}; }

void SchemaWriter::number(const char* key, double& value, Unit unit, const Bounds& bounds, const char* meaning) {
    Json j = {{"description", with_unit(meaning, unit)}, {"default", value}};
    j.update(quantity(unit, bounds));
    stack_.back()["properties"][key] = j;
}

void SchemaWriter::number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>& words, Unit unit, const Bounds& bounds,
                                  const char* meaning) {
    Json j = {{"description", with_unit(meaning, unit)}, {"default", value.word.empty() ? Json(value.number) : Json(value.word)}};
    j.update(quantity(unit, bounds));
    Json names = Json::array();
    for (const auto& w : words) {
        names.push_back(w.name);
    }
    j["anyOf"].push_back({{"enum", names}});
    stack_.back()["properties"][key] = j;
}

void SchemaWriter::integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high, const char* meaning) {
    stack_.back()["properties"][key] = {
        {"description", meaning}, {"default", value}, {"type", "integer"}, {"minimum", low}, {"maximum", high}};
}

void SchemaWriter::text(const char* key, std::string& value, const char* meaning) {
    stack_.back()["properties"][key] = {{"description", meaning}, {"default", value}, {"type", "string"}};
}

void SchemaWriter::choice(const char* key, std::string& value, const std::vector<Choice>& choices, const char* meaning) {
    Json names = Json::array();
    for (const auto& c : choices) {
        names.push_back(c.name);
    }
    stack_.back()["properties"][key] = {{"description", meaning}, {"default", value}, {"enum", names}};
}

void SchemaWriter::numbers(const char* key, std::vector<double>& values, std::size_t count, Unit unit, const Bounds& bounds,
                           const char* meaning) {
    stack_.back()["properties"][key] = {{"description", with_unit(meaning, unit)},
                                        {"default", values},
                                        {"type", "array"},
                                        {"items", quantity(unit, bounds)},
                                        {"minItems", std::max<std::size_t>(count, 1)}};
    if (count > 0) {
        stack_.back()["properties"][key]["maxItems"] = count;
    }
}

bool SchemaWriter::begin_section(const char* key, const char* meaning) {
    stack_.push_back(new_object());
    names_.emplace_back(key, meaning);
    return true;
}

void SchemaWriter::end_section() {
    Json done = std::move(stack_.back());
    stack_.pop_back();
    const auto [key, meaning] = names_.back();
    names_.pop_back();
    if (stack_.back()["type"] == "array") {
        stack_.back()["items"] = std::move(done);
        return;
    }
    done["description"] = meaning;
    stack_.back()["properties"][key] = std::move(done);
}

std::optional<std::size_t> SchemaWriter::begin_list(const char* key, std::size_t, const char* meaning) {
    stack_.push_back({{"type", "array"}, {"description", meaning}});
    names_.emplace_back(key, meaning);
    return 1;
}

void SchemaWriter::begin_item(std::size_t) {
    stack_.push_back(new_object());
    names_.emplace_back("", "");
}

void SchemaWriter::end_list() {
    Json done = std::move(stack_.back());
    stack_.pop_back();
    stack_.back()["properties"][names_.back().first] = std::move(done);
    names_.pop_back();
}

} // namespace proveta::input
