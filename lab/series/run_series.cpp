#include "lab/series/run_series.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <thread>

#include "core/files/whole_file.hpp"
#include "lab/checks.hpp"
#include "lab/keeper.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/series/expand.hpp"
#include "lab/series/series_report.hpp"
#include "lab/series/workers.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "specimens/memory.hpp"

namespace proveta {

namespace {

// Where the members stand, on one line. Workers write to it.
class Board {
  public:
    Board(const Plan& plan, bool quiet) : plan_(plan), quiet_(quiet), progress_(quiet), state_(plan.members.size()) {}

    // A line while the members are made ready, by one thread.
    void preparing(const std::string& text) { progress_.show(text); }

    void show(std::size_t k, const std::string& phase, double done) {
        if (quiet_) {
            return;
        }
        const std::lock_guard lock(mutex_);
        state_[k] = fmt::format("{}{} {:.0f} %", plan_.members[k].name, phase == "loading" ? "" : " (" + phase + ")", 100.0 * done);
        std::string line = fmt::format("{} of {} done", ended_, state_.size());
        for (const auto& running : state_) {
            line += running.empty() ? "" : " | " + running;
        }
        progress_.show(line);
    }

    void ended(std::size_t k, const MemberResult& result) {
        const std::lock_guard lock(mutex_);
        state_[k].clear();
        ++ended_;
        progress_.end_line();
        if (result.status == "failed") {
            spdlog::error("{}: {}", plan_.members[k].name, result.stopped_by);
        } else if (!quiet_) {
            spdlog::info("{} ({}): {}", plan_.members[k].name, result.status, result.stopped_by);
        }
    }

    void log(const std::string& line) {
        progress_.end_line();
        if (!quiet_) {
            spdlog::info("{}", line);
        }
    }

  private:
    const Plan& plan_;
    bool quiet_;
    Progress progress_;
    std::mutex mutex_;
    std::vector<std::string> state_; // of running members
    std::size_t ended_ = 0;
};

// Specimens by member; those of one recipe are one.
struct Specimens {
    std::vector<std::shared_ptr<const Specimen>> of;
    std::vector<std::string> hashes;
    std::size_t largest = 0; // number of spheres
};

std::string origin_of(const Deck& deck) {
    const auto& recipe = deck.specimen;
    return recipe.file.empty() ? input::write(recipe).dump()
                               : std::filesystem::weakly_canonical(std::filesystem::path(deck.folder) / recipe.file).string();
}

// Warnings of members, each said once.
class Warnings {
  public:
    explicit Warnings(const Plan& plan) : single_(!plan.series) {}
    void say(const Member& member, const std::vector<std::string>& warnings) {
        for (const auto& warning : warnings) {
            if (said_.insert(warning).second) {
                spdlog::warn("{}{}", single_ ? "" : member.name + ": ", warning);
            }
        }
    }

  private:
    bool single_;
    std::set<std::string> said_;
};

// Each member's problems, merged, where there are any.
class MemberProblems {
  public:
    template <class Work> void of(const Work& work) {
        try {
            work();
        } catch (const input::InputError& error) {
            for (const auto& problem : error.problems) {
                problems_.push_back({problem, {}});
            }
        }
    }
    void settle() const {
        if (!problems_.empty()) {
            throw input::InputError(merged(problems_));
        }
    }

