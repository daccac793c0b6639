#include "lab/series/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "lab/output_folder.hpp"
#include "lab/provenance.hpp"
#include "lab/series/expand.hpp"

namespace proveta {

using input::Json;

namespace {

constexpr const char* series_mark = "proveta_series_manifest";

// A member before its deck is read.
struct Candidate {
    std::string file;
    std::string name; // empty: the deck's own
    ExpandedDeck deck;
    std::string expected_specimen;
};

// Members of a series' manifest. Their names become folders, so that they must be names and not paths.
std::vector<Candidate> members_of(const Json& manifest, const std::string& file, bool changed) {
    const auto fail = [&](const std::string& path, const std::string& found, const std::string& expected) {
        throw input::InputError({{file, path, found, expected, ""}});
    };
    if (!manifest.contains("members") || !manifest["members"].is_array() || manifest["members"].empty()) {
        fail("/members", "no members", "the members of a series, as the program writes them");
    }
    std::vector<Candidate> out;
    for (const auto& member : manifest["members"]) {
        const std::string name = input::text_at(member, "name");
        const std::string path = fmt::format("/members/{}", out.size());
        if (!is_member_name(name)) {
            fail(path + "/name", "\"" + name + "\"", "the name of a folder");
        }
        if (!member.contains("deck") || !member["deck"].is_object()) {
            fail(path + "/deck", "no deck", "a deck");
        }
        out.push_back({file, name, {member["deck"], "", {}}, changed ? "" : input::text_at(member, "specimen_hash")});
    }
    return out;
}

std::vector<Candidate> candidates(const std::string& file, const std::vector<std::string>& settings, Plan& plan) {
    const Json json = input::load_json(file);
    bool& series = plan.series;
    std::vector<Candidate> raw;
    if (json.contains(series_mark)) {
        series = true;
        plan.study = input::text_at(json, "study");
        plan.title = input::text_at(json, "title");
        raw = members_of(json, file, !settings.empty());
    } else if (json.contains("proveta_manifest")) {
        const Json deck = json.contains("deck") ? Json(json["deck"]) : Json::object();
        raw.push_back({file, "", {deck, "", {}}, settings.empty() ? input::text_at(json, "specimen_hash") : ""});
    } else {
        raw.push_back({file, "", {json, "", {}}, ""});
    }
    std::vector<Candidate> out;
    input::Problems problems;
    for (auto& one : raw) {
        apply_settings(one.deck.json, settings);
        series = series || has_lists(one.deck.json);
        for (auto& deck : expand(one.deck.json, file, problems)) {
            out.push_back({file, one.name, std::move(deck), one.expected_specimen});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return out;
}

// Stem of the deck's file among several decks, and what its lists make of it.
std::string name_of(const Candidate& c, const std::string& test, bool several_files) {
    if (!c.name.empty()) {
        return c.deck.label.empty() ? c.name : c.name + "_" + c.deck.label;
    }
    const std::string whose = result_name(c.file, test);
    if (c.deck.label.empty()) {
        return whose;
    }
    return several_files ? whose + "_" + c.deck.label : c.deck.label;
}

// The name, or the name with a number where another member has it.
std::string unique(const std::string& name, const std::vector<Member>& members) {
    std::string out = name;
    const auto taken = [&](const Member& m) { return m.name == out; };
    for (int n = 2; std::any_of(members.begin(), members.end(), taken); ++n) {
        out = fmt::format("{}_{}", name, n);
    }
    return out;
}

} // namespace

Plan read_plan(const std::vector<std::string>& files, const std::vector<std::string>& settings) {
    Plan plan;
    plan.series = files.size() > 1;
    std::vector<MemberProblem> problems;
    const auto keep = [&](const input::InputError& error, const std::vector<ListEntry>& entries) {
        for (const auto& problem : error.problems) {
            problems.push_back({problem, entries});
        }
    };
    std::map<std::string, std::string> names; // of members, by what they test
    for (const auto& file : files) {
        std::vector<Candidate> found;
        try {
            found = candidates(file, settings, plan);
        } catch (const input::InputError& error) {
            keep(error, {});
        }
        for (const auto& c : found) {
            try {
                Deck deck = read_deck(c.deck.json, file);
                deck.expected_specimen = c.expected_specimen;
                Json same = resolved(deck);
                same.erase("title");
                const std::string name = unique(name_of(c, deck.test, files.size() > 1), plan.members);
                if (const auto [other, fresh] = names.emplace(same.dump(), name); !fresh) {
                    problems.push_back({{file, "", "the same test as \"" + other->second + "\"", "tests that differ",
                                         "the same deck gives the same result; give it another seed"},
                                        {}});
                    continue;
                }
                plan.members.push_back({name, std::move(deck)});
            } catch (const input::InputError& error) {
                keep(error, c.deck.entries);
            }
        }
    }
    if (!problems.empty()) {
        throw input::InputError(merged(problems));
    }
    if (files.size() > 1) {
        plan.study.clear();
        plan.title = fmt::format("A series of {} tests", plan.members.size());
    } else if (plan.title.empty() && plan.series) {
        plan.title = fmt::format("{}: a series of {}", plan.members.front().deck.title, plan.members.size());
    }
    return plan;
}

Json series_manifest(const Plan& plan, const std::vector<std::string>& hashes, const std::string& command, const std::string& status,
                     const std::string& started, const std::string& folder) {
    Json j;
    j[series_mark] = 1;
    j["status"] = status;
    j["title"] = plan.title;
    if (!plan.study.empty()) {
        j["study"] = plan.study;
    }
    j["command"] = command;
    j["repeat_with"] = fmt::format("proveta run {}/manifest.json --out NEW_FOLDER", folder);
    j.update(program_facts());
    j["started"] = started;
    for (std::size_t k = 0; k < plan.members.size(); ++k) {
        const Member& m = plan.members[k];
        j["members"].push_back({{"name", m.name}, {"deck_file", m.deck.source}, {"specimen_hash", hashes[k]}, {"deck", resolved(m.deck)}});
    }
    return j;
}

} // namespace proveta
