#include "lab/trials/tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lab/deck.hpp"
#include "lab/output_folder.hpp"
#include "lab/provenance.hpp"

namespace proveta {

using input::Json;

namespace {

bool is_name(const std::string& name) {
    const auto good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
    return is_member_name(name) && std::all_of(name.begin(), name.end(), good);
}

} // namespace

void declare(input::Visitor& v, TestKeys& k) {
    v.text("name", k.name, "what the test is called; letters, digits, '_', '-' and '.'");
    v.numbers("seeds", k.seeds, 0, input::Unit::none, input::between(0, 9e15),
              "seeds of its specimens, by default that of its deck; results are means over them");
    v.number("weight", k.weight, input::Unit::none, input::above(0), "weight of its targets in a calibration");
}

namespace {

const Json* value_at(const Json& json, const std::string& path) {
    try {
        const Json::json_pointer pointer(path);
        return json.is_object() && json.contains(pointer) ? &json[pointer] : nullptr;
    } catch (const Json::exception&) { // a key with ~ in it
        return nullptr;
    }
}

// Where a key of a test's deck was written.
struct TestPlaces {
    const Json& common;
    const Json& own;
    std::string file, source, at; // the sweep or calibration, the deck's file, and the test in the former

    // A problem of the deck, at the place where its key was written; one that no key is there for belongs to the test.
    [[nodiscard]] input::Problem placed(input::Problem problem) const {
        if (problem.source != source) { // a card's file
            return problem;
        }
        const bool shared = !problem.path.empty() && value_at(own, problem.path) == nullptr && value_at(common, problem.path) != nullptr;
        problem.source = shared ? file : source;
        problem.path = (shared ? "/deck" : source == file ? at + "/deck" : "") + problem.path;
        return problem;
    }

