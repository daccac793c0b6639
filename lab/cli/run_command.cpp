// proveta run, proveta check
#include <fmt/format.h>
#include <omp.h>

#include <filesystem>
#include <memory>

#include "lab/bench.hpp"
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
};

void add_deck_arguments(CLI::App& command, DeckArguments& a) {
    command.add_option("deck", a.decks, "deck (JSON), or the manifest.json of an earlier run; several decks make a series")->required();
    add_settings(command, a);
    command.add_option("--seed", a.seed, "seed of the specimens' packing");
}

Plan prepare(const DeckArguments& a) {
    use_threads(a.threads);
    auto settings = a.settings;
    if (!a.seed.empty()) {
        settings.push_back("specimen.seed=" + a.seed);
    }
    return read_plan(a.decks, settings);
}

// Where a result goes that the user named no folder for: the deck's name, or its test's for a manifest.
std::string default_folder(const DeckArguments& a, const Plan& plan) {
    if (a.decks.size() > 1) {
        return "results/series";
    }
    return "results/" + result_name(a.decks.front(), plan.series ? "series" : plan.members.front().deck.test);
}

} // namespace

void add_run(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    auto* command = app.add_subcommand("run", "run the test of a deck, or a series of tests, and write its result folder");
    add_deck_arguments(*command, *a);
    add_output(*command, *a, "results/NAME of the deck");
    command->callback([a, typed, &chosen] {
        chosen = [a, typed] {
            const Plan plan = prepare(*a);
            const RunOptions options{a->out.empty() ? default_folder(*a, plan) : a->out, typed, a->quiet};
            catch_interrupts();
            return exit_code(plan.series ? run_series(plan, options, omp_get_max_threads(), study_of(plan))
                                         : run_test(plan.members.front().deck, options));
        };
    });
}

void add_check(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    auto* command = app.add_subcommand("check", "report all problems of decks without running them");
    add_deck_arguments(*command, *a);
    command->callback([a, &chosen] {
        chosen = [a] {
            const Plan plan = prepare(*a);
            for (const auto& [name, deck] : plan.members) {
                if (!deck.specimen.file.empty()) {
                    set_up(deck, obtain_specimen(deck.specimen, deck.folder, deck.source));
                }
            }
            if (!plan.series) {
                fmt::print("{}: no problems; a {} test\n", a->decks.front(), plan.members.front().deck.test);
                return 0;
            }
            fmt::print("no problems; a series of {}\n", plan.members.size());
            for (const auto& [name, deck] : plan.members) {
                fmt::print("    {:<32} {}\n", name, deck.test);
            }
            return 0;
        };
    });
}

} // namespace proveta
