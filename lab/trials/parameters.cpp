#include "lab/trials/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/input/describe.hpp"
#include "core/input/suggest.hpp"
#include "lab/deck.hpp"
#include "lab/protocols/registry.hpp"

namespace proveta {

using input::Json;
using input::Unit;

namespace {

Json::json_pointer pointer_of(const std::string& path) {
    std::string text = "/" + path;
    std::replace(text.begin(), text.end(), '.', '/');
    return Json::json_pointer(text);
}

bool has(const Json& deck, const std::string& path) {
    try {
        return deck.contains(pointer_of(path));
    } catch (const Json::exception&) {
        return false;
    }
}

// A number, or a word that stands for one ("auto").
bool may_be_number(const Json& j) { return j.is_number() || j.is_string(); }

// Paths of all values of a deck.
void collect(const Json& json, const std::string& prefix, std::vector<std::string>& out) {
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) {
            collect(value, prefix.empty() ? key : prefix + "." + key, out);
        }
    } else if (may_be_number(json)) {
        out.push_back(prefix);
    }
}

// What a deck of the test declares of a value; nothing: no such thing.
std::optional<input::ParameterInfo> declared_at(const std::string& path, const std::string& test) {
    std::string declared = path;
    const auto dot = declared.rfind('.');
    if (dot != std::string::npos && declared.find_first_not_of("0123456789", dot + 1) == std::string::npos) {
        declared.resize(dot);
    }
    input::Describer describer;
    Deck deck;
    deck.protocol = make_protocol(test);
    declare(describer, deck);
    for (const auto& p : describer.parameters()) {
        if (p.path == declared) {
            return p;
        }
    }
    return std::nullopt;
}

// SI unit of a value.
std::string unit_of(const std::string& path, const std::string& test) {
    const auto declared = declared_at(path, test);
    return declared ? declared->unit : "";
}

// Whether a value is a text or one of some words, and never a number.
bool is_text(const std::string& path, const std::string& test) {
    const auto declared = declared_at(path, test);
    return declared && (declared->allowed == "text" || declared->allowed.starts_with('"'));
}

// What a deck itself says to a number at that path, such as that its law has no such key.
std::string why_not(const std::string& path, const std::vector<Json>& decks, const std::string& source) {
    for (Json deck : decks) {
        const auto pointer = pointer_of(path);
        if (pointer.empty() || !deck.contains(pointer.parent_pointer()) || !deck[pointer.parent_pointer()].is_object()) {
            continue;
        }
        deck[pointer] = 1.0;
        try {
            (void)read_deck(deck, source);
        } catch (const input::InputError& error) {
            for (const auto& problem : error.problems) {
                if (problem.path == pointer.to_string() && problem.found != "an unknown key") {
                    return problem.suggestion.empty() ? problem.expected : problem.suggestion;
                }
            }
        }
    }
    return "";
}

} // namespace

double Parameter::at(double u) const { return scale == "log" ? low * std::pow(high / low, u) : low + u * (high - low); }

double Parameter::position(double value) const {
    if (high == low) {
        return 0.0;
    }
    return scale == "log" ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

void declare(input::Visitor& v, Parameter& p) {
    v.text("name", p.name, "what it is called in tables; by default the last part of its path");
    v.text("path", p.path, "value of the decks, such as material.tau_f or material.lcs.0");
    v.number("low", p.low, Unit::any, input::any_number(), "lower bound");
    v.number("high", p.high, Unit::any, input::any_number(), "upper bound");
    v.numbers("values", p.values, 0, Unit::any, input::any_number(), "levels of a grid, instead of bounds");
    v.integer("levels", p.levels, 1, 1000, "number of levels of a grid between the bounds");
    v.choice("scale", p.scale, {{"linear", "evenly between the bounds"}, {"log", "in equal ratios; both bounds above 0"}},
             "how values lie between the bounds");
    v.text("times", p.times,
           "name of an earlier parameter: the deck gets that one's value times this one's, so that an order among values holds by itself");
    v.number(
        "power", p.power, Unit::none, input::any_number(),
        "with times: the power that the other one's value is raised to; 2 for a fracture energy over a strength, which fixes a length");
}

void refuse_keys(const Json& json, const std::string& path, const std::vector<std::string>& keys, const std::string& why,
                 const std::string& file, input::Problems& problems) {
    for (const auto& key : keys) {
        if (json.is_object() && json.contains(key)) {
            problems.push_back({file, path + "/" + key, json[key].dump(), "nothing, since " + why, "leave it out"});
        }
    }
}

void refuse_levels(const Json& json, const std::string& why, const std::string& file, input::Problems& problems) {
    const Json parameters = json.is_object() ? json.value("parameters", Json::array()) : Json::array();
    for (std::size_t k = 0; parameters.is_array() && k < parameters.size(); ++k) {
        refuse_keys(parameters[k], fmt::format("/parameters/{}", k), {"values", "levels"}, why, file, problems);
    }
}

void check_units(const Json& json, const std::vector<Parameter>& parameters, const std::vector<TrialTest>& tests, const std::string& file,
                 input::Problems& problems) {
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const Parameter& p = parameters[k];
        const auto with = std::find_if(tests.begin(), tests.end(), [&](const TrialTest& t) { return has(t.deck, p.path); });
        if (with == tests.end()) {
            continue;
        }
        auto dimension = input::dimension_of(unit_of(p.path, input::text_at(with->deck, "test")));
        if (!p.times.empty()) { // a factor
            dimension = Unit::none;
        }
        const Json& written = json["parameters"][k];
        const auto look = [&](const Json& value, const std::string& key) {
            if (!value.is_string() || !dimension) {
                return;
            }
            const auto text = value.get<std::string>();
            const std::string at = fmt::format("/parameters/{}/{}", k, key);
            const bool said = std::any_of(problems.begin(), problems.end(), [&](const input::Problem& q) { return q.path == at; });
            if (const auto found = input::parse_quantity(text, *dimension); !found.problem.empty() && !said) {
                const std::string si = input::si_unit(*dimension);
                problems.push_back({file, at, "\"" + text + "\", " + found.problem,
                                    fmt::format("a {} for {}, {}", p.times.empty() ? "value" : "factor", p.path,
                                                si.empty() ? "which has no unit" : "in " + si),
                                    ""});
            }
        };
        look(written.value("low", Json()), "low");
        look(written.value("high", Json()), "high");
        const Json values = written.value("values", Json::array());
        for (std::size_t n = 0; values.is_array() && n < values.size(); ++n) {
            look(values[n], fmt::format("values/{}", n));
        }
    }
}

