#include "lab/series/expand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/input/units.hpp"

namespace proveta {

using input::Json;
using input::Problem;

namespace {

constexpr std::size_t most_members = 1000;

// A key of a deck that may be a list.
struct ListKey {
    const char* section;
    const char* key;
    input::Unit unit;

    [[nodiscard]] std::string path() const { return fmt::format("/{}/{}", section, key); }

    [[nodiscard]] const Json* list_in(const Json& deck) const {
        const bool there = deck.is_object() && deck.contains(section) && deck[section].is_object() && deck[section].contains(key);
        return there && deck[section][key].is_array() ? &deck[section][key] : nullptr;
    }

    // The number that an entry stands for, if it is one.
    [[nodiscard]] std::optional<double> value(const Json& entry) const {
        if (entry.is_number()) {
            return entry.get<double>();
        }
        if (entry.is_string()) {
            const auto quantity = input::parse_quantity(entry.get<std::string>(), unit);
            return quantity.problem.empty() ? std::optional(quantity.value) : std::nullopt;
        }
        return std::nullopt;
    }

    // As a part of a folder's name.
    [[nodiscard]] std::string label(const Json& entry) const {
        const double v = value(entry).value_or(0.0);
        return unit == input::Unit::pressure ? fmt::format("p_{:.6g}MPa", 1e-6 * v) : fmt::format("{}_{:.15g}", key, v);
    }
};

constexpr ListKey list_keys[] = {{"loading", "confining_pressure", input::Unit::pressure}, {"specimen", "seed", input::Unit::none}};

void check_list(const ListKey& key, const Json& list, const std::string& file, input::Problems& problems) {
    if (list.empty()) {
        problems.push_back({file, key.path(), "an empty list", "a value, or a list of values of which each is a test of its own", ""});
    }
    for (std::size_t k = 0; k < list.size(); ++k) {
        const auto value = key.value(list[k]);
        for (std::size_t earlier = 0; value && earlier < k; ++earlier) {
            if (key.value(list[earlier]) == value) {
                problems.push_back({file, fmt::format("{}/{}", key.path(), k),
                                    fmt::format("{}, which is there already as entry {}", list[k].dump(), earlier), "values that differ",
                                    ""});
                break;
            }
        }
    }
}

// The entry that a problem is about, if it is about one.
const ListEntry* entry_of(const MemberProblem& found) {
    for (const auto& entry : found.entries) {
        if (found.problem.path == entry.path) {
            return &entry;
        }
    }
    return nullptr;
}

} // namespace

bool has_lists(const Json& deck) {
    return std::any_of(std::begin(list_keys), std::end(list_keys), [&](const ListKey& key) { return key.list_in(deck) != nullptr; });
}

std::vector<ExpandedDeck> expand(const Json& deck, const std::string& file, input::Problems& problems) {
    std::vector<ExpandedDeck> out{{deck, "", {}}};
    for (const auto& key : list_keys) {
        const Json* list = key.list_in(deck);
        if (list == nullptr) {
            continue;
        }
        if (out.size() * list->size() > most_members) {
            problems.push_back({file, key.path(), fmt::format("{} tests", out.size() * list->size()),
                                fmt::format("at most {} in a series", most_members), ""});
            return {};
        }
        check_list(key, *list, file, problems);
        std::vector<ExpandedDeck> product;
        for (const auto& so_far : out) {
            for (std::size_t k = 0; k < list->size(); ++k) {
                ExpandedDeck one = so_far;
                one.json[key.section][key.key] = (*list)[k];
                one.label += (one.label.empty() ? "" : "_") + key.label((*list)[k]);
                one.entries.push_back({key.path(), list->dump(), k, list->size()});
                product.push_back(std::move(one));
            }
        }
        out = std::move(product);
    }
    return out;
}

void allow_lists(Json& schema) {
    for (const auto& key : list_keys) {
        const auto pointer = Json::json_pointer(fmt::format("/properties/{}/properties/{}", key.section, key.key));
        if (!schema.contains(pointer)) {
            continue;
        }
        Json& whole = schema[pointer];
        Json one = Json::object();
        Json both = Json::object();
        for (const auto& [name, value] : whole.items()) {
            (name == "description" || name == "default" ? both : one)[name] = value;
        }
        both["description"] = both["description"].get<std::string>() + "; a list makes a series of tests";
        both["anyOf"] = {one, {{"type", "array"}, {"items", one}, {"minItems", 1}, {"uniqueItems", true}}};
        whole = both;
    }
}

input::Problems merged(const std::vector<MemberProblem>& found) {
    using Key = std::tuple<std::string, std::string, std::string, std::string>; // source, path, expected, suggestion
    const auto key_of = [](const Problem& p) { return Key{p.source, p.path, p.expected, p.suggestion}; };
    // Which of a list's entries have the problem.
    std::vector<std::pair<Key, std::set<std::size_t>>> having;
    const auto entries_with = [&](const Problem& p) -> std::set<std::size_t>& {
        const Key key = key_of(p);
        const auto at = std::find_if(having.begin(), having.end(), [&](const auto& h) { return h.first == key; });
        return at != having.end() ? at->second : having.emplace_back(key, std::set<std::size_t>{}).second;
    };
    for (const auto& f : found) {
        if (const ListEntry* entry = entry_of(f)) {
            entries_with(f.problem).insert(entry->index);
        }
    }
    input::Problems out;
    std::set<std::string> said;
    for (const auto& f : found) {
        Problem p = f.problem;
        if (const ListEntry* entry = entry_of(f)) {
            if (entries_with(f.problem).size() == entry->size) {
                p.found = entry->list;
            } else {
                p.path += fmt::format("/{}", entry->index);
            }
        }
        if (said.insert(p.text()).second) {
            out.push_back(std::move(p));
        }
    }
    return out;
}

} // namespace proveta
