#include "lab/trials/pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>

#include "core/files/whole_file.hpp"
#include "lab/exit_codes.hpp"
#include "lab/progress.hpp"

namespace proveta {

namespace {

pid_t start(const ProcessCommand& command) {
    std::vector<std::string> words{"proveta"};
    words.insert(words.end(), command.arguments.begin(), command.arguments.end());
    std::vector<char*> argv;
    for (auto& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) {
        throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
    }
    if (pid > 0) {
        return pid;
    }
    // The child. It must not outlive its parent, nor take a terminal's Ctrl-C, which the parent passes on.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(127);
    }
    setpgid(0, 0);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGHUP, SIG_DFL);
    const int log = open(command.log.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    const int nothing = open("/dev/null", O_RDONLY);
    if (log < 0 || nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0) {
        _exit(exit_files);
    }
    execv("/proc/self/exe", argv.data());
    _exit(127);
}

// Told to stop, and no failure of what it did.
bool was_stopped(int status) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status) - exit_signal;
    return signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
}

ProcessFailure failure_of(int status) {
    if (WIFSIGNALED(status)) {
        return {fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status))), WTERMSIG(status) == SIGKILL};
    }
    return {WEXITSTATUS(status) == 0 ? "" : fmt::format("ended with exit code {}", WEXITSTATUS(status))};
}

} // namespace

bool run_processes(const std::vector<ProcessCommand>& commands, std::size_t at_once,
                   const std::function<void(std::size_t, const ProcessFailure&)>& ended, const std::function<void()>& tick) {
    std::map<pid_t, std::size_t> running;
    std::size_t next = 0;
    bool asked = false; // to stop
    const auto stop = [&] {
        if (!asked) {
            for (const auto& [pid, k] : running) {
                kill(pid, SIGTERM);
            }
        }
        asked = true;
    };
    while (!running.empty() || (next < commands.size() && !asked)) {
        while (!asked && next < commands.size() && running.size() < std::max<std::size_t>(at_once, 1)) {
            running.emplace(start(commands[next]), next);
            ++next;
        }
        if (interrupted()) {
            stop();
        }
        bool any = false;
        for (auto it = running.begin(); it != running.end();) {
            int status = 0;
            if (waitpid(it->first, &status, WNOHANG) != it->first) {
                ++it;
                continue;
            }
            const std::size_t k = it->second;
            it = running.erase(it);
            any = true;
            if (was_stopped(status)) {
                stop();
            }
            if (WIFEXITED(status) && WEXITSTATUS(status) == exit_files) {
                throw FileError("files of a test cannot be written; see " + commands[k].log);
            }
            if (!asked) {
                ended(k, failure_of(status));
            }
        }
        if (!any) {
            tick();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    return !asked;
}

} // namespace proveta