ParameterSpace::ParameterSpace(std::vector<Parameter> parameters, const std::vector<Json>& decks, const std::string& source,
                               input::Problems& problems)
    : parameters_(std::move(parameters)) {
    std::vector<std::string> names;
    std::vector<std::string> paths;
    std::vector<std::string> known;
    for (const auto& deck : decks) {
        collect(deck, "", known);
    }
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
        auto& p = parameters_[k];
        const std::string at = fmt::format("/parameters/{}", k);
        const auto complain = [&](const std::string& key, const std::string& found, const std::string& expected,
                                  const std::string& hint = "") {
            problems.push_back({source, at + key, found, expected, hint});
        };
        if (p.name.empty()) {
            const auto dot = p.path.rfind('.');
            const bool index = dot != std::string::npos && p.path.find_first_not_of("0123456789", dot + 1) == std::string::npos;
            p.name = index ? p.path : p.path.substr(dot == std::string::npos ? 0 : dot + 1);
        }
        if (std::find(names.begin(), names.end(), p.name) != names.end()) {
            complain("/name", "\"" + p.name + "\" again", "a name of its own", "give it a \"name\"");
        }
        if (std::find(paths.begin(), paths.end(), p.path) != paths.end()) {
            complain("/path", "\"" + p.path + "\" again", "a value that no other parameter sets");
        }
        const auto with =
            std::find_if(decks.begin(), decks.end(), [&](const Json& d) { return has(d, p.path) && may_be_number(d[pointer_of(p.path)]); });
        const bool text = with != decks.end() && is_text(p.path, input::text_at(*with, "test"));
        if (with == decks.end() || text || p.path.find('/') != std::string::npos) {
            const std::string best = input::nearest(p.path, known);
            const std::string why = text ? "it takes a text" : why_not(p.path, decks, source);
            complain("/path", "\"" + p.path + "\"", "the dotted path of a number in the decks",
                     !why.empty()   ? why
                     : best.empty() ? ""
                                    : "did you mean \"" + best + "\"?");
        }
        if (!p.values.empty()) {
            const auto [low, high] = std::minmax_element(p.values.begin(), p.values.end());
            p.low = *low;
            p.high = *high;
            auto sorted = p.values;
            std::sort(sorted.begin(), sorted.end());
            if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
                complain("/values", fmt::format("{}", fmt::join(p.values, ", ")), "values that differ");
            }
        } else if (!(p.low < p.high) && std::none_of(problems.begin(), problems.end(),
                                                     [&](const auto& q) { return q.path == at + "/low" || q.path == at + "/high"; })) {
            complain("", fmt::format("low {:.6g}, high {:.6g}", p.low, p.high), "low below high");
        }
        if (p.scale == "log" && !(p.low > 0.0)) {
            complain("/low", fmt::format("{:.6g}", p.low), "a number above 0 for a logarithmic scale");
        }
        parent_.push_back(k);
        if (!p.times.empty()) {
            const auto parent = std::find(names.begin(), names.end(), p.times);
            if (parent == names.end()) {
                complain("/times", "\"" + p.times + "\"", fmt::format("the name of an earlier parameter: {}", fmt::join(names, ", ")));
            } else {
                parent_.back() = static_cast<std::size_t>(parent - names.begin());
            }
        }
        p.unit = with == decks.end() ? "" : unit_of(p.path, (*with)["test"]);
        names.push_back(p.name);
        paths.push_back(p.path);
    }
}

std::vector<double> ParameterSpace::values(const std::vector<double>& u) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < size(); ++k) {
        out.push_back(parameters_[k].at(u[k]));
    }
    return out;
}

std::vector<double> ParameterSpace::resolved(const std::vector<double>& values) const {
    std::vector<double> out = values;
    for (std::size_t k = 0; k < size(); ++k) {
        out[k] = parent_[k] == k ? values[k] : values[k] * std::pow(out[parent_[k]], parameters_[k].power);
    }
    return out;
}

void ParameterSpace::apply(Json& deck, const std::vector<double>& values) const {
    const auto written = resolved(values);
    for (std::size_t k = 0; k < size(); ++k) {
        if (has(deck, parameters_[k].path)) {
            auto& target = deck[pointer_of(parameters_[k].path)];
            if (target.is_number_integer()) {
                target = static_cast<std::int64_t>(std::llround(written[k]));
            } else {
                target = written[k];
            }
        }
    }
}

} // namespace proveta
