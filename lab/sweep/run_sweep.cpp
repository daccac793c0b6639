#include "lab/sweep/run_sweep.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>

#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/sweep/sweep_report.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"

namespace proveta {

using input::Json;

namespace {

// manifest.json: repeats the sweep. status: running, planned, complete, interrupted or failed.
Json manifest_of(const Sweep& sweep, const SweepOptions& options, const std::string& status, const std::string& started) {
    Json j{{"proveta_sweep_manifest", 1}, {"status", status}};
    j.update(program_facts());
    j.update({{"command", options.command},
              {"started", started},
              {"written", now_utc()},
              {"to_repeat", "proveta sweep manifest.json --out NEW_FOLDER"},
              {"points", sweep.points.size()},
              {"files", sweep.files},
              {"sweep", resolved(sweep)}});
    return j;
}

// Everything but the manifest; the report last. Returns what is to be printed too.
std::pair<RunStatus, std::string> write_results(const Sweep& sweep, const OutputFolder& folder, const TrialFolders& trials,
                                                std::vector<TrialResult> results) {
    SweepOutcome outcome;
    outcome.table = make_table(sweep, std::move(results));
    outcome.sensitivities = sensitivities(sweep, outcome.table);
    outcome.curves = curves_of(sweep, outcome.table, trials);
    const report::Record record = sweep_record(sweep, outcome);
    report::write_file(folder.file("table.csv"), report::to_csv(rows_of(sweep, outcome.table)));
    write_hdf5(sweep, outcome.table, folder.file("table.h5"));
    report::write_file(folder.file("failures.csv"), report::to_csv(failures_of(outcome.table)));
    report::write_file(folder.file("sensitivity.csv"), report::to_csv(sensitivity_rows(sweep, outcome.table, outcome.sensitivities)));
    report::write_file(folder.file("curve_sensitivity.csv"), report::to_csv(curve_rows(sweep, outcome.curves)));
    report::write_json(folder.file("summary.json"), sweep_summary(sweep, outcome, record));
    report::write_file(folder.file("report.html"), report::to_html(record));
    const bool failed = record.status == "failed";
    return {failed ? RunStatus::failed : RunStatus::complete,
            fmt::format("{}results in {}\n", sweep_text(sweep, outcome, record), folder.path().string())};
}

} // namespace

RunStatus run_sweep(const Sweep& sweep, const SweepOptions& options) {
    OutputFolder folder(options.out);
    TrialBook book(options.out, options.mode, static_cast<std::size_t>(options.threads), options.quiet, [&folder] { folder.look(); });
    options.mode == BookMode::report ? folder.go_on() : folder.begin(); // once nobody else has the book
    const auto trials = trials_of(sweep);
    if (const std::string others = book.of_other_physics(); !others.empty()) {
        spdlog::warn("{}: {} of {} points", others, trials.size() - book.known(trials), trials.size());
    }
    const std::string started = now_utc();
    const auto write_manifest = [&](const std::string& status) {
        auto sheet = manifest_of(sweep, options, status, started);
        folder.write_manifest(options.mode == BookMode::report ? with_beginning_of(folder.file("manifest.json"), std::move(sheet)) : sheet);
    };
    if (options.mode != BookMode::report) { // which changes nothing before it has succeeded
        write_manifest("running");
    }
    try {
        const auto [status, text] =
            with_way_on(folder, [&] { return write_results(sweep, folder, book.folders(), book.evaluate(trials, sweep.input.title)); });
        write_manifest(status == RunStatus::failed ? "failed" : "complete");
        fmt::print("{}", text); // the last: it may find nobody who listens
        return status;
    } catch (const TrialsPlanned&) {
        write_manifest("planned");
        throw;
    } catch (const TrialsInterrupted&) {
        write_manifest("interrupted");
        return RunStatus::interrupted;
    }
}

std::string sweep_status(const Sweep& sweep, const std::string& out) {
    std::map<std::string, TrialResult> known;
    for (auto& result : TrialBook::read(out)) {
        const std::string key = result.key;
        known.insert_or_assign(key, std::move(result));
    }
    const auto others = std::erase_if(known, [](const auto& entry) { return !of_this_physics(entry.second); });
    const TrialFolders folders(out);
    const auto trials = trials_of(sweep);
    std::size_t done = 0;
    std::size_t tests = 0;
    std::size_t jobs = 0;
    double seconds = 0.0;
    std::string failures;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const auto found = known.find(trials[i].key);
        // What has been carried out elsewhere is not in the ledger before --collect.
        const auto finished = found == known.end() ? folders.finished(trials[i].key) : found->second.jobs;
        done += finished.size() == trials[i].jobs.size() ? 1 : 0;
        tests += finished.size();
        jobs += trials[i].jobs.size();
        for (const auto& job : finished) {
            seconds += job.seconds;
            if (job.status != "complete") {
                failures += fmt::format("  point {}, {}: {} ({})\n", i + 1, job.name, job.reason, trials[i].key);
            }
        }
    }
    return fmt::format("{} of {} points done, {} of {} tests, {} of running time\n{}{}", done, trials.size(), tests, jobs,
                       Progress::duration(seconds), failures.empty() ? "no failures\n" : "failures:\n" + failures,
                       others > 0 ? fmt::format("not counted, of another physics: {}\n", others) : "");
}

} // namespace proveta
