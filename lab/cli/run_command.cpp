// proveta run, proveta check
#include <fmt/format.h>
#include <omp.h>

#include <filesystem>
#include <memory>

#include "lab/bench.hpp"
#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/run.hpp"

namespace proveta {

namespace {

struct DeckArguments {
    std::string deck;
    std::vector<std::string> settings;
    std::string out;
    int threads = 0;
    std::string seed;
    bool quiet = false;
};

void add_deck_arguments(CLI::App& command, DeckArguments& a) {
    command.add_option("deck", a.deck, "deck (JSON), or the manifest.json of an earlier run")->required();
    command.add_option("--set", a.settings, "change a value of the deck: a.b=v (may be given several times)");
    command.add_option("--threads", a.threads, "number of threads; results do not depend on it")->check(CLI::Range(1, 1024));
    command.add_option("--seed", a.seed, "seed of the specimen's packing");
}

Deck prepare(const DeckArguments& a) {
    if (a.threads > 0) {
        omp_set_num_threads(a.threads);
    }
    auto json = input::load_json(a.deck);
    std::string expected;
    auto settings = a.settings;
    if (json.contains("proveta_manifest")) {
        const bool unchanged = settings.empty() && a.seed.empty();
        expected = unchanged && json.contains("specimen_hash") && json["specimen_hash"].is_string()
                       ? json["specimen_hash"].get<std::string>()
                       : "";
        json = json.contains("deck") ? input::Json(json["deck"]) : input::Json::object();
    }
    if (!a.seed.empty()) {
        settings.push_back("specimen.seed=" + a.seed);
    }
    apply_settings(json, settings);
    Deck deck = read_deck(json, a.deck);
    deck.expected_specimen = expected;
    return deck;
}

} // namespace

void add_run(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    auto* command = app.add_subcommand("run", "run the test of a deck and write its result folder");
    add_deck_arguments(*command, *a);
    command->add_option("--out", a->out, "result folder (default: results/NAME of the deck)");
    command->add_flag("--quiet", a->quiet, "no progress, no log but warnings and errors");
    command->callback([a, typed, &chosen] {
        chosen = [a, typed] {
            const Deck deck = prepare(*a);
            const auto stem = std::filesystem::path(a->deck).stem().string();
            const std::string out = a->out.empty() ? "results/" + (stem == "manifest" ? deck.test : stem) : a->out;
            catch_interrupts();
            switch (run_test(deck, {out, typed, a->quiet})) {
            case RunStatus::complete: return 0;
            case RunStatus::interrupted: return exit_interrupted;
            case RunStatus::failed: break;
            }
            return exit_calculation;
        };
    });
}

void add_check(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<DeckArguments>();
    auto* command = app.add_subcommand("check", "report all problems of a deck without running it");
    add_deck_arguments(*command, *a);
    command->callback([a, &chosen] {
        chosen = [a] {
            const Deck deck = prepare(*a);
            if (!deck.specimen.file.empty()) {
                set_up(deck, obtain_specimen(deck.specimen, deck.folder, deck.source));
            }
            fmt::print("{}: no problems; a {} test\n", a->deck, deck.test);
            return 0;
        };
    });
}

} // namespace proveta
