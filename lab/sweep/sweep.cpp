#include "lab/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "core/input/suggest.hpp"
#include "lab/results.hpp"
#include "lab/trials/decks.hpp"

namespace proveta {

using input::Json;

namespace {

constexpr std::size_t most_points = 100000;

// Takes the list of names out of the JSON: the only key that is a list of texts.
std::vector<std::string> take_results(Json& json, const std::string& file, input::Problems& problems) {
    std::vector<std::string> out;
    const Json list = json.value("results", Json::array());
    json.erase("results");
    const bool good = list.is_array() && std::all_of(list.begin(), list.end(), [](const Json& name) { return name.is_string(); });
    if (!good) {
        problems.push_back({file, "/results", list.dump(), "a list of names of results, such as [\"strength\"]", ""});
        return out;
    }
    return list.get<std::vector<std::string>>();
}

// Names that no test can give are said before anything runs.
void check_results(const Sweep& sweep, const std::string& file, input::Problems& problems) {
    std::vector<std::string> known;
    for (const auto& test : sweep.tests) {
        for (const auto& result : possible_results(read_deck(test.deck, file))) {
            known.push_back(result.name);
        }
    }
    for (std::size_t k = 0; k < sweep.results.size() && !known.empty(); ++k) {
        const std::string& name = sweep.results[k];
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            const std::string best = input::nearest(name, known);
            std::vector<std::string> names = known;
            std::sort(names.begin(), names.end());
            names.erase(std::unique(names.begin(), names.end()), names.end());
            problems.push_back({file, fmt::format("/results/{}", k), "\"" + name + "\"",
                                fmt::format("a result of one of the tests: {}", fmt::join(names, ", ")),
                                best.empty() ? "" : "did you mean \"" + best + "\"?"});
        }
    }
}

// Levels of a parameter of a grid: its own values.
std::vector<double> levels_of(const Parameter& p) {
    if (!p.values.empty()) {
        return p.values;
    }
    std::vector<double> out;
    for (std::int64_t k = 0; k < p.levels; ++k) {
        out.push_back(p.at(p.levels == 1 ? 0.5 : static_cast<double>(k) / static_cast<double>(p.levels - 1)));
    }
    return out;
}

void check_keys(const SweepInput& input, const std::string& file, input::Problems& problems) {
    if (input.parameters.empty()) {
        problems.push_back({file, "/parameters", "none", "at least one: {\"path\": ..., \"low\": ..., \"high\": ...}", ""});
    }
    if (input.design == "morris" && input.levels % 2 != 0) {
        problems.push_back({file, "/levels", std::to_string(input.levels), "an even number for Morris' design", ""});
    }
    for (std::size_t k = 0; k < input.parameters.size(); ++k) {
        const auto& p = input.parameters[k];
        const std::string at = fmt::format("/parameters/{}", k);
        const auto usual = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
        if (!std::all_of(p.name.begin(), p.name.end(), usual)) {
            problems.push_back({file, at + "/name", "\"" + p.name + "\"", "a name of letters, digits, '_', '-' and '.'", ""});
        }
    }
    double points = static_cast<double>(input.points);
    const char* path = "/points";
    if (input.design == "grid") {
        path = "/parameters";
        points = 1.0;
        for (const auto& p : input.parameters) {
            points *= static_cast<double>(levels_of(p).size());
        }
    } else if (input.design == "morris") {
        points *= static_cast<double>(input.parameters.size() + 1);
    }
    if (points > static_cast<double>(most_points)) {
        problems.push_back({file, path, fmt::format("{:.0f} points", points), fmt::format("at most {} points", most_points), ""});
    }
}

// Keys that a design does not look at.
std::vector<std::string> unused_keys(const std::string& design) {
    return design == "grid"              ? std::vector<std::string>{"points", "levels", "seed"}
           : design == "sobol"           ? std::vector<std::string>{"levels", "seed"}
           : design == "latin_hypercube" ? std::vector<std::string>{"levels"}
                                         : std::vector<std::string>{};
}

void lay_out(Sweep& sweep) {
    const SweepInput& input = sweep.input;
    const auto n = static_cast<std::size_t>(input.points);
    const auto seed = static_cast<std::uint64_t>(input.seed);
    const std::size_t parameters = sweep.space.size();
    if (input.design == "grid") {
        // Of the levels themselves, which a way through the unit cube would round.
        std::vector<std::vector<double>> levels;
        for (std::size_t k = 0; k < parameters; ++k) {
            levels.push_back(levels_of(sweep.space[k]));
        }
        sweep.values = grid(levels);
        for (const auto& values : sweep.values) {
            sweep.points.emplace_back();
            for (std::size_t k = 0; k < parameters; ++k) {
                sweep.points.back().push_back(sweep.space[k].position(values[k]));
            }
        }
        return;
    }
    sweep.points = input.design == "sobol"             ? sobol(n, parameters)
                   : input.design == "latin_hypercube" ? latin_hypercube(n, parameters, seed)
                                                       : morris(n, parameters, static_cast<std::size_t>(input.levels), seed);
    for (const auto& point : sweep.points) {
        sweep.values.push_back(sweep.space.values(point));
    }
}

} // namespace

