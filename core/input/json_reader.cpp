#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/json.hpp"
#include "core/input/suggest.hpp"
#include "core/input/units.hpp"

namespace proveta::input {

namespace {

// A JSON value as a short text for messages.
std::string shown(const Json& j) {
    std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) {
        text = text.substr(0, 57) + "...";
    }
    return fmt::format("{} {}", j.type_name(), text);
}

std::string names(const std::vector<Choice>& choices) {
    std::vector<std::string> out;
    for (const auto& c : choices) {
        out.push_back('"' + c.name + '"');
    }
    return fmt::format("{}", fmt::join(out, ", "));
}

std::string nearest_choice(const std::string& word, const std::vector<Choice>& choices) {
    std::vector<std::string> out;
    for (const auto& c : choices) {
        out.push_back(c.name);
    }
    const std::string best = nearest(word, out);
    return best.empty() ? "" : fmt::format("did you mean \"{}\"?", best);
}

// A JSON pointer as the reference writes it: "/surfaces/0/motion" as "surfaces.N.motion".
std::string dotted(const std::string& pointer) {
    std::string out;
    for (std::size_t at = 1; at <= pointer.size();) {
        const auto end = std::min(pointer.find('/', at), pointer.size());
        const auto part = pointer.substr(at, end - at);
        const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
        out += (out.empty() ? "" : ".") + (number ? std::string("N") : part);
        at = end + 1;
    }
    return out;
}

std::string expected_quantity(Unit unit, const Bounds& bounds) {
    const auto units = accepted_units(unit);
    const std::string si = si_unit(unit);
    const std::string example = unit == Unit::none  ? ""
                                : unit == Unit::any ? " (in SI units, or a text with its unit, such as \"30 MPa\")"
                                                    : fmt::format(" (a number in {}, or a text with one of {})",
                                                                  si.empty() ? "SI units" : si, fmt::join(units, ", "));
    const std::string range = bounds.text();
    return (range == "any number" ? range : "a number " + range) + (si.empty() ? "" : " " + si) + example;
}

} // namespace

JsonReader::JsonReader(const Json& json, std::string source, std::string path, Problems& problems)
    : source_(std::move(source)), problems_(problems) {
    frames_.push_back({&json, std::move(path), {}});
    if (!json.is_object()) {
        complain(frames_.back().path, shown(json), "an object");
        frames_.back().json = nullptr;
    }
}

void JsonReader::complain(const std::string& path, const std::string& found, const std::string& expected, const std::string& suggestion) {
    problems_.push_back({source_, path, found, expected, suggestion});
}

const Json* JsonReader::find(const char* key) {
    Frame& frame = frames_.back();
    frame.known.emplace_back(key);
    if (frame.json == nullptr) {
        return nullptr;
    }
    const auto it = frame.json->find(key);
    return it == frame.json->end() ? nullptr : &*it;
}

bool JsonReader::to_number(const Json& j, const std::string& path, Unit unit, const Bounds& bounds, double& value) {
    double x = 0.0;
    if (j.is_number()) {
        x = j.get<double>();
    } else if (j.is_string()) {
        const Quantity q = parse_quantity(j.get<std::string>(), unit);
        if (!q.problem.empty()) {
            complain(path, shown(j) + ", " + q.problem, expected_quantity(unit, bounds));
            return false;
        }
        x = q.value;
    } else {
        complain(path, shown(j), expected_quantity(unit, bounds));
        return false;
    }
    if (!std::isfinite(x) || !bounds.contains(x)) {
        complain(path, shown(j), expected_quantity(unit, bounds));
        return false;
    }
    value = x;
    return true;
}

void JsonReader::number(const char* key, double& value, Unit unit, const Bounds& bounds, const char*) {
    if (const Json* j = find(key)) {
        to_number(*j, frames_.back().path + "/" + key, unit, bounds, value);
    }
}

void JsonReader::number_or_word(const char* key, NumberOrWord& value, const std::vector<Choice>& words, Unit unit, const Bounds& bounds,
                                const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return;
    }
    const std::string path = frames_.back().path + "/" + key;
    if (j->is_string()) {
        const auto text = j->get<std::string>();
        const bool is_word = std::any_of(words.begin(), words.end(), [&](const Choice& c) { return c.name == text; });
        if (is_word) {
            value = {0.0, text};
            return;
        }
        if (!parse_quantity(text, unit).problem.empty()) {
            complain(path, shown(*j), fmt::format("{}, or {}", names(words), expected_quantity(unit, bounds)), nearest_choice(text, words));
            return;
        }
    }
    double x = 0.0;
    if (to_number(*j, path, unit, bounds, x)) {
        value = {x, ""};
    }
}

void JsonReader::integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return;
    }
    const double x = j->is_number() ? j->get<double>() : std::nan("");
    constexpr double beyond =
        9223372036854775808.0; // the first that 64 bits do not hold; as a number, the largest that they do is this one too
    if (!(x == std::floor(x)) || !(x >= static_cast<double>(low)) || !(x <= static_cast<double>(high)) || x >= beyond) {
        complain(frames_.back().path + "/" + key, shown(*j), fmt::format("a whole number from {} to {}", low, high));
        return;
    }
    value = j->is_number_integer() ? j->get<std::int64_t>() : static_cast<std::int64_t>(x);
}

