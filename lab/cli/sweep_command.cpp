// proveta sweep
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/sweep/run_sweep.hpp"
#include "lab/trials/decks.hpp"
#include "lab/trials/launch.hpp"

namespace proveta {

int carry_out_sweep(const TrialsArguments& a, const std::string& typed) {
    use_threads(a.threads);
    Looks looks;
    Sweep sweep;
    const bool read = looks.at([&] { sweep = read_sweep(a.file); });
    if (a.begins()) {
        looks.at_folder(a.out);
        if (read) {
            looks.at([&] { look_at_specimens(sweep.space, sweep.tests, a.file); });
        }
    }
    looks.settle();
    if (a.check) {
        fmt::print("{}: no problems; a sweep of {} points, {} tests each\n", a.file, sweep.points.size(), sweep.tests.size());
        return 0;
    }
    SweepOptions options{a.out, typed, a.threads, a.quiet, a.mode()};
    if (options.out.empty()) {
        options.out = fmt::format("results/{}-sweep", result_name(a.file, "manifest"));
    }
    if (a.status) {
        fmt::print("{}", sweep_status(sweep, options.out));
        return 0;
    }
    catch_interrupts();
    try {
        const RunStatus status = run_sweep(sweep, options);
        if (status == RunStatus::interrupted) {
            spdlog::warn("interrupted; what had ended is kept, the same command goes on");
        }
        return exit_code(status);
    } catch (const TrialsPlanned& planned) {
        if (a.plan) {
            fmt::print("{}", write_plan(options.out, planned.folders));
            return 0;
        }
        fmt::print("{} of {} points are missing; --status says what is done, --plan lists them anew\n", planned.folders.size(),
                   sweep.points.size());
        return exit_calculation;
    }
}

void add_sweep(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<TrialsArguments>();
    auto* command = app.add_subcommand("sweep", "tests at many points of a space of parameters: a table, and what depends on what");
    add_trials(*command, *a, "sweep", "results/NAME-sweep");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return carry_out_sweep(*a, typed); }; });
}

} // namespace proveta
