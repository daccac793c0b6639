// proveta bench
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <memory>

#include "core/files/whole_file.hpp"
#include "core/parallel/instruction_set.hpp"
#include "lab/benchmark.hpp"
#include "lab/cli/commands.hpp"
#include "lab/provenance.hpp"
#include "reports/files.hpp"

namespace proveta {

namespace {

struct BenchArguments {
    std::string card = "concrete_sfer";
    std::string specimen;
    std::vector<int> sizes{1000, 4000, 13500, 100000};
    benchmark::Plan plan;
    std::string json;
};

// The default test on a packing of its own or on a stored one.
Deck deck_for(const BenchArguments& a, int spheres) {
    input::Json deck = {{"test", "ucs"}, {"material", {{"card", a.card}}}};
    if (a.specimen.empty()) {
        deck["specimen"]["spheres"] = spheres;
    } else {
        deck["specimen"]["file"] = a.specimen;
    }
    return read_deck(deck, "bench");
}

double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

int bench(const BenchArguments& a) {
    if (!a.json.empty()) {
        require_writable(a.json);
    }
    const auto sizes = a.specimen.empty() ? a.sizes : std::vector<int>{0};
    fmt::print("# {} {}, {}, vector kernel {}\n", "proveta", version(), PROVETA_COMPILER, instruction_set_name());
    input::Json out = {{"program", version()}, {"compiler", PROVETA_COMPILER}, {"vector_kernel", instruction_set_name()}};
    for (const int size : sizes) {
        const Deck deck = deck_for(a, size);
        const auto start = std::chrono::steady_clock::now();
        Bench specimen = set_up(deck, obtain_specimen(deck.specimen, deck.folder, deck.source));
        const double made = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        fmt::print("# {} spheres, {} bonds, interaction range {:.6f}, ready after {:.1f} s, peak memory so far {:.2f} GB\n",
                   specimen.model->spheres.size(), specimen.model->bonds.size(), 1.0 + specimen.beta, made, 1e-9 * peak_memory());
        std::fflush(stdout);
        for (const auto& f : benchmark::measure(specimen, a.plan, [](const benchmark::Figures& figures) {
                 fmt::print("{}\n", benchmark::as_line(figures));
                 std::fflush(stdout);
             })) {
            auto json = benchmark::as_json(f);
            json["seconds_to_make"] = made;
            json["peak_memory_bytes"] = peak_memory();
            out["measurements"].push_back(json);
        }
    }
    if (!a.json.empty()) {
        report::write_file(a.json, out.dump(2) + "\n");
    }
    return 0;
}

} // namespace

void add_bench(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<BenchArguments>();
    auto* command = app.add_subcommand("bench", "measure how fast this machine steps specimens");
    command->add_option("--specimen", a->specimen, "measure a stored specimen instead of packings of the default recipe");
    command->add_option("--card", a->card, "material card, whose bond law is what is measured")->capture_default_str();
    command->add_option("--sizes", a->sizes, "numbers of spheres of the packings")->delimiter(',')->check(CLI::Range(100, 20000000));
    command->add_option("--threads", a->plan.threads, "thread counts, measured in turn")->delimiter(',')->check(CLI::Range(1, 1024));
    command->add_option("--repeats", a->plan.repeats, "repeats of every measurement; medians are shown")->check(CLI::Range(1, 1000));
    command->add_option("--seconds", a->plan.seconds, "length of one measurement")->check(CLI::Range(0.001, 600.0));
    command->add_option("--json", a->json, "file for the figures as JSON");
    command->callback([a, &chosen] { chosen = [a] { return bench(*a); }; });
}

} // namespace proveta
