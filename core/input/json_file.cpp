#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/input/json.hpp"
#include "core/input/text_file.hpp"

namespace proveta::input {

std::string Problem::text() const {
    std::string out = source;
    if (!path.empty()) {
        out += (out.empty() ? "" : ": ") + path;
    }
    out += expected.empty() ? ": " + found : fmt::format(": found {}; expected {}", found, expected);
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

namespace {

// Looks at a text while it is parsed: how deep it goes, how many keys objects have, and which of them twice, of which the parser would take
// the last without a word.
class ParseGuard {
  public:
    explicit ParseGuard(std::string source) : source_(std::move(source)) {}

    void look(Json::parse_event_t event, const Json& parsed) {
        using Event = Json::parse_event_t;
        switch (event) {
        case Event::object_start:
        case Event::array_start:
            count();
            if (around_.size() >= 64) {
                fail("more than 64 nested levels", "a flat JSON object");
            }
            around_.push_back({event == Event::array_start, 0, "", {}});
            break;
        case Event::object_end:
        case Event::array_end: around_.pop_back(); break;
        case Event::value: count(); break;
        case Event::key: key(parsed.get<std::string>()); break;
        }
    }
    void end() const {
        if (!twice_.empty()) {
            throw InputError(twice_);
        }
    }

  private:
    // An object or a list that is being read.
    struct Around {
        bool list;
        std::size_t entries;
        std::string key; // the last
        std::set<std::string> keys;
    };

    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw InputError({{source_, "", found, expected, ""}});
    }
    // Of the last key; no longer than can be shown.
    [[nodiscard]] std::string path() const {
        std::string out;
        for (const auto& a : around_) {
            out += "/" + (a.list ? std::to_string(a.entries - 1) : a.key.substr(0, 100));
        }
        return out;
    }
    void count() {
        if (!around_.empty() && around_.back().list) {
            ++around_.back().entries;
        }
    }
    void key(const std::string& name) {
        Around& object = around_.back();
        object.key = name;
        if (!object.keys.insert(name).second) {
            twice_.push_back(
                {source_, path(), "the key a second time", "each key of an object once", "the last would count and the others not"});
            if (twice_.size() >= 50) { // enough to see what is wrong
                end();
            }
        }
        if (object.keys.size() > 10000) { // looked up one by one: very many would take for ever
            fail("an object of more than 10000 keys", "a JSON file of a few kilobytes");
        }
    }

    std::string source_;
    std::vector<Around> around_;
    Problems twice_;
};

} // namespace

Json parse_json(const std::string& text, const std::string& source) {
    ParseGuard guard(source);
    Json json;
    try {
        json = Json::parse(text, [&](int, Json::parse_event_t event, Json& parsed) {
            guard.look(event, parsed);
            return true;
        });
    } catch (const Json::exception& e) {
        std::string what = e.what();
        if (const auto at = what.find("] "); at != std::string::npos) {
            what = what.substr(at + 2);
        }
        std::replace_if(
            what.begin(), what.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
        throw InputError({{source, "", "text that is not JSON: " + what, "valid JSON",
                           text.find("NaN") != std::string::npos ? "JSON has no NaN; leave the key out to get its default" : ""}});
    }
    guard.end();
    return json;
}

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
    Json json = parse_json(text, file);
    if (!json.is_object()) {
        fail(std::string("a JSON ") + json.type_name(), "a JSON object");
    }
    return json;
}

std::string text_at(const Json& json, const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

} // namespace proveta::input