void JsonReader::text(const char* key, std::string& value, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return;
    }
    if (!j->is_string()) {
        complain(frames_.back().path + "/" + key, shown(*j), "a text", j->is_number() ? fmt::format("in quotes: \"{}\"", j->dump()) : "");
        return;
    }
    value = j->get<std::string>();
}

void JsonReader::choice(const char* key, std::string& value, const std::vector<Choice>& choices, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        frames_.back().chosen.push_back(fmt::format("\"{}\": \"{}\"", key, value));
        return;
    }
    const std::string text = j->is_string() ? j->get<std::string>() : "";
    if (!j->is_string() || std::none_of(choices.begin(), choices.end(), [&](const Choice& c) { return c.name == text; })) {
        complain(frames_.back().path + "/" + key, shown(*j), "one of " + names(choices), nearest_choice(text, choices));
        frames_.back().unsure = true;
        return;
    }
    value = text;
    frames_.back().chosen.push_back(fmt::format("\"{}\": \"{}\"", key, value));
}

void JsonReader::numbers(const char* key, std::vector<double>& values, std::size_t count, Unit unit, const Bounds& bounds, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return;
    }
    const std::string path = frames_.back().path + "/" + key;
    if (!j->is_array() || j->empty() || (count > 0 && j->size() != count)) {
        complain(path, shown(*j), count > 0 ? fmt::format("a list of {} numbers", count) : "a list of numbers");
        return;
    }
    constexpr std::size_t most_complaints = 20; // of a list that may be of any length
    std::vector<double> read(j->size());
    std::size_t bad = 0;
    for (std::size_t k = 0; k < read.size() && bad < most_complaints; ++k) {
        bad += to_number((*j)[k], fmt::format("{}/{}", path, k), unit, bounds, read[k]) ? 0 : 1;
    }
    if (bad == 0) {
        values = read;
    }
}

void JsonReader::refused(const char* key, const char* reason) {
    if (const Json* j = find(key)) {
        complain(frames_.back().path + "/" + key, shown(*j), "no such key here", reason);
    }
    frames_.back().known.pop_back();
    if (frames_.back().json != nullptr && frames_.back().json->contains(key)) {
        frames_.back().known.emplace_back(key); // complained about once already
    }
}

bool JsonReader::begin_section(const char* key, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return false;
    }
    const std::string path = frames_.back().path + "/" + key;
    if (!j->is_object()) {
        complain(path, shown(*j), "an object");
        return false;
    }
    frames_.push_back({j, path, {}});
    return true;
}

void JsonReader::report_unknown() {
    const Frame& frame = frames_.back();
    if (frame.json == nullptr) {
        return;
    }
    for (const auto& [key, value] : frame.json->items()) {
        if (std::find(frame.known.begin(), frame.known.end(), key) != frame.known.end()) {
            continue;
        }
        const std::string at = frame.path.substr(frames_.front().path.size()) + "/" + key;
        unknown_.push_back({problems_.size(), dotted(at), frame.chosen, frame.unsure});
        const std::string best = nearest(key, frame.known);
        complain(frame.path + "/" + key.substr(0, 80), "an unknown key", fmt::format("one of {}", fmt::join(frame.known, ", ")),
                 best.empty() ? "" : fmt::format("did you mean \"{}\"?", best));
    }
}

void JsonReader::explain_unknown(const std::vector<ParameterInfo>& all) {
    for (auto unknown = unknown_.rbegin(); unknown != unknown_.rend(); ++unknown) { // the last first, so that places stay what they are
        const auto same = [&](const ParameterInfo& p) { return p.path == unknown->key; };
        const auto declared = std::find_if(all.begin(), all.end(), same);
        if (declared == all.end()) {
            continue;
        }
        if (unknown->unsure) {
            problems_.erase(problems_.begin() + static_cast<std::ptrdiff_t>(unknown->problem));
            continue;
        }
        const auto& chosen = unknown->chosen;
        Problem& p = problems_[unknown->problem];
        p.found = fmt::format("a key that nothing looks at {}: {}",
                              chosen.empty() ? "beside the others" : fmt::format("with {}", fmt::join(chosen, ", ")), declared->meaning);
        p.suggestion = "choose otherwise, or leave it out";
    }
}

void JsonReader::end_section() {
    report_unknown();
    frames_.pop_back();
}

void JsonReader::finish() { report_unknown(); }

std::optional<std::size_t> JsonReader::begin_list(const char* key, std::size_t, const char*) {
    const Json* j = find(key);
    if (j == nullptr) {
        return std::nullopt;
    }
    const std::string path = frames_.back().path + "/" + key;
    if (!j->is_array() || j->size() > 10000) {
        complain(path, shown(*j), "a list of objects");
        return std::nullopt;
    }
    frames_.push_back({j, path, {}});
    return j->size();
}

void JsonReader::begin_item(std::size_t k) {
    const Frame& list = frames_.back();
    const Json& item = (*list.json)[k];
    const std::string path = fmt::format("{}/{}", list.path, k);
    if (!item.is_object()) {
        complain(path, shown(item), "an object");
    }
    frames_.push_back({item.is_object() ? &item : nullptr, path, {}});
}

void JsonReader::end_list() { frames_.pop_back(); }

} // namespace proveta::input
