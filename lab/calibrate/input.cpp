#include "lab/calibrate/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/input/suggest.hpp"
#include "core/input/text_file.hpp"
#include "core/input/units.hpp"
#include "lab/calibrate/residuals.hpp"
#include "lab/calibrate/target_check.hpp"
#include "lab/provenance.hpp"
#include "lab/results.hpp"
#include "lab/trials/decks.hpp"

namespace proveta {

using input::above;
using input::Json;
using input::Unit;

void declare(input::Visitor& v, TargetInput& t) {
    v.text("test", t.test, "name of the test");
    v.choice("use", t.use, {{"fit", "the card is fitted to it"}, {"predict", "left out of the fit and predicted at the end"}},
             "what it is there for");
    v.choice("kind", t.kind,
             {{"measured", "a measurement"}, {"estimate", "an estimate, such as an empirical envelope"}, {"computed", "a calculation"}},
             "what it is");
    v.text("source", t.source, "paper, laboratory or calculation that it comes from");
    v.number("weight", t.weight, Unit::none, above(0), "weight among the targets");
    v.number("tolerance", t.tolerance, Unit::none, above(0),
             "what may be missed: of a result relative to its value, of a curve the root mean square distance relative to the curve's own");
    v.text("result", t.result, "name of a result, as in summary.json");
    v.number("value", t.value, Unit::any, input::any_number(), "what the result should be");
    v.text("curve", t.curve, "CSV file of a measured curve, relative to this file; instead of result and value");
    const std::vector<input::Choice> strains{{"axial_strain", "of the platens"},
                                             {"gauge_strain", "of the middle gauge length"},
                                             {"circumferential_strain", "of the girth, positive when the specimen gets thinner"},
                                             {"volumetric_strain", "positive when it gets smaller"}};
    v.choice("x", t.x, strains, "what the curve runs over; since the axial loading began, in the sense of the test");
    auto quantities = strains;
    quantities.push_back({"total_stress", "total axial stress"});
    quantities.push_back({"deviatoric_stress", "axial minus lateral stress"});
    quantities.push_back({"", "not named, which a curve must not be"});
    v.choice("y", t.y, quantities, "what the curve shows; total and deviatoric stress differ by the confinement, so that it must be named");
    v.text("x_column", t.x_column, "column of the file by its heading, or by its number from 1 where there are no headings");
    v.text("y_column", t.y_column, "the same");
    v.number("x_factor", t.x_factor, Unit::none, input::any_number(), "makes the file's x a strain in the sense of the test: -1, 0.01");
    v.number("y_factor", t.y_factor, Unit::none, input::any_number(), "makes the file's y SI in the sense of the test: 1e6 for MPa");
    v.number("x_offset", t.x_offset, Unit::none, input::any_number(),
             "strain, after the factor, that is taken off: bedding before the specimen carried");
    v.choice("toe", t.toe,
             {{"as_measured", "the curve stays as it is"},
              {"removed", "the straight part from 10 % to 33 % of the peak, drawn on to zero, is where strain begins (ASTM D7012)"}},
             "what is done about the toe of the measured curve");
    v.number_or_word("from", t.from, {{"start", "the curve's first point"}}, Unit::none, input::any_number(), "first x that counts");
    v.number_or_word("to", t.to, {{"end", "the curve's last point"}}, Unit::none, input::any_number(), "last x that counts");
}

void declare(input::Visitor& v, SearchInput& s) {
    v.number("spheres", s.spheres, Unit::none, {0.0, 1.0, true, false},
             "spheres of the specimens that the search runs on, over those of the decks; stored and loose specimens stay whole");
    v.integer("seeds", s.seeds, 1, 100, "specimens of each test that the search runs on, the first of its seeds");
    v.integer("trials", s.trials, 1, 100000, "trials of the search");
    v.integer("batch", s.batch, 1, 1000,
              "trials that are chosen, and can be carried out, at a time; part of what makes a search repeatable");
    v.integer("seed", s.seed, 0, 1000000000, "seed of the search's random numbers, its start among them");
    v.choice("method", s.method,
             {{"mixed", "half of each batch by models of the single deviations from the targets, half by the global search"},
              {"global", "dlib's global function search alone"},
              {"models", "the models of the single deviations alone, after a random start"}},
             "how trials are chosen");
    v.number("good_enough", s.good_enough, Unit::none, input::at_least(0),
             "score, in tolerances, at which the search ends before its trials are used up");
}

void declare(input::Visitor& v, FinishInput& f) {
    v.integer(
        "rounds", f.rounds, 0, 100,
        "rounds with the decks' whole specimens and seeds, of which each corrects the search's small ones; 0: none, the search is all");
    v.integer("trials", f.trials, 1, 100000, "trials on small specimens between two rounds");
}

void declare(input::Visitor& v, ConfidenceInput& c) {
    v.integer("seeds", c.seeds, 0, 1000, "specimens of each test that the noise is measured with; 0: no statement of confidence");
    v.number("step", c.step, Unit::none, {0.0, 0.5, true, false},
             "step to both sides of the best, over the range of a parameter, for its profile");
}

void declare(input::Visitor& v, CardInput& c) {
    v.text("name", c.name, "name of the card that is written");
    v.text("about", c.about, "what it is a card of");
    v.choice("status", c.status, card_statuses(), "\"provisional\" until measured curves stand behind it");
}

void declare(input::Visitor& v, CalibrationInput& c) {
    v.text("title", c.title, "title of the report");
    v.list("parameters", c.parameters, "what may be varied");
    v.list("targets", c.targets, "what the tests should come to");
    v.section("search", c.search, "the search on small specimens");
    v.section("finish", c.finish, "the end of the search on whole specimens");
    v.section("confidence", c.confidence, "how sure the card is");
    v.section("card", c.card, "the card that is written");
}

namespace {

constexpr const char* manifest_mark = "proveta_calibration_manifest";

// A manifest is of a calibration to the curves that there were: others make another one.
void check_curves(const CalibrationPlan& plan, const std::vector<std::string>& curves, input::Problems& problems) {
    for (const auto& file : curves) {
        const std::string then = input::text_at(plan.curves, file.c_str());
        if (const std::string now = hash_of_file(file); !then.empty() && !now.empty() && now != then) {
            problems.push_back(
                {file, "", "another curve than the calibration began with, hash " + now, "that of hash " + then,
                 fmt::format("to calibrate to this one: proveta calibrate {} --out FOLDER; the trials of the same folder are "
                             "not carried out again",
                             plan.source)});
        }
    }
}

} // namespace

CalibrationPlan read_calibration(const std::string& file) {
    CalibrationPlan plan;
    plan.source = file;
    Json json = input::load_json(file);
    Json begun; // the manifest of a calibration that goes on, or is repeated
    if (json.is_object() && json.contains(manifest_mark)) {
        begun = std::move(json);
        json = begun.value("input", Json::object());
        if (const std::string input = input::text_at(begun, "input_file"); !input.empty()) {
            plan.source = input; // which names of files are relative to
        }
    }
    plan.written = json;
    input::Problems problems;
    plan.tests =
        take_tests(json, plan.source, problems, {true, begun.is_object(), begun.is_object() ? begun.value("decks", Json()) : Json()});
    input::read(json, plan.input, file, "", problems);
    check_units(json, plan.input.parameters, plan.tests, file, problems);
    refuse_levels(json, "a calibration looks anywhere between the bounds", file, problems);
    auto& in = plan.input;
    std::vector<Json> decks;
    for (const auto& test : plan.tests) {
        decks.push_back(test.deck);
    }
    if (in.parameters.empty()) {
        problems.push_back({file, "/parameters", "no parameters", "at least one", ""});
    }
    if (!decks.empty()) {
        plan.space = ParameterSpace(in.parameters, decks, file, problems);
    }
    std::vector<std::string> curves;
    std::vector<std::string> names; // also of tests whose decks are wrong
    for (const auto& test : plan.written.value("tests", Json::array())) {
        names.push_back(input::text_at(test, "name"));
    }
    for (std::size_t k = 0; k < in.targets.size(); ++k) {
        auto& t = in.targets[k];
        check_target(t, fmt::format("/targets/{}", k), names, file, problems);
        const auto same = [&](const TargetInput& other) { return !t.is_curve() && other.test == t.test && other.result == t.result; };
        if (const auto first = std::find_if(in.targets.begin(), in.targets.end(), same); first - in.targets.begin() < std::ptrdiff_t(k)) {
            problems.push_back({file, fmt::format("/targets/{}/result", k), fmt::format("{} of {} again", t.result, t.test),
                                "each result of a test once", "of several measurements take the mean, and their scatter as tolerance"});
        }
        check_result(t, plan.written["targets"][k], fmt::format("/targets/{}", k), plan.tests, file, problems);
        if (t.is_curve()) {
            t.curve = (std::filesystem::absolute(plan.source).parent_path() / t.curve).lexically_normal().string();
            try { // before its hash is taken, which would read all of it
                input::require_size(t.curve, input::longest_table);
                curves.push_back(t.curve);
            } catch (const std::runtime_error& e) {
                problems.push_back({file, fmt::format("/targets/{}/curve", k), e.what(), "a table of a measured curve", ""});
            }
        }
    }
    plan.files = begun.is_object() ? begun.value("files", Json::object()) : hashes_of(plan.tests);
    plan.curves = begun.is_object() ? begun.value("curves", Json::object()) : hashes_of(curves);
    check_curves(plan, curves, problems);
    if (std::none_of(in.targets.begin(), in.targets.end(), [](const TargetInput& t) { return t.fitted(); })) {
        problems.push_back({file, "/targets", "nothing to fit", "at least one target with \"use\": \"fit\"", ""});
    }
    if (problems.empty()) {
        std::vector<std::vector<double>> bounds;
        for (std::size_t k = 0; k < plan.space.size(); ++k) {
            bounds.push_back({plan.space[k].low, plan.space[k].high});
        }
        check_decks(plan.space, plan.tests, bounds, file, problems);
    }
    if (!problems.empty()) {
        try { // what is wrong with the curves belongs to the same list
            make_targets(plan);
        } catch (const input::InputError& error) {
            problems.insert(problems.end(), error.problems.begin(), error.problems.end());
        }
        throw input::InputError(problems);
    }
    return plan;
}

Json calibration_manifest(const CalibrationPlan& plan, const std::string& command, const std::string& status) {
    Json input = plan.written;
    input.erase("deck");
    Json decks = Json::object();
    for (std::size_t k = 0; k < plan.tests.size(); ++k) {
        input["tests"][k]["deck"] = plan.tests[k].written; // without a file, which may change
        decks[plan.tests[k].name] = plan.tests[k].deck;
    }
    Json j{{manifest_mark, 1}, {"status", status}};
    j.update(program_facts());
    j.update({{"command", command},
              {"input_file", std::filesystem::absolute(plan.source).lexically_normal().string()},
              {"files", plan.files},
              {"curves", plan.curves},
              {"input", input},
              {"decks", decks}});
    return j;
}

Json calibration_schema() {
    Json schema = input::schema(CalibrationInput{});
    add_tests_to_schema(schema);
    schema["required"].push_back("targets");
    return schema;
}

} // namespace proveta