void declare(input::Visitor& v, SweepInput& s) {
    v.text("title", s.title, "heading of the report; by default the name of the file");
    v.choice("design", s.design,
             {{"grid", "all combinations of the parameters' levels"},
              {"latin_hypercube", "random points, one in every n-th of each range"},
              {"sobol", "Sobol's evenly filling points; best for a power of two"},
              {"morris", "Morris' trajectories, for elementary effects: few points for many parameters"}},
             "where the points lie");
    v.integer("points", s.points, 1, static_cast<std::int64_t>(most_points),
              "number of points; of Morris' design, of trajectories of one more point than there are parameters; a grid has its levels");
    v.integer("levels", s.levels, 2, 1000, "number of levels of each parameter in Morris' design, even");
    v.integer("seed", s.seed, 0, 9000000000000000, "of the random designs; specimens have seeds of their own");
    v.list("parameters", s.parameters, "what is varied");
}

Sweep read_sweep(const std::string& file) {
    input::Problems problems;
    Json json = input::load_json(file);
    Json begun_with;
    TestRules rules;
    if (json.is_object() && json.contains("proveta_sweep_manifest")) {
        rules.begun = true;
        begun_with = json.value("files", Json::object());
        json = json.value("sweep", Json());
    }
    Sweep sweep;
    sweep.tests = take_tests(json, file, problems, rules);
    sweep.files = begun_with.is_object() ? begun_with : hashes_of(sweep.tests);
    sweep.results = take_results(json, file, problems);
    check_results(sweep, file, problems);
    input::read(json, sweep.input, file, "", problems);
    check_units(json, sweep.input.parameters, sweep.tests, file, problems);
    check_keys(sweep.input, file, problems);
    const std::string design = "the design is " + sweep.input.design;
    refuse_keys(json, "", unused_keys(sweep.input.design), design, file, problems);
    if (sweep.input.design != "grid") {
        refuse_levels(json, design, file, problems);
    }
    for (std::size_t k = 0; k < sweep.input.parameters.size(); ++k) {
        if (!sweep.input.parameters[k].values.empty()) {
            refuse_keys(json["parameters"][k], fmt::format("/parameters/{}", k), {"low", "high", "levels"}, "its levels are its \"values\"",
                        file, problems);
        }
    }
    std::vector<Json> decks;
    for (const auto& test : sweep.tests) {
        decks.push_back(test.deck);
    }
    if (!decks.empty()) { // without one, every path would be called wrong
        sweep.space = ParameterSpace(sweep.input.parameters, decks, file, problems);
    }
    if (problems.empty()) {
        std::vector<std::vector<double>> levels;
        for (std::size_t k = 0; k < sweep.space.size(); ++k) {
            const Parameter& p = sweep.space[k];
            levels.push_back(sweep.input.design == "grid" ? levels_of(p) : std::vector<double>{p.low, p.high});
        }
        check_decks(sweep.space, sweep.tests, levels, file, problems);
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    if (sweep.input.title.empty()) {
        sweep.input.title = std::filesystem::path(file).stem().string();
    }
    lay_out(sweep);
    return sweep;
}

std::vector<Trial> trials_of(const Sweep& sweep) {
    std::vector<Trial> out;
    for (const auto& values : sweep.values) {
        Trial trial;
        trial.values = values;
        for (const auto& test : sweep.tests) {
            for (const auto seed : test.seeds.empty() ? std::vector<std::int64_t>{0} : test.seeds) {
                trial.jobs.push_back(job_for(test, seed, 1.0, sweep.space, values));
            }
        }
        out.push_back(keyed(std::move(trial)));
    }
    return out;
}

Json resolved(const Sweep& sweep) {
    Json json = input::write(sweep.input);
    for (const auto& key : unused_keys(sweep.input.design)) {
        json.erase(key);
    }
    for (auto& parameter : json["parameters"]) {
        if (parameter["values"].empty()) {
            parameter.erase("values");
        }
        if (sweep.input.design != "grid") {
            parameter.erase("levels");
        }
    }
    if (!sweep.results.empty()) {
        json["results"] = sweep.results;
    }
    for (const auto& test : sweep.tests) {
        Json entry{{"name", test.name}, {"deck", test.deck}};
        if (!test.seeds.empty()) {
            entry["seeds"] = test.seeds;
        }
        json["tests"].push_back(std::move(entry));
    }
    return json;
}

Json sweep_schema() {
    Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Proveta sweep"}};
    out.update(input::schema(SweepInput{}));
    add_tests_to_schema(out);
    out["properties"]["results"] = {
        {"description", "names of the results that the table has; all by default"}, {"type", "array"}, {"items", {{"type", "string"}}}};
    return out;
}

} // namespace proveta