  private:
    std::vector<MemberProblem> problems_;
};

// Makes or loads the specimens and puts every member into its press once: what a deck and its specimen contradict is found before any of
// the tests begins, and takes a thousandth of their time. What can be told without making specimens comes first. An interrupt leaves the
// rest out. warn: of what the user should know.
Specimens make_ready(const Plan& plan, Board& board, bool warn) {
    Specimens out;
    std::map<std::string, std::shared_ptr<const Specimen>> made;
    MemberProblems problems;
    Warnings warnings(plan);
    out.of.resize(plan.members.size());
    out.hashes.resize(plan.members.size());
    const auto set_up_member = [&](std::size_t k) {
        const auto& [name, deck] = plan.members[k];
        auto& specimen = made[origin_of(deck)];
        if (!specimen) {
            const auto progress = [&, name = name](double done) {
                board.preparing(fmt::format("making the specimen of {}  {:.0f} %", name, 100.0 * done));
            };
            specimen = std::make_shared<const Specimen>(obtain_specimen(deck.specimen, deck.folder, deck.source, progress));
        }
        board.preparing("setting up " + name);
        const Bench bench = set_up(deck, *specimen);
        out.hashes[k] = hex(bench.specimen_hash);
        out.of[k] = specimen;
        out.largest = std::max(out.largest, specimen->size());
        if (warn) {
            warnings.say(plan.members[k], warnings_of_deck(deck));
            warnings.say(plan.members[k], warnings_in_press(bench, deck));
        }
    };
    const auto stored = [&](std::size_t k) { return !plan.members[k].deck.specimen.file.empty(); };
    for (std::size_t k = 0; k < plan.members.size() && !interrupted(); ++k) {
        problems.of([&] {
            if (stored(k)) {
                set_up_member(k);
            } else if (const auto known = check_before(plan.members[k].deck); warn) {
                warnings.say(plan.members[k], known);
            }
        });
    }
    problems.settle();
    for (std::size_t k = 0; k < plan.members.size() && !interrupted(); ++k) {
        if (!stored(k)) {
            problems.of([&] { set_up_member(k); });
        }
    }
    problems.settle();
    board.log(fmt::format("{} {} for {} tests", made.size(), made.size() == 1 ? "specimen" : "specimens", plan.members.size()));
    return out;
}

// The manifest of a member's folder; null where there is none.
input::Json manifest_in(const std::filesystem::path& folder) {
    const auto file = folder / "manifest.json";
    return std::filesystem::exists(file) ? input::load_json(file.string()) : input::Json();
}

std::string status_in(const std::filesystem::path& folder) { return input::text_at(manifest_in(folder), "status"); }

// Results of two physics make no statistics: members that another one has computed, or begun, are computed again, and that is said first.
std::vector<bool> of_other_physics(const Plan& plan, const OutputFolder& out, Passage passage) {
    std::vector<bool> again(plan.members.size(), false);
    for (std::size_t k = 0; k < plan.members.size() && passage != Passage::begin; ++k) {
        const auto there = manifest_in(out.path() / plan.members[k].name);
        if (const std::string other = there.is_object() ? other_physics(there) : ""; !other.empty()) {
            spdlog::warn("{} was computed by {}: {}", plan.members[k].name, other,
                         passage == Passage::go_on ? "it is computed again" : "what is reported is what that computed");
            again[k] = passage == Passage::go_on;
        }
    }
    return again;
}

MemberResult run_member(const Member& member, Specimen specimen, OutputFolder& folder, const RunOptions& options, const RunWatch& watch) {
    MemberResult result;
    result.member = &member;
    if (options.passage == Passage::report && !checkpoint_there((folder.path() / "checkpoint.h5").string())) {
        if (const std::string status = status_in(folder.path()); status.empty() || status == "running") {
            return result; // it was not run, or not as far as its first checkpoint
        }
    }
    try {
        Finished finished = carry_out(member.deck, std::move(specimen), folder, options.command, watch, options.passage);
        result.status = name(finished.status);
        result.stopped_by = finished.record.stopped_by;
        result.results = std::move(finished.record.results);
        result.badges = std::move(finished.record.badges);
        result.warnings = std::move(finished.record.warnings);
        result.curve = std::move(finished.curve);
        result.seconds = finished.seconds;
    } catch (const StoppedBefore&) { // it stays one that was not run
    } catch (const FileError& e) {
        result.status = "failed";
        result.stopped_by = e.what();
        result.unwritten = true;
    } catch (const input::InputError& e) {
        result.status = "failed";
        result.stopped_by = e.what();
        result.refused = e.problems;
    } catch (const std::bad_alloc&) {
        result.status = "failed";
        result.stopped_by = "not enough memory";
    } catch (const std::exception& e) {
        result.status = "failed";
        result.stopped_by = e.what();
    }
    return result;
}

// Members one after the other by each of the workers, in the order of the decks. again: those that do not go on from what is there.
std::vector<MemberResult> run_members(const Plan& plan, const Specimens& specimens, std::vector<std::unique_ptr<OutputFolder>>& folders,
                                      const std::vector<bool>& again, const RunOptions& options, std::size_t threads, Board& board) {
    const std::size_t n = plan.members.size();
    std::vector<MemberResult> results(n);
    for (std::size_t k = 0; k < n; ++k) {
        results[k].member = &plan.members[k];
    }
    const std::size_t workers = members_at_once(threads, n, memory_of_test(specimens.largest), static_cast<double>(available_memory()));
    board.log(fmt::format("{} at once on {} {}", workers, threads, threads == 1 ? "thread" : "threads"));
    std::atomic<std::size_t> next{0};
    const auto work = [&](std::size_t worker) {
        omp_set_num_threads(threads_of_worker(worker, workers, threads)); // of this worker's members only
        for (std::size_t k = next++; k < n && !interrupted(); k = next++) {
            const auto show = [&](const std::string& phase, const std::string&, double done) { board.show(k, phase, done); };
            RunOptions own = options;
            own.passage = again[k] ? Passage::begin : options.passage;
            results[k] = run_member(plan.members[k], *specimens.of[k], *folders[k], own,
                                    {show, [](const std::string&) {}, [](const std::string&) {}});
            board.ended(k, results[k]);
        }
    };
    {
        std::vector<std::jthread> team;
        for (std::size_t worker = 0; worker < workers; ++worker) {
            team.emplace_back(work, worker);
        }
    }
    return results;
}

} // namespace

namespace {

// Of members of which no report can be made.
void refuse_failed(const Plan& plan, const OutputFolder& out) {
    std::vector<input::Problem> problems;
    for (const auto& member : plan.members) {
        if (status_in(out.path() / member.name) == "failed") {
            problems.push_back({(out.path() / member.name).string(), "", "a calculation that failed", "one that was stopped or has ended",
                                "the pages tell of the failure, and its checkpoint is from before"});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

// Where a report was asked for, nothing is written of the whole unless all could be read, and written.
void refuse_unread(const std::vector<MemberResult>& members) {
    std::vector<input::Problem> problems;
    for (const auto& m : members) {
        if (m.unwritten) {
            throw FileError(m.member->name + ": " + m.stopped_by);
        }
        problems.insert(problems.end(), m.refused.begin(), m.refused.end());
        if (m.status == "failed" && m.refused.empty()) {
            throw std::runtime_error(m.member->name + ": " + m.stopped_by);
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

RunStatus carry_out_series(const Plan& plan, const RunOptions& options, int threads, const SeriesStudy& study, OutputFolder& out) {
    if (options.passage == Passage::report) {
        refuse_failed(plan, out);
    }
    std::vector<std::unique_ptr<OutputFolder>> folders;
    std::vector<std::string> names;
    for (const auto& member : plan.members) {
        names.push_back(member.name);
        folders.push_back(std::make_unique<OutputFolder>(out.path() / member.name));
    }
    const auto again = of_other_physics(plan, out, options.passage);
    const std::string started = now_utc();
    const std::string folder = out.path().string();
    Board board(plan, options.quiet);
    const Specimens specimens = make_ready(plan, board, options.passage == Passage::begin);
    const auto write_manifest = [&](const std::string& status) {
        auto sheet = series_manifest(plan, specimens.hashes, options.command, status, started, folder);
        out.write_manifest(options.passage == Passage::report ? with_beginning_of(out.file("manifest.json"), std::move(sheet)) : sheet);
    };
    options.passage == Passage::begin ? out.begin(names) : out.go_on();
    if (options.passage != Passage::report) {
        write_manifest("running");
    }
    auto members = run_members(plan, specimens, folders, again, options, static_cast<std::size_t>(std::max(threads, 1)), board);

    if (options.passage == Passage::report) {
        if (interrupted()) {
            return RunStatus::interrupted;
        }
        refuse_unread(members);
    }
    SeriesResults results = evaluate(std::move(members));
    SeriesExtra extra;
    if (study) {
        extra = study(results.members);
        results.scalars.insert(results.scalars.begin(), extra.results.begin(), extra.results.end());
    }
    report::Record record = series_record(plan, results);
    record.plots.insert(record.plots.begin(), extra.plots.begin(), extra.plots.end());
    record.overview.insert(record.overview.begin(), extra.tables.begin(), extra.tables.end());
    if (!extra.key_figures.empty()) {
        record.key_figures.assign(extra.key_figures.begin(),
                                  extra.key_figures.begin() + std::min<std::ptrdiff_t>(4, std::ssize(extra.key_figures)));
    }
    record.warnings.insert(record.warnings.begin(), extra.warnings.begin(), extra.warnings.end());
    if (!extra.csv_name.empty()) {
        report::write_file(out.file(extra.csv_name), report::to_csv(extra.csv));
    }
    for (const auto& group : results.groups) {
        if (group.mean) {
            make_folder(out.file("mean_curves"));
            report::write_file(out.file(mean_curve_file(group)), report::to_csv(mean_curve_table(*group.mean, group.of->x, group.of->y)));
        }
    }
    report::write_file(out.file("series.csv"), report::to_csv(series_table(results)));
    report::write_json(out.file("summary.json"), series_summary(record, results));
    report::write_file(out.file("report.html"), report::to_html(record));
    write_manifest(results.status);
    fmt::print("{}results in {}\n", series_text(record, results), folder);
    for (const auto& member : results.members) {
        if (member.unwritten) {
            throw FileError(member.member->name + ": " + member.stopped_by);
        }
    }
    return results.status == "interrupted" ? RunStatus::interrupted : results.status == "failed" ? RunStatus::failed : RunStatus::complete;
}

} // namespace

void check_members(const Plan& plan) {
    MemberProblems problems;
    Warnings warnings(plan);
    for (const auto& member : plan.members) {
        problems.of([&] { warnings.say(member, check_before(member.deck)); });
    }
    problems.settle();
}

RunStatus run_series(const Plan& plan, const RunOptions& options, int threads, const SeriesStudy& study) {
    OutputFolder out(options.out);
    return with_way_on(out, [&] { return carry_out_series(plan, options, threads, study, out); });
}

} // namespace proveta
