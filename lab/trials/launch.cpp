#include "lab/trials/launch.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "reports/files.hpp"

namespace proveta {

namespace fs = std::filesystem;

namespace {

// One array task a trial. The folder is given by the script's own place, which a scheduler's copy of it has lost: hence the fixed path.
constexpr const char* slurm_script = R"(#!/bin/bash
# Carries out the trials of trials.txt: sbatch --array=1-{last} slurm.sh
#SBATCH --job-name=proveta
#SBATCH --output=slurm-%A_%a.log
#SBATCH --cpus-per-task=1
set -e
folder={folder}
cd "${{PROVETA_FOLDER:-$folder}}"
trial=$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" trials.txt)
exec "${{PROVETA:-proveta}}" trial "$trial" --threads "${{SLURM_CPUS_PER_TASK:-1}}"
)";

constexpr const char* mpi_script = R"(#!/bin/bash
# Carries out the trials of trials.txt by N processes (default: one a processor): [N=64] ./mpi.sh [options of mpirun]
set -e
folder={folder}
cd "${{PROVETA_FOLDER:-$folder}}"
exec mpirun -n "${{N:-$(nproc)}}" "$@" "${{PROVETA:-proveta}}" trial --list trials.txt --share --threads 1
)";

// A text as a shell's word: whatever is in it, it is nothing but text.
std::string quoted_word(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return out + "'";
}

void write_script(const fs::path& file, const std::string& text) {
    report::write_file(file.string(), text);
    fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
}

} // namespace

std::string write_plan(const fs::path& out, const std::vector<std::string>& folders) {
    std::string list;
    for (const auto& folder : folders) {
        list += folder + "\n";
    }
    report::write_file((out / "trials.txt").string(), list);
    const std::string here = quoted_word(fs::absolute(out).lexically_normal().string());
    write_script(out / "slurm.sh", fmt::format(fmt::runtime(slurm_script), fmt::arg("last", folders.size()), fmt::arg("folder", here)));
    write_script(out / "mpi.sh", fmt::format(fmt::runtime(mpi_script), fmt::arg("folder", here)));
    return fmt::format("{} trials planned in {}/trials.txt; carry them out by\n"
                       "    sbatch --array=1-{} {}/slurm.sh\n"
                       "    {}/mpi.sh\n"
                       "    proveta trial --list {}/trials.txt\n"
                       "and then go on with --collect\n",
                       folders.size(), out.string(), folders.size(), out.string(), out.string(), out.string());
}

Share share_of_launcher() {
    constexpr const char* variables[][2] = {
        {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}, {"SLURM_PROCID", "SLURM_NTASKS"}};
    for (const auto& [rank, size] : variables) {
        const char* r = std::getenv(rank);
        const char* n = std::getenv(size);
        if (r != nullptr && n != nullptr && std::atoi(n) > 0 && std::atoi(r) >= 0 && std::atoi(r) < std::atoi(n)) {
            return {static_cast<std::size_t>(std::atoi(r)), static_cast<std::size_t>(std::atoi(n))};
        }
    }
    return {};
}

} // namespace proveta
