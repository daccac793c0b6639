// The book of all trials: what was asked, what came of it. A trial is carried out once in its life.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lab/progress.hpp"
#include "lab/trials/trial.hpp"

namespace proveta {

/// A trial that has ended.
struct TrialResult {
    std::string key;
    std::vector<double> values;
    std::vector<JobResult> jobs; ///< in the order asked

    /// Mean of a result over the jobs of a test; none when any of them failed or lacks it.
    [[nodiscard]] std::optional<double> mean(const std::string& test, const std::string& result) const;

    /// Wall time of all jobs.
    [[nodiscard]] double seconds() const {
        double sum = 0.0;
        for (const auto& job : jobs) {
            sum += job.seconds;
        }
        return sum;
    }
};

/// Whether all of a trial was computed by this program's physics.
bool of_this_physics(const TrialResult& result);

/// What to do with trials that have not been carried out yet.
enum class BookMode {
    run,   ///< carry them out here, as processes
    plan,  ///< write their folders, and say which they are
    report ///< refuse: nothing is changed
};

/// Trials were planned and have to be carried out elsewhere before work can go on.
struct TrialsPlanned : std::runtime_error {
    explicit TrialsPlanned(std::vector<std::string> list) : std::runtime_error("trials planned"), folders(std::move(list)) {}
    std::vector<std::string> folders; ///< relative to the result folder
};

/// Work was interrupted; what had ended is in the book.
struct TrialsInterrupted : std::runtime_error {
    TrialsInterrupted() : std::runtime_error("interrupted") {}
};

/// Keeps `ledger.jsonl` of a folder: a line of JSON for each trial as it ends. Opening it reads what an earlier process left, up to a line
/// that it could not finish; a second process on the same folder is refused. Jobs that the machine made an earlier process fail are
/// carried out here once more when they are asked for.
class TrialBook {
  public:
    /// threads: of all trials together; 0: as OpenMP has. look: see `TrialFolders`. Throws InputError when the folder is in use or its
    /// ledger is another thing.
    TrialBook(std::filesystem::path out, BookMode mode, std::size_t threads, bool quiet, std::function<void()> look = nullptr);
    ~TrialBook();
    TrialBook(const TrialBook&) = delete;
    TrialBook& operator=(const TrialBook&) = delete;

    /// The results of trials, in their order: from the ledger, or carried out now. what: shown meanwhile. Throws TrialsPlanned or
    /// TrialsInterrupted, and InputError for missing ones that are not to be carried out.
    std::vector<TrialResult> evaluate(std::vector<Trial> trials, const std::string& what);

    /// Trials in the ledger, those of other questions included and those of another physics not.
    [[nodiscard]] std::size_t known() const;
    /// Of these trials, those that would be taken from the ledger.
    [[nodiscard]] std::size_t known(const std::vector<Trial>& keyed) const;
    /// A sentence on the trials in the ledger that another physics computed, which are not taken; empty where there are none.
    [[nodiscard]] std::string of_other_physics() const;
    /// Trials that this process has carried out.
    [[nodiscard]] std::size_t carried_out() const { return carried_out_; }
    [[nodiscard]] const TrialFolders& folders() const { return folders_; }

    /// Reads a ledger without opening it: the results in the order of ending.
    static std::vector<TrialResult> read(const std::filesystem::path& out);

  private:
    void record(const TrialResult& result);
    bool complete(const Trial& trial);
    [[nodiscard]] bool holds(const std::string& key) const;
    void forget_failures(const std::string& key);
    void carry_out(const std::vector<Trial>& trials, const std::vector<std::size_t>& missing, const std::string& what);

    TrialFolders folders_;
    BookMode mode_;
    std::size_t threads_;
    Progress progress_;
    int file_ = -1;
    std::map<std::string, TrialResult> known_;
    std::set<std::string> failed_by_machine_; // of those, as an earlier process left them
    std::map<std::string, double> seconds_;   ///< that a job of the name took lately
    std::size_t carried_out_ = 0;
};

} // namespace proveta
