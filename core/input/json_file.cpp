#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/input/json.hpp"
#include "core/input/text_file.hpp"

namespace proveta::input {

std::string Problem::text() const {
    std::string out = source;
    if (!path.empty()) {
        out += (out.empty() ? "" : ": ") + path;
    }
    out += fmt::format(": found {}; expected {}", found, expected);
    if (!suggestion.empty()) {
        out += "; " + suggestion;
    }
    return out;
}

namespace {

std::string all_problems(const Problems& list) {
    std::string out;
    for (const auto& p : list) {
        out += (out.empty() ? "" : "\n") + p.text();
    }
    return out;
}

} // namespace

InputError::InputError(Problems list) : std::runtime_error(all_problems(list)), problems(std::move(list)) {}

Json load_json(const std::string& file) {
    namespace fs = std::filesystem;
    constexpr std::uintmax_t largest = 16u << 20;
    std::error_code error;
    auto fail = [&](const std::string& found, const std::string& expected, const std::string& hint = "") {
        throw InputError({{file, "", found, expected, hint}});
    };
    if (!fs::exists(file, error)) {
        fail("no such file", "a JSON file");
    }
    std::string text;
    try {
        text = read_text(file, largest);
    } catch (const std::runtime_error& e) {
        fail(std::string(e.what()).substr(file.size() + 2), "a JSON file of a few kilobytes");
    }
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
        fail("an empty file", "a JSON object", "the smallest complete deck is { \"test\": \"ucs\" }");
    }
    std::vector<std::size_t> keys; // of the objects around, outermost first
    auto guard = [&](int level, Json::parse_event_t event, Json&) {
        if (level > 64) {
            fail("more than 64 nested levels", "a flat JSON object");
        }
        if (event == Json::parse_event_t::key) { // looked up one by one: very many would take for ever
            keys.resize(static_cast<std::size_t>(level), 0);
            if (++keys.back() > 10000) {
                fail("an object of more than 10000 keys", "a JSON file of a few kilobytes");
            }
        } else if (event == Json::parse_event_t::object_start) {
            keys.resize(static_cast<std::size_t>(level));
            keys.push_back(0);
        }
        return true;
    };
    Json json;
    try {
        json = Json::parse(text, guard);
    } catch (const Json::exception& e) {
        std::string what = e.what();
        if (const auto at = what.find("] "); at != std::string::npos) {
            what = what.substr(at + 2);
        }
        std::replace_if(
            what.begin(), what.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
        fail("text that is not JSON: " + what, "valid JSON",
             text.find("NaN") != std::string::npos ? "JSON has no NaN; leave the key out to get its default" : "");
    }
    if (!json.is_object()) {
        fail(std::string("a JSON ") + json.type_name(), "a JSON object");
    }
    return json;
}

std::string text_at(const Json& json, const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

} // namespace proveta::input