    // A problem of a key that somebody wrote.
    [[nodiscard]] input::Problem problem(const std::string& key, const std::string& expected, const std::string& hint) const {
        const Json* written = value_at(own, key);
        return placed({source, key, (written != nullptr ? written : value_at(common, key))->dump(), expected, hint});
    }
};

// What all tests share is said once.
void say_once(const input::Problem& problem, input::Problems& problems) {
    if (std::none_of(problems.begin(), problems.end(), [&](const auto& p) { return p.text() == problem.text(); })) {
        problems.push_back(problem);
    }
}

// Trials keep curve and results: what `proveta run` writes besides is refused where somebody asks for it. The decks keep its defaults, with
// which `proveta run` shows a trial.
void check_output(const TrialTest& test, const TestPlaces& places, input::Problems& problems) {
    for (const auto& [key, hint] : {std::pair{"fields", "proveta run trials/KEY/JOB/deck.json writes those of one trial"},
                                    {"pictures", "proveta run trials/KEY/JOB/deck.json draws those of one trial"},
                                    {"checkpoint_every", "a test that is stopped begins anew; those that have ended are kept"}}) {
        const std::string path = std::string("/output/") + key;
        if (value_at(test.written, path) == nullptr || test.deck["output"][key] == 0) {
            continue;
        }
        say_once(places.problem(path, "0, or no such key: the tests of sweeps and calibrations write none", hint), problems);
    }
}

// The seeds of a test's specimens, none for a stored one.
std::vector<std::int64_t> seeds_of(const TrialTest& test, const TestKeys& keys, bool given, const TestPlaces& places,
                                   input::Problems& problems) {
    std::vector<std::int64_t> out;
    if (!test.deck["specimen"].value("file", "").empty()) {
        if (given) {
            problems.push_back(
                {places.file, places.at + "/seeds", "seeds of a stored specimen", "no such key", "a recipe makes a specimen of each seed"});
        }
        return out;
    }
    if (!given) {
        return {test.deck["specimen"]["seed"].get<std::int64_t>()};
    }
    for (const double seed : keys.seeds) {
        if (std::find(out.begin(), out.end(), std::llround(seed)) != out.end()) {
            problems.push_back({places.file, places.at + "/seeds", fmt::format("{} again", seed), "seeds that differ",
                                "the same seed makes the same specimen"});
        }
        out.push_back(std::llround(seed));
    }
    const Json* own = value_at(test.written, "/specimen/seed");
    if (own != nullptr && std::find(out.begin(), out.end(), own->get<std::int64_t>()) == out.end()) {
        problems.push_back(
            places.problem("/specimen/seed", fmt::format("no such key, or one of the test's \"seeds\": {}", fmt::join(out, ", ")), ""));
    }
    return out;
}

} // namespace

std::vector<TrialTest> take_tests(Json& json, const std::string& file, input::Problems& problems, const TestRules& rules) {
    const Json& decks_begun_with = rules.decks_begun_with;
    std::vector<TrialTest> out;
    const auto complain = [&](const std::string& path, const std::string& found, const std::string& expected,
                              const std::string& hint = "") {
        problems.push_back({file, path, found, expected, hint});
    };
    if (!json.is_object()) {
        complain("", "no object", "an object with \"tests\" and \"parameters\"");
        json = Json::object();
        return out;
    }
    const Json common = json.value("deck", Json::object());
    const Json tests = json.value("tests", Json::array());
    json.erase("deck");
    json.erase("tests");
    if (!common.is_object()) {
        complain("/deck", common.dump(), "an object with what the decks of all tests share");
        return out;
    }
    if (!tests.is_array() || tests.empty()) {
        complain("/tests", tests.is_array() ? "no tests" : tests.dump(), "a list of at least one test: {\"name\": ..., \"deck\": ...}");
        return out;
    }
    const auto folder = std::filesystem::absolute(file).parent_path();
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const std::string at = fmt::format("/tests/{}", k);
        if (!tests[k].is_object()) {
            complain(at, tests[k].dump(), "an object with \"name\" and \"deck\"");
            continue;
        }
        Json rest = tests[k];
        rest.erase("deck");
        TestKeys keys;
        input::read(rest, keys, file, at, problems);
        if (!is_name(keys.name)) {
            complain(at + "/name", "\"" + keys.name + "\"",
                     "a name of at most 200 letters, digits, '_', '-' and '.', and of no file of the results");
        }
        if (std::any_of(out.begin(), out.end(), [&](const TrialTest& t) { return t.name == keys.name; })) {
            complain(at + "/name", "\"" + keys.name + "\" again", "a name of its own");
        }
        if (!tests[k].contains("deck")) {
            complain(at + "/deck", "nothing", "a deck, or the name of its file");
            continue;
        }
        if (rest.contains("weight") && !rules.targets) {
            complain(at + "/weight", rest["weight"].dump(), "no such key: a sweep has no targets to weigh");
        }
        TrialTest test{keys.name, {}, common, {}, keys.weight, {}};
        Json deck = tests[k]["deck"];
        TestPlaces places{common, deck, file, file, at};
        try {
            if (deck.is_string()) {
                places.source = (folder / deck.get<std::string>()).lexically_normal().string();
                deck = input::load_json(places.source);
            }
            if (!deck.is_object()) {
                complain(at + "/deck", deck.dump(), "a deck, or the name of its file");
                continue;
            }
            if (value_at(deck, "/specimen/file") != nullptr && test.written.contains("specimen")) {
                test.written.erase("specimen"); // a stored specimen takes the place of the recipe that the tests share
            }
            test.written.merge_patch(deck);
            const Json& begun =
                decks_begun_with.is_object() && decks_begun_with.contains(keys.name) ? decks_begun_with[keys.name] : test.written;
            const Deck read = read_deck(begun, places.source);
            test.deck = resolved(read);
            test.files = files_of(read);
        } catch (const input::InputError& error) {
            for (const auto& problem : error.problems) {
                say_once(places.placed(problem), problems);
            }
            continue;
        }
        test.seeds = seeds_of(test, keys, rest.contains("seeds"), places, problems);
        if (!rules.begun) {
            check_output(test, places, problems);
        }
        out.push_back(std::move(test));
    }
    return out;
}

Json hashes_of(const std::vector<TrialTest>& tests) {
    std::vector<std::string> files;
    for (const auto& test : tests) {
        files.insert(files.end(), test.files.begin(), test.files.end());
    }
    return hashes_of(files);
}

void add_tests_to_schema(Json& schema) {
    Json test = input::schema(TestKeys{});
    const Json deck = {{"description", "a deck, as of `proveta run`, or the name of its file"},
                       {"type", Json::array({"object", "string"})}};
    test["properties"]["deck"] = deck;
    test["required"] = Json::array({"name", "deck"});
    schema["properties"]["deck"] = {{"description", "what the decks of all tests share"}, {"type", "object"}};
    schema["properties"]["tests"] = {{"description", "the tests of every trial"}, {"type", "array"}, {"minItems", 1}, {"items", test}};
    schema["required"] = Json::array({"tests", "parameters"});
}

} // namespace proveta
