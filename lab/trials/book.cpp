#include "lab/trials/book.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <omp.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "core/files/whole_file.hpp"
#include "lab/series/workers.hpp"
#include "lab/trials/pool.hpp"
#include "specimens/memory.hpp"

namespace proveta {

namespace fs = std::filesystem;
using input::Json;

namespace {

constexpr const char* ledger_name = "ledger.jsonl";

Json to_json(const TrialResult& result) {
    Json j{{"trial", result.key}, {"values", result.values}, {"jobs", Json::array()}};
    for (const auto& job : result.jobs) {
        j["jobs"].push_back(to_json(job));
    }
    return j;
}

// Whole lines of the ledger; good: bytes up to the end of the last of them.
std::vector<TrialResult> read_lines(const fs::path& file, std::size_t& good) {
    std::vector<TrialResult> out;
    std::ifstream in(file, std::ios::binary);
    std::string line;
    good = 0;
    while (std::getline(in, line) && !in.eof()) {
        try {
            const Json json = Json::parse(line);
            TrialResult result{json.at("trial"), json.at("values"), {}};
            for (const auto& job : json.at("jobs")) {
                result.jobs.push_back(job_result(job));
            }
            out.push_back(std::move(result));
        } catch (const Json::exception&) {
            throw input::InputError({{file.string(), "", "a line that is no trial of this version: " + line.substr(0, 60),
                                      "a ledger of trials", "take a new folder"}});
        }
        good += line.size() + 1;
    }
    return out;
}

} // namespace

std::optional<double> TrialResult::mean(const std::string& test, const std::string& result) const {
    double sum = 0.0;
    int n = 0;
    for (const auto& job : jobs) {
        if (job.test == test) {
            const auto value = job.status == "complete" ? job.value(result) : std::nullopt;
            if (!value) {
                return std::nullopt;
            }
            sum += *value;
            ++n;
        }
    }
    return n > 0 ? std::optional(sum / n) : std::nullopt;
}

std::vector<TrialResult> TrialBook::read(const fs::path& out) {
    std::size_t good = 0;
    return read_lines(out / ledger_name, good);
}

TrialBook::TrialBook(fs::path out, BookMode mode, std::size_t threads, bool quiet, std::function<void()> look)
    : folders_(std::move(out), std::move(look)), mode_(mode),
      threads_(threads > 0 ? threads : static_cast<std::size_t>(omp_get_max_threads())), progress_(quiet) {
    const fs::path path = folders_.out() / ledger_name;
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    const auto refuse = [&](const std::string& found, const std::string& hint) {
        throw input::InputError({{path.string(), "", found, "a ledger that can be written", hint}});
    };
    if (file_ < 0) {
        refuse(std::string("cannot be opened: ") + std::strerror(errno), "");
    }
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
        close(file_);
        refuse("in use by another process", "wait for it, or take another --out");
    }
    try {
        std::size_t good = 0;
        for (auto& result : read_lines(path, good)) {
            failed_by_machine_.erase(result.key); // the last line of a trial counts
            for (const auto& job : result.jobs) {
                seconds_[job.name] = job.seconds;
                if (job.of_machine) {
                    failed_by_machine_.insert(result.key);
                }
            }
            known_.insert_or_assign(result.key, std::move(result));
        }
        if (ftruncate(file_, static_cast<off_t>(good)) != 0) { // half a line of a process that was killed
            refuse(std::string("cannot be cut: ") + std::strerror(errno), "");
        }
    } catch (...) {
        close(file_);
        throw;
    }
}

TrialBook::~TrialBook() { close(file_); }

void TrialBook::record(const TrialResult& result) {
    const std::string line = to_json(result).dump() + "\n";
    if (write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size()) || fsync(file_) != 0) {
        throw FileError((folders_.out() / ledger_name).string() + " cannot be written: " + std::strerror(errno));
    }
    known_.insert_or_assign(result.key, result);
}

// Takes a trial into the ledger whose jobs are all done.
bool TrialBook::complete(const Trial& trial) {
    TrialResult result{trial.key, trial.values, folders_.finished(trial.key)};
    if (result.jobs.size() < trial.jobs.size()) {
        return false;
    }
    record(result);
    return true;
}

