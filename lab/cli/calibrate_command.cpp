// proveta calibrate
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>

#include "lab/calibrate/calibrate.hpp"
#include "lab/calibrate/calibrate_report.hpp"
#include "lab/cli/commands.hpp"
#include "lab/output_folder.hpp"
#include "lab/provenance.hpp"
#include "lab/trials/decks.hpp"
#include "lab/trials/launch.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"

namespace proveta {

namespace {

namespace fs = std::filesystem;
using input::Json;

Json state_of(const std::string& phase, const CalibrationOutcome& so_far, std::size_t known) {
    Json j{{"phase", phase}, {"trials_asked", so_far.trials.size()}, {"trials_in_ledger", known}};
    const CalibrationTrial* best = nullptr;
    for (const auto& t : so_far.trials) {
        if (t.deviations.complete && (best == nullptr || t.deviations.score() < best->deviations.score())) {
            best = &t;
        }
    }
    j["best_score"] = best != nullptr ? Json(best->deviations.score()) : Json();
    return j;
}

int show_status(const fs::path& out) {
    if (!fs::exists(out / "ledger.jsonl")) {
        throw input::InputError({{out.string(), "", "no ledger", "the folder of a calibration", "--out DIR"}});
    }
    double seconds = 0.0;
    std::size_t failed = 0;
    const auto trials = TrialBook::read(out);
    for (const auto& trial : trials) {
        bool whole = true;
        for (const auto& job : trial.jobs) {
            seconds += job.seconds;
            whole = whole && job.status == "complete";
        }
        failed += whole ? 0 : 1;
    }
    fmt::print("{}: {} trials ended, {} of them with a test that failed; {} of computing\n", out.string(), trials.size(), failed,
               Progress::duration(seconds));
    std::ifstream in(out / "progress.json");
    if (const Json state = in ? Json::parse(in, nullptr, false) : Json(); state.is_object()) {
        fmt::print("phase: {}; best score {}\n", state.value("phase", ""), state["best_score"].dump());
    }
    fmt::print("{}\n", fs::exists(out / "card.json") ? "complete: card.json, report.html" : "not at its end yet");
    return 0;
}

// Everything but the manifest. Returns what is to be printed too.
std::string write_results(const OutputFolder& out, const CalibrationPlan& plan, const std::vector<Target>& targets,
                          const CalibrationOutcome& outcome, const TrialFolders& folders) {
    const Json card = calibrated_card(plan, targets, outcome, folders);
    const report::Record record = calibration_record(plan, targets, outcome, folders);
    report::write_file(out.file("trials.csv"), report::to_csv(trials_table(plan, targets, outcome, folders)));
    report::write_file(out.file("report.html"), report::to_html(record));
    report::write_json(out.file("summary.json"), calibration_summary(plan, targets, outcome, record, card));
    report::write_json(out.file("card.json"), card);
    std::string text = fmt::format("{}: {}\n", record.title, record.stopped_by);
    for (const auto& table : record.overview) {
        text += fmt::format("{}\n", table.title);
        for (const auto& row : table.rows) {
            text += fmt::format("  {:<36}", row.front());
            for (std::size_t k = 1; k < row.size(); ++k) {
                text += fmt::format(" {:>16}", row[k]);
            }
            text += "\n";
        }
    }
    for (const auto& s : record.results) {
        text += fmt::format("{}: {:.3f}\n", s.title, s.value.value_or(0.0));
    }
    return text + fmt::format("card in {}, report in {}\n", out.file("card.json"), out.file("report.html"));
}

} // namespace

int carry_out_calibration(const TrialsArguments& a, const std::string& typed) {
    const fs::path out = a.out.empty() ? fs::path("results") / result_name(a.file, "calibration") : fs::path(a.out);
    if (a.status) {
        return show_status(out);
    }
    use_threads(a.threads);
    Looks looks;
    CalibrationPlan plan;
    std::vector<Target> targets;
    const bool read = looks.at([&] {
        plan = read_calibration(a.file);
        targets = make_targets(plan);
    });
    if (a.begins()) {
        looks.at_folder(a.out);
    }
    for (const auto& t : targets) {
        for (const auto& note : t.file.notes) {
            spdlog::info("{}: {}", t.input.title(), note);
        }
        for (const auto& warning : t.file.warnings) {
            spdlog::warn("{}: {}", t.input.title(), warning);
        }
    }
    if (a.begins() && read) {
        looks.at([&] { look_at_specimens(plan.space, plan.tests, plan.source); });
    }
    looks.settle();
    if (a.check) {
        fmt::print("{}: no problems; a calibration of {} parameters to {} targets\n", a.file, plan.space.size(), targets.size());
        return 0;
    }
    OutputFolder folder(out);
    catch_interrupts();
    TrialBook book(out, a.mode(), static_cast<std::size_t>(omp_get_max_threads()), a.quiet, [&folder] { folder.look(); });
    a.report ? folder.go_on() : folder.begin(); // once nobody else has the book; trials stay
    const auto write_manifest = [&](const char* status) {
        auto sheet = calibration_manifest(plan, typed, status);
        folder.write_manifest(a.report ? with_beginning_of(folder.file("manifest.json"), std::move(sheet)) : sheet);
    };
    if (!a.report) { // which changes nothing before it has succeeded
        write_manifest("running");
    }
    if (const std::string others = book.of_other_physics(); !others.empty()) {
        spdlog::warn("{}", others);
    }
    if (book.known() > 0 && !a.quiet) {
        spdlog::info("{} trials are in the ledger and will not be repeated", book.known());
    }
    const auto keep_state = [&](const std::string& phase, const CalibrationOutcome& so_far) {
        if (a.report) {
            return;
        }
        report::write_json(folder.file("progress.json"), state_of(phase, so_far, book.known()));
    };
    try {
        const std::string text = with_way_on(
            folder, [&] { return write_results(folder, plan, targets, calibrate(plan, targets, book, keep_state), book.folders()); });
        write_manifest("complete");
        fmt::print("{}", text); // the last: it may find nobody who listens
        return 0;
    } catch (const TrialsPlanned& planned) {
        write_manifest("planned");
        fmt::print("{}", write_plan(out, planned.folders));
        return 0;
    } catch (const TrialsInterrupted&) {
        write_manifest("interrupted");
        spdlog::warn("interrupted; the same command goes on from {} trials", book.known());
        return exit_interrupted();
    }
}

void add_calibrate(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<TrialsArguments>();
    auto* command = app.add_subcommand("calibrate", "find the card that reproduces measured results and curves, and how sure it is");
    add_trials(*command, *a, "calibration", "results/NAME of the calibration");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return carry_out_calibration(*a, typed); }; });
}

} // namespace proveta
