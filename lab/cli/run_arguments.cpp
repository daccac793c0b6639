// What the commands that run tests share.
#include <omp.h>

#include "lab/cli/commands.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"

namespace proveta {

void add_threads(CLI::App& command, RunArguments& a) {
    command.add_option("--threads", a.threads, "number of threads, of all tests together; results do not depend on it")
        ->check(CLI::Range(1, 1024));
}

void add_settings(CLI::App& command, RunArguments& a) {
    command.add_option("--set", a.settings, "change a value of the deck: a.b=v (may be given several times)")->allow_extra_args(false);
    add_threads(command, a);
}

void add_output(CLI::App& command, RunArguments& a, const std::string& folder) {
    command.add_option("--out", a.out, "result folder (default: " + folder + ")");
    command.add_flag("--quiet", a.quiet, "no progress, no log but warnings and errors");
    command.add_flag("--check", a.check, "report all problems that can be told without running anything");
}

void Looks::at_folder(const std::string& out) {
    if (!out.empty()) {
        at([&] { OutputFolder look(out); });
    }
}

void Looks::settle() const {
    if (!problems_.empty()) {
        throw input::InputError(problems_);
    }
}

void add_trials(CLI::App& command, TrialsArguments& a, const std::string& what, const std::string& folder) {
    command.add_option("file", a.file, what + " (JSON), or the manifest.json of an earlier one")->required();
    add_threads(command, a);
    add_output(command, a, folder);
    auto* status = command.add_flag("--status", a.status, "say how far it is and change nothing; may be asked while it runs");
    auto* plan = command.add_flag("--plan", a.plan, "carry nothing out here: write the next trials, and scripts that do it elsewhere");
    auto* collect =
        command.add_flag("--collect", a.collect, "take in what was carried out elsewhere; when all is there, results and report");
    auto* check = command.get_option("--check");
    check->excludes(status)->excludes(plan)->excludes(collect);
    status->excludes(plan)->excludes(collect);
    plan->excludes(collect);
}

void use_threads(int threads) {
    if (threads > 0) {
        omp_set_num_threads(threads);
    }
}

int exit_interrupted() { return exit_signal + interrupt_signal(); }

int exit_code(RunStatus status) {
    switch (status) {
    case RunStatus::complete: return 0;
    case RunStatus::interrupted: return exit_interrupted();
    case RunStatus::failed: break;
    }
    return exit_calculation;
}

} // namespace proveta
