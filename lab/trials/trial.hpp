// A trial: some tests with one set of parameters, in a folder of its own, which a command carries out.
//
//     OUT/specimens/KEY.h5           specimens, shared by all trials
//     OUT/trials/KEY/trial.json      names of the jobs, values of the parameters
//     OUT/trials/KEY/JOB/deck.json   a deck like any other
//     OUT/trials/KEY/JOB/result.json written last: a job that has one is done
//     OUT/trials/KEY/JOB/curve.csv
//
// Keys are hashes of what is asked, so that the same question finds its earlier answer.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "lab/revision.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// One test on one specimen.
struct Job {
    std::string name; ///< of its folder: test, or test_seed_N
    std::string test; ///< of `TrialTest`
    input::Json deck; ///< resolved
};

/// What is asked: the jobs of one set of parameters.
struct Trial {
    std::vector<double> values; ///< own values of the parameters
    std::vector<Job> jobs;
    std::string key; ///< set by `keyed`
};

/// What a job came to.
struct JobResult {
    std::string name, test;
    std::string status;                    ///< complete or failed
    std::string reason;                    ///< why the test ended, or what failed
    std::map<std::string, double> results; ///< those that could be determined
    bool quasi_static = false;
    double sense = 1.0;                            ///< of the test: 1 where compression is positive, -1 where tension is
    double seconds = 0.0;                          ///< wall time on its threads
    std::map<std::string, std::string> units = {}; ///< SI units of the results that have one
    bool of_machine = false;                       ///< failed by the machine and not by itself: no memory, or killed
    std::string verdict = {};                      ///< of quasi-static loading, in words
    std::optional<double> rate_difference = {};    ///< of the peak from that at half the rate, where the deck asks for that check
    std::string physics = {};                      ///< revision of the program that carried it out

    [[nodiscard]] std::optional<double> value(const std::string& result) const {
        const auto found = results.find(result);
        return found == results.end() ? std::nullopt : std::optional(found->second);
    }
};

input::Json to_json(const JobResult& result);
JobResult job_result(const input::Json& json);

/// The trial with its key. The physics revision, decks and the bytes of stored specimens count.
Trial keyed(Trial trial, const std::string& physics = physics_revision());

/// Name of the file of the specimen that a recipe makes, without its ending. The physics revision and the recipe count.
std::string specimen_key(const input::Json& recipe, const std::string& physics = physics_revision());

/// Where trials live.
class TrialFolders {
  public:
    /// look: is called before anything is written, and throws where that may not be; may be empty.
    explicit TrialFolders(std::filesystem::path out, std::function<void()> look = nullptr) : out_(std::move(out)), look_(std::move(look)) {}

    [[nodiscard]] std::filesystem::path trial(const std::string& key) const { return out_ / "trials" / key; }
    [[nodiscard]] const std::filesystem::path& out() const { return out_; }

    /// Writes the folder of a trial, and the specimens it needs that are not there yet. Deck and specimen are checked against each other
    /// only when the job runs; a specimen that cannot be made is left to the job too, whose result says why. Returns false on an
    /// interrupt, which leaves it unfinished.
    [[nodiscard]] bool write(const Trial& trial) const;
    /// The jobs of a trial that are done, in its order.
    [[nodiscard]] std::vector<JobResult> finished(const std::string& key) const;

  private:
    void make_specimen(const input::Json& deck, const std::filesystem::path& file) const;
    void look() const;

    std::filesystem::path out_;
    std::function<void()> look_;
};

/// Whether a job's folder has what its result speaks of: the curve of one that is complete.
bool has_all_of(const JobResult& result, const std::filesystem::path& job);

/// The result of a job's folder; nothing where there is none, one of another physics or kind, or one without its curve.
std::optional<JobResult> result_in(const std::filesystem::path& job);

/// Carries out one job of a trial's folder, whatever went before, and writes its result. What fails is a result too. Returns false on an
/// interrupt, which leaves none.
bool run_job(const std::filesystem::path& folder);

/// Names of the jobs of a trial's folder. Throws InputError when it is none.
std::vector<std::string> jobs_of(const std::filesystem::path& trial);

/// Throws InputError for a trial that a program of another physics planned: its answer would not be the one asked for.
void refuse_other_physics(const std::filesystem::path& trial);

/// Puts a failure in the place of a job's result. of_machine: see `JobResult`.
void write_failure(const std::filesystem::path& job, const std::string& reason, bool of_machine);

/// The curve of a job that is done.
report::Table job_curve(const std::filesystem::path& job);

} // namespace proveta
