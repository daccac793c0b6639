// proveta trial
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/trials/launch.hpp"
#include "lab/trials/trial.hpp"

namespace proveta {

namespace {

namespace fs = std::filesystem;

struct TrialArguments {
    std::string folder;
    std::string job;
    std::string list;
    bool share = false;
    int threads = 0;
};

// Folders of a list, relative to the list's own.
std::vector<fs::path> listed(const std::string& file) {
    std::ifstream in(file);
    if (!in) {
        throw input::InputError({{file, "", "cannot be read", "the trials.txt of a plan", ""}});
    }
    std::vector<fs::path> out;
    for (std::string line; std::getline(in, line);) {
        if (!line.empty()) {
            out.push_back(fs::absolute(file).parent_path() / line);
        }
    }
    return out;
}

int carry_out_trials(const TrialArguments& a) {
    use_threads(a.threads);
    if (a.folder.empty() == a.list.empty()) {
        throw input::InputError(
            {{"trial", "", a.folder.empty() ? "neither a folder nor --list" : "a folder and --list", "one of them", ""}});
    }
    const auto folders = a.list.empty() ? std::vector<fs::path>{a.folder} : listed(a.list);
    const Share share = a.share ? share_of_launcher() : Share{};
    catch_interrupts();
    for (std::size_t k = share.rank; k < folders.size(); k += share.size) {
        const auto names = jobs_of(folders[k]);
        refuse_other_physics(folders[k]);
        if (!a.job.empty() && std::find(names.begin(), names.end(), a.job) == names.end()) {
            throw input::InputError({{folders[k].string(), "", "no job \"" + a.job + "\"", "one of its trial.json", ""}});
        }
        for (const auto& name : a.job.empty() ? names : std::vector<std::string>{a.job}) {
            if (!result_in(folders[k] / name) && !run_job(folders[k] / name)) {
                spdlog::warn("interrupted; the job has no result and will be done again");
                return exit_interrupted();
            }
        }
    }
    return 0;
}

} // namespace

void add_trial(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<TrialArguments>();
    auto* command =
        app.add_subcommand("trial", "carry out planned trials of a sweep or a calibration; jobs that have a result stay as they are");
    command->add_option("folder", a->folder, "folder of a trial");
    command->add_option("--job", a->job, "only this job of it");
    command->add_option("--list", a->list, "trials.txt of a plan: all of its trials");
    command->add_flag("--share", a->share, "only every n-th of the list, by this process' rank under mpirun or srun");
    command->add_option("--threads", a->threads, "number of threads; results do not depend on it")->check(CLI::Range(1, 1024));
    command->callback([a, &chosen] { chosen = [a] { return carry_out_trials(*a); }; });
}

} // namespace proveta
