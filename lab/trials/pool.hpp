// Processes: some commands, several at once.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace proveta {

/// How a command failed.
struct ProcessFailure {
    std::string reason;  ///< "" for exit code 0
    bool killed = false; ///< by SIGKILL: by a user, or by a system that is short of memory
};

/// A command to be run.
struct ProcessCommand {
    std::vector<std::string> arguments; ///< of this program, without its own name
    std::string log;                    ///< file for what it prints
};

/// Runs commands of this program as processes of their own, at most `at_once` at a time, in the given order. They end with this process,
/// however that ends. ended is told, in the order of ending, the index and how it failed. tick is called a few times a
/// second. Returns false on an interrupt, of this process or of one of those, after the running ones have been asked to stop and have
/// stopped. Throws FileError when one could not write its files.
bool run_processes(const std::vector<ProcessCommand>& commands, std::size_t at_once,
                   const std::function<void(std::size_t, const ProcessFailure&)>& ended, const std::function<void()>& tick);

} // namespace proveta
