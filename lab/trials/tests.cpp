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

// Problems of a deck at the place where it stands in the file.
void keep(const input::InputError& error, const std::string& file, const std::string& at, bool own_file, input::Problems& problems) {
    for (auto problem : error.problems) {
        if (!own_file) {
            problem.source = file;
            problem.path = at + problem.path;
        }
        problems.push_back(problem);
    }
}

bool is_name(const std::string& name) {
    const auto good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
    return is_member_name(name) && std::all_of(name.begin(), name.end(), good);
}

} // namespace

void declare(input::Visitor& v, TestKeys& k) {
    v.text("name", k.name, "what the test is called; letters, digits, '_', '-' and '.'");
    v.numbers("seeds", k.seeds, 0, input::Unit::none, input::between(0, 9e15), "seeds of its specimens; results are means over them");
    v.number("weight", k.weight, input::Unit::none, input::above(0), "weight of its targets in a calibration");
}

std::vector<TrialTest> take_tests(Json& json, const std::string& file, input::Problems& problems, const Json& decks_begun_with) {
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
        TrialTest test{keys.name, {}, common, {}, keys.weight, {}};
        const bool own_file = tests[k]["deck"].is_string();
        try {
            std::string source = file;
            Json deck = tests[k]["deck"];
            if (own_file) {
                source = (folder / deck.get<std::string>()).lexically_normal().string();
                deck = input::load_json(source);
            }
            if (!deck.is_object()) {
                complain(at + "/deck", deck.dump(), "a deck, or the name of its file");
                continue;
            }
            test.written.merge_patch(deck);
            const Json& begun =
                decks_begun_with.is_object() && decks_begun_with.contains(keys.name) ? decks_begun_with[keys.name] : test.written;
            const Deck read = read_deck(begun, source);
            test.deck = resolved(read);
            test.files = files_of(read);
        } catch (const input::InputError& error) {
            keep(error, file, at + "/deck", own_file, problems);
            continue;
        }
        if (test.deck["specimen"].value("file", "").empty()) {
            for (const double seed : keys.seeds) {
                test.seeds.push_back(std::llround(seed));
            }
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
