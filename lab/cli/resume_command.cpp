// proveta resume, proveta report
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "lab/cli/commands.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/scene/run_scene.hpp"
#include "lab/series/plan.hpp"
#include "lab/series/run_series.hpp"
#include "lab/study/study.hpp"

namespace proveta {

namespace {

namespace fs = std::filesystem;

struct ResumeArguments {
    std::string folder;
    int threads = 0;
    bool quiet = false;
};

[[noreturn]] void refuse(const std::string& folder, const std::string& found, const std::string& expected, const std::string& hint) {
    throw input::InputError({{folder, "", found, expected, hint}});
}

// A test, a series or a scene, from the checkpoints of its folders.
int go_on_with(const ResumeArguments& a, const std::string& typed, const input::Json& manifest, Passage passage) {
    const std::string file = (fs::path(a.folder) / "manifest.json").string();
    const std::string status = input::text_at(manifest, "status");
    if (status == "complete" && passage == Passage::go_on) {
        fmt::print("{} is complete: there is nothing to go on with\n", a.folder);
        return 0;
    }
    const bool scene = manifest.contains("proveta_scene_manifest");
    if (status == "failed" && !manifest.contains("proveta_series_manifest")) {
        refuse(a.folder, "a calculation that failed",
               passage == Passage::go_on
                   ? "one that was stopped: from the same state it would fail again"
                   : "one that was stopped or has ended: the page tells of the failure, and its checkpoint is from before",
               fmt::format("change what its report names as the cause: proveta {} {} --set KEY=VALUE --out NEW_FOLDER",
                           scene ? "scene" : "run", file));
    }
    if (status == "cleared" && passage == Passage::report) {
        refuse(a.folder, "a result that was being cleared", "one that is there", "proveta resume calculates it anew");
    }
    for (const auto& change : changes_since(manifest)) {
        spdlog::warn("{}", change);
    }
    if (status == "cleared") {
        spdlog::warn("the run was stopped while it cleared an earlier result, which is calculated anew");
        passage = Passage::begin;
    } else if (const auto other = other_physics(manifest); !other.empty() && !manifest.contains("proveta_series_manifest")) {
        spdlog::warn("computed by {}: {}", other,
                     passage == Passage::go_on ? "the result may differ from that of a run that was never stopped"
                                               : "what is reported is what that computed");
    }
    const RunOptions options{a.folder, typed, a.quiet, passage};
    if (scene) {
        const Scene read = read_scene(file, {});
        catch_interrupts();
        return exit_code(run_scene(read, options));
    }
    const Plan plan = read_plan({file}, {});
    catch_interrupts();
    return exit_code(plan.series ? run_series(plan, options, omp_get_max_threads(), study_of(plan))
                                 : run_test(plan.members.front().deck, options));
}

int pass_through(const ResumeArguments& a, const std::string& typed, Passage passage) {
    use_threads(a.threads);
    const fs::path file = fs::path(a.folder) / "manifest.json";
    if (!fs::exists(file)) {
        refuse(a.folder, fs::exists(a.folder) ? "a folder without manifest.json" : "no such folder", "the folder of a run that was stopped",
               "one that was stopped before its specimen was in the press has kept nothing: run its deck again");
    }
    const input::Json manifest = input::load_json(file.string());
    TrialsArguments trials;
    trials.file = file.string();
    trials.out = a.folder;
    trials.threads = a.threads;
    trials.quiet = a.quiet;
    trials.report = passage == Passage::report;
    const bool trialled = manifest.contains("proveta_sweep_manifest") || manifest.contains("proveta_calibration_manifest");
    if (trialled && passage == Passage::report && input::text_at(manifest, "status") != "complete") {
        refuse(a.folder, "one that has not ended", "a sweep or a calibration that is complete", "proveta resume goes on with it");
    }
    if (trialled) {
        if (const auto changed = changed_specimens(manifest); !changed.empty()) {
            refuse(changed.front(), "another file than the tests began with, or none", "the stored specimen as it was",
                   "for tests of another specimen take another folder");
        }
        for (const auto& change : changes_since(manifest)) {
            spdlog::warn("{}", change);
        }
    }
    if (manifest.contains("proveta_sweep_manifest")) {
        return carry_out_sweep(trials, typed);
    }
    if (manifest.contains("proveta_calibration_manifest")) {
        return carry_out_calibration(trials, typed);
    }
    const bool single = manifest.contains("proveta_manifest") || manifest.contains("proveta_scene_manifest");
    if (!single && !manifest.contains("proveta_series_manifest")) {
        refuse(file.string(), "a JSON file of another kind", "a manifest that this program wrote", "");
    }
    return go_on_with(a, typed, manifest, passage);
}

} // namespace

void add_resume(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<ResumeArguments>();
    auto* command =
        app.add_subcommand("resume", "go on with a run, series, scene, sweep or calibration that was stopped, to the same results");
    command->add_option("folder", a->folder, "its result folder")->required();
    command->add_option("--threads", a->threads, "number of threads; results do not depend on it")->check(CLI::Range(1, 1024));
    command->add_flag("--quiet", a->quiet, "no progress, no log but warnings and errors");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return pass_through(*a, typed, Passage::go_on); }; });
}

void add_report(CLI::App& app, const std::string& typed, Command& chosen) {
    auto a = std::make_shared<ResumeArguments>();
    auto* command =
        app.add_subcommand("report", "write page, tables and pictures of a result folder anew, as this version of the program does");
    command->add_option("folder", a->folder, "its result folder")->required();
    command->add_flag("--quiet", a->quiet, "no progress, no log but warnings and errors");
    command->callback([a, typed, &chosen] { chosen = [a, typed] { return pass_through(*a, typed, Passage::report); }; });
}

} // namespace proveta