void TrialBook::carry_out(const std::vector<Trial>& trials, const std::vector<std::size_t>& missing, const std::string& what) {
    struct Unit {
        std::size_t trial;
        std::string job;
        double spheres;
    };
    std::vector<Unit> units;
    std::vector<std::size_t> left(trials.size(), 0); // jobs that a trial still waits for
    for (const auto t : missing) {
        std::set<std::string> done;
        for (const auto& job : folders_.finished(trials[t].key)) {
            done.insert(job.name);
        }
        for (const auto& job : trials[t].jobs) {
            if (!done.contains(job.name)) {
                units.push_back({t, job.name, job.deck["specimen"].value("spheres", 13500.0)});
                ++left[t];
            }
        }
    }
    // The longest first, so that none is left over at the end. The order changes no result.
    std::stable_sort(units.begin(), units.end(), [&](const Unit& a, const Unit& b) {
        const auto cost = [&](const Unit& u) { return seconds_.contains(u.job) ? seconds_.at(u.job) : 1e6; };
        return cost(a) > cost(b);
    });
    double largest = 0.0;
    std::vector<ProcessCommand> commands;
    for (const auto& u : units) {
        largest = std::max(largest, u.spheres);
    }
    const std::size_t at_once =
        members_at_once(threads_, units.size(), memory_of_test(static_cast<std::size_t>(largest)), static_cast<double>(available_memory()));
    for (const auto& u : units) {
        const fs::path folder = folders_.trial(trials[u.trial].key);
        commands.push_back(
            {{"trial", folder.string(), "--job", u.job, "--threads", std::to_string(std::max<std::size_t>(threads_ / at_once, 1))},
             (folder / u.job / "log.txt").string()});
    }
    std::size_t done = 0;
    const auto ended = [&](std::size_t k, const ProcessFailure& failure) {
        const Trial& trial = trials[units[k].trial];
        const fs::path job = folders_.trial(trial.key) / units[k].job;
        if (!failure.reason.empty() && !result_in(job)) {
            write_failure(job, failure.reason, failure.killed);
        }
        ++done;
        if (--left[units[k].trial] == 0) {
            if (!complete(trial)) {
                throw std::runtime_error(
                    fmt::format("a job of {} ended without a result; see its log.txt", folders_.trial(trial.key).string()));
            }
            ++carried_out_;
            for (const auto& result : known_.at(trial.key).jobs) {
                seconds_[result.name] = result.seconds;
            }
        }
    };
    const auto tick = [&] { progress_.show(fmt::format("{}: {} of {} tests done, {} at once", what, done, units.size(), at_once)); };
    if (!run_processes(commands, at_once, ended, tick)) {
        progress_.end_line();
        throw TrialsInterrupted();
    }
    progress_.end_line();
}

bool of_this_physics(const TrialResult& result) {
    return std::all_of(result.jobs.begin(), result.jobs.end(), [](const JobResult& job) { return job.physics == physics_revision(); });
}

std::size_t TrialBook::known() const {
    return static_cast<std::size_t>(
        std::count_if(known_.begin(), known_.end(), [](const auto& entry) { return of_this_physics(entry.second); }));
}

std::size_t TrialBook::known(const std::vector<Trial>& keyed) const {
    return static_cast<std::size_t>(std::count_if(keyed.begin(), keyed.end(), [&](const Trial& trial) { return holds(trial.key); }));
}

std::string TrialBook::of_other_physics() const {
    std::set<std::string> others;
    for (const auto& [key, result] : known_) {
        for (const auto& job : result.jobs) {
            if (job.physics != physics_revision()) {
                others.insert(job.physics.empty() ? "a version without physics revision" : "physics " + job.physics);
            }
        }
    }
    const std::size_t n = known_.size() - known();
    return others.empty()
               ? ""
               : fmt::format("{} in the ledger computed by {}, while this program is physics {}: none is taken, and what is asked "
                             "for is computed again",
                             n == 1 ? "1 trial" : fmt::format("{} trials", n), fmt::join(others, " and "), physics_revision());
}

// A trial of this physics that has ended, and whose curves nobody has taken away.
bool TrialBook::holds(const std::string& key) const {
    const auto found = known_.find(key);
    const auto whole = [&](const JobResult& job) {
        return job.physics == physics_revision() && has_all_of(job, folders_.trial(key) / job.name);
    };
    return found != known_.end() && (mode_ != BookMode::run || !failed_by_machine_.contains(key)) &&
           std::all_of(found->second.jobs.begin(), found->second.jobs.end(), whole);
}

// Takes the results of jobs away that the machine made fail, once, where they are carried out anew.
void TrialBook::forget_failures(const std::string& key) {
    if (mode_ != BookMode::run || failed_by_machine_.erase(key) == 0) {
        return;
    }
    for (const auto& job : known_.at(key).jobs) {
        if (job.of_machine) {
            std::error_code gone;
            fs::remove(folders_.trial(key) / job.name / "result.json", gone);
        }
    }
}

std::vector<TrialResult> TrialBook::evaluate(std::vector<Trial> trials, const std::string& what) {
    std::vector<std::size_t> missing;
    std::set<std::string> asked;
    for (std::size_t k = 0; k < trials.size(); ++k) {
        trials[k] = keyed(std::move(trials[k]));
        if (holds(trials[k].key) || !asked.insert(trials[k].key).second) {
            continue;
        }
        if (mode_ == BookMode::report) {
            missing.push_back(k);
            continue;
        }
        forget_failures(trials[k].key);
        progress_.show(fmt::format("{}: making specimens", what));
        if (!folders_.write(trials[k])) {
            progress_.end_line();
            throw TrialsInterrupted();
        }
        if (!complete(trials[k])) {
            missing.push_back(k);
        }
    }
    if (!missing.empty() && mode_ == BookMode::report) {
        throw input::InputError(
            {{folders_.out().string(), "",
              fmt::format("{} of {} trials not there, of another physics, or without their curves", missing.size(), asked.size()),
              "a folder with all of them, of this program's physics", "proveta resume carries them out"}});
    }
    if (!missing.empty() && mode_ == BookMode::plan) {
        std::vector<std::string> folders;
        for (const auto k : missing) {
            folders.push_back("trials/" + trials[k].key);
        }
        throw TrialsPlanned(std::move(folders));
    }
    if (!missing.empty()) {
        carry_out(trials, missing, what);
    }
    std::vector<TrialResult> out;
    for (const auto& trial : trials) {
        out.push_back(known_.at(trial.key));
        out.back().values = trial.values;
    }
    return out;
}

} // namespace proveta
