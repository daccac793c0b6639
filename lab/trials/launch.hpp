// Carrying planned trials out elsewhere: scripts for schedulers, and one process' share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace proveta {

/// Writes trials.txt (a folder a line) with slurm.sh and mpi.sh, which carry them out. Returns what to tell the user.
std::string write_plan(const std::filesystem::path& out, const std::vector<std::string>& folders);

/// The place of this process among those that an MPI launcher or Slurm's srun has started, by the variables they set.
struct Share {
    std::size_t rank = 0;
    std::size_t size = 1;
};
Share share_of_launcher();

} // namespace proveta
