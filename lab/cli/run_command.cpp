// proveta run, proveta check
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/run.hpp"
#include "lab/series/plan.hpp"
#include "lab/series/run_series.hpp"
#include "lab/study/study.hpp"

namespace proveta {

namespace {

struct DeckArguments : RunArguments {
    std::vector<std::string> decks;
    std::string seed;

    [[nodiscard]] std::vector<std::string> all_settings() const {
        auto all = settings;
        if (!seed.empty()) {
            all.push_back("specimen.seed=" + seed);
        }
        return all;
    }
};

void add_deck_arguments(CLI::App& command, DeckArguments& a, const std::string& what) {
    command.add_option("deck", a.decks, what + ", or the manifest.json of an earlier run; several decks make a series")->required();
    add_settings(command, a);
    command.add_option("--seed", a.seed, "seed of the specimens' packing");
}

// Where a result goes that the user named no folder for: the deck's name, or its test's for a manifest.
std::string default_folder(const DeckArguments& a, const Plan& plan) {
    if (a.decks.size() > 1) {
        return "results/series";
    }
    return "results/" + result_name(a.decks.front(), plan.series ? "series" : plan.members.front().deck.test);
}

void print_checked(const DeckArguments& a, const Plan& plan) {
    if (!plan.series) {
        fmt::print("{}: no problems; a {} test\n", a.decks.front(), plan.members.front().deck.test);
        return;
    }
    fmt::print("no problems; a series of {}\n", plan.members.size());
    for (const auto& [name, deck] : plan.members) {
        fmt::print("    {:<32} {}\n", name, deck.test);
    }
}

// The command that a file is for: run, scene, sweep or calibrate.
std::string command_for(const input::Json& json) {
    const auto has = [&](const char* key) { return json.is_object() && json.contains(key); };
    return has("proveta_scene_manifest") || (has("scene") && !has("test"))                          ? "scene"
           : has("proveta_calibration_manifest") || has("targets")                                  ? "calibrate"
           : has("proveta_sweep_manifest") || (has("tests") || (has("parameters") && !has("test"))) ? "sweep"
                                                                                                    : "run";
}

// A file that is for another command is told so, and not read as a deck.
void refuse_others(const std::vector<std::string>& files) {
    input::Problems problems;
    for (const auto& file : files) {
        std::string command = "run";
        try {
            command = command_for(input::load_json(file));
        } catch (const input::InputError&) { // which is said where it is read
        }
        if (command != "run") {
            problems.push_back(
                {file, "", "a file for proveta " + command, "the deck of a test", fmt::format("proveta {} {}", command, file)});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

int run_decks(const DeckArguments& a, const std::string& typed) {
    use_threads(a.threads);
    Looks looks;
    Plan plan;
    const bool read = looks.at([&] {
        refuse_others(a.decks);
        plan = read_plan(a.decks, a.all_settings());
    });
    looks.at_folder(a.out);
    if (read && (a.check || !looks.good())) { // else the run says it first
        looks.at([&] { check_members(plan); });
    }
    looks.settle();
    if (a.check) {
        print_checked(a, plan);
        return 0;
    }
    const RunOptions options{a.out.empty() ? default_folder(a, plan) : a.out, typed, a.quiet};
    catch_interrupts();
    return exit_code(plan.series ? run_series(plan, options, omp_get_max_threads(), study_of(plan))
                                 : run_test(plan.members.front().deck, options));
}

// Whatever the file is for; only decks of `run` may be several.
int check_files(const DeckArguments& a, const std::string& typed) {
    const std::string command = a.decks.size() == 1 ? command_for(input::load_json(a.decks.front())) : "run";
    if (command == "run") {
        return run_decks(a, typed);
    }
    if (command == "scene") {
        SceneArguments scene;
        static_cast<RunArguments&>(scene) = a;
        scene.settings = a.all_settings();
        scene.file = a.decks.front();
        return play(scene, typed);
    }
    if (!a.all_settings().empty()) {
        throw input::InputError({{"--set", "", fmt::format("settings for {}", a.decks.front()), "none: it is for proveta " + command,
                                  "write them into its \"deck\""}});
    }
    TrialsArguments trials;
    static_cast<RunArguments&>(trials) = a;
    trials.file = a.decks.front();
    return command == "sweep" ? carry_out_sweep(trials, typed) : carry_out_calibration(trials, typed);
}

} // namespace

void add_run(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    auto* command = app.add_subcommand("run", "run the test of a deck, or a series of tests, and write its result folder");
    add_deck_arguments(*command, *a, "deck (JSON)");
    add_output(*command, *a, "results/NAME of the deck");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return run_decks(*a, typed); }; });
}

void add_check(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    a->check = true;
    auto* command = app.add_subcommand("check", "report all problems of decks, a scene, a sweep or a calibration without running them");
    add_deck_arguments(*command, *a, "deck, scene, sweep or calibration (JSON)");
    command->add_option("--out", a->out, "result folder that is looked at too");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return check_files(*a, typed); }; });
}

} // namespace proveta
