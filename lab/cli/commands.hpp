// The program's commands. Each adds itself to the command line and sets `run` when it is chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "lab/exit_codes.hpp"
#include "lab/run.hpp"
#include "lab/trials/book.hpp"

namespace proveta {

/// What the chosen command does; returns the exit code.
using Command = std::function<int()>;

void add_run(CLI::App& app, const std::string& typed, Command& chosen);
void add_resume(CLI::App& app, const std::string& typed, Command& chosen);
void add_report(CLI::App& app, const std::string& typed, Command& chosen);
void add_compare(CLI::App& app, const std::string& typed, Command& chosen);
void add_plot(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, const std::string& typed, Command& chosen);
void add_describe(CLI::App& app, Command& chosen);
void add_schema(CLI::App& app, Command& chosen);
void add_specimen(CLI::App& app, Command& chosen);
void add_elastic(CLI::App& app, Command& chosen);
void add_study(CLI::App& app, const std::string& typed, Command& chosen);
void add_calibrate(CLI::App& app, const std::string& typed, Command& chosen);
void add_sweep(CLI::App& app, const std::string& typed, Command& chosen);
void add_trial(CLI::App& app, Command& chosen);
void add_scene(CLI::App& app, const std::string& typed, Command& chosen);
void add_verify(CLI::App& app, Command& chosen);
void add_bench(CLI::App& app, Command& chosen);

/// Options that all commands share which run tests.
struct RunArguments {
    std::vector<std::string> settings;
    std::string out;
    int threads = 0;
    bool quiet = false;
    bool check = false; ///< only say what can be told before anything runs
};

/// Looks at one thing after the other, so that the problems of all of them are said at once.
class Looks {
  public:
    /// Whether nothing is wrong with what `look` looks at.
    template <class Look> bool at(const Look& look) {
        try {
            look();
            return true;
        } catch (const input::InputError& error) {
            problems_.insert(problems_.end(), error.problems.begin(), error.problems.end());
            return false;
        }
    }
    /// At a folder that the user named for the results; leaves nothing there.
    void at_folder(const std::string& out);
    [[nodiscard]] bool good() const { return problems_.empty(); }
    /// Throws InputError with all problems, if there are any.
    void settle() const;

  private:
    input::Problems problems_;
};

/// Adds --threads.
void add_threads(CLI::App& command, RunArguments& a);

/// Adds --set and --threads.
void add_settings(CLI::App& command, RunArguments& a);

/// Adds --out, --quiet and --check. folder: what the help says of the default of --out.
void add_output(CLI::App& command, RunArguments& a, const std::string& folder);

/// Arguments of the commands whose trials go through a ledger.
struct TrialsArguments : RunArguments {
    std::string file;
    bool status = false;
    bool plan = false;
    bool collect = false;
    bool report = false; ///< all of it is there: only what is written at the end is written anew

    /// Whether the tests are about to be carried out, here or elsewhere.
    [[nodiscard]] bool begins() const { return !status && !collect && !report; }
    [[nodiscard]] BookMode mode() const { return report ? BookMode::report : plan || collect ? BookMode::plan : BookMode::run; }
};

/// Adds the file (what it is called, "sweep"), --threads, --out, --quiet, --status, --plan and --collect.
void add_trials(CLI::App& command, TrialsArguments& a, const std::string& what, const std::string& folder);

/// A scene's file and options.
struct SceneArguments : RunArguments {
    std::string file;
};

/// Plays a scene and returns the exit code.
int play(const SceneArguments& a, const std::string& typed);
/// Carries a sweep out and returns the exit code.
int carry_out_sweep(const TrialsArguments& a, const std::string& typed);
/// Carries a calibration out and returns the exit code.
int carry_out_calibration(const TrialsArguments& a, const std::string& typed);

/// Takes the number of threads over, if one is given.
void use_threads(int threads);

/// The exit code of a run that ended so.
int exit_code(RunStatus status);

/// The exit code of work that a signal ended early.
int exit_interrupted();

} // namespace proveta
