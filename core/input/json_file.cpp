#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/input/json.hpp"

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
    if (fs::is_directory(file, error)) {
        fail("a folder", "a JSON file");
    }
    if (fs::is_regular_file(file, error) && fs::file_size(file, error) > largest) {
        fail("a file of more than 16 MiB", "a JSON file of a few kilobytes");
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        fail("a file that cannot be read", "a readable JSON file");
    }
    std::string text;
    char buffer[65536];
    while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
        text.append(buffer, static_cast<std::size_t>(in.gcount()));
        if (text.size() > largest) {
            fail("more than 16 MiB", "a JSON file of a few kilobytes");
        }
    }
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
        fail("an empty file", "a JSON object", "the smallest complete deck is { \"test\": \"ucs\" }");
    }
    int depth = 0;
    auto guard = [&](int level, Json::parse_event_t, Json&) {
        depth = std::max(depth, level);
        if (depth > 64) {
            fail("more than 64 nested levels", "a flat JSON object");
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

} // namespace proveta::input
