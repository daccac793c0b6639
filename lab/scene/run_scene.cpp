#include "lab/scene/run_scene.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "core/files/whole_file.hpp"
#include "lab/keeper.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/scene/performance.hpp"
#include "lab/scene/scene_samples.hpp"
#include "lab/summary.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"

namespace proveta {

namespace {

using input::Json;

Json manifest_of(const Scene& scene, const RunOptions& options) {
    std::vector<std::string> own{scene.source};
    for (const auto& m : scene.materials) {
        own.push_back((std::filesystem::path(scene.folder) / m.material.card).string());
    }
    Json j{{"proveta_scene_manifest", 1}, {"status", "running"}};
    j.update(program_facts());
    j.update({{"command", options.command},
              {"started", now_utc()},
              {"resumed", Json::array()},
              {"threads", omp_get_max_threads()},
              {"repeat_with", fmt::format("proveta scene {}/manifest.json --out NEW_FOLDER", options.out)},
              {"files", hashes_of(own)},
              {"files_read_again", hashes_of(files_of(scene))},
              {"scene", resolved(scene)}});
    return j;
}

void log_start(const Model& m) {
    std::size_t faces = 0;
    for (const auto& s : m.walls.surfaces) {
        faces += s.geometry.mesh.faces();
    }
    spdlog::info("{} particles at the start, {} surfaces of {} faces; step {:.3g} s", state_of(m).particles, m.walls.surfaces.size(), faces,
                 m.dt());
}

// Writes all but the fields, the manifest last: who finds it complete finds all of it.
// only_reported: the times of the calculation stay those of the manifest.
void write_results(const Scene& scene, const ScenePlay& play, const SceneSeen& seen, const OutputFolder& out, Json& sheet,
                   bool only_reported) {
    report::Record record = scene_record(scene, play, seen);
    if (const std::string warning = physics_warning(sheet); !warning.empty()) {
        record.warnings.push_back(warning);
    }
    report::write_file(out.file("curve.csv"), report::to_csv(seen.curve));
    report::write_file(out.file("energy.csv"), report::to_csv(seen.energy));
    report::write_file(out.file("particles.csv"), report::to_csv(particle_table(play.model())));
    report::write_json(out.file("summary.json"), scene_summary(record, play));
    report::write_file(out.file("report.html"), report::to_html(record));
    const PhaseTimes& t = play.model().phase_times();
    sheet["status"] = seen.status;
    sheet["written"] = now_utc();
    if (!only_reported) {
        sheet["wall_time_s"] = seen.seconds;
        sheet["phase_times_s"] = {{"search", t.search}, {"forces", t.forces}, {"motion", t.motion}};
    }
    out.write_manifest(sheet);
    fmt::print("{}results in {}\n", as_text(record), out.path().string());
}

// What the user should know of surfaces and bodies from files.
void warn_of(const ScenePlay& play) {
    for (const auto& note : play.notes()) {
        spdlog::warn("{}", note);
    }
}

RunStatus play_scene(const Scene& scene, const RunOptions& options, OutputFolder& out, Progress& progress) {
    progress.show("making surfaces and particles");
    ScenePlay play(scene);
    progress.end_line();
    if (options.passage == Passage::begin) {
        warn_of(play);
    }
    const auto log = [&](const char* line) {
        if (!options.quiet) {
            spdlog::info("{}", line);
        }
    };
    Json sheet = manifest_of(scene, options);
    Keeper keeper(out, "checkpoint.h5", hash_of_text(sheet["scene"].dump() + sheet["files_read_again"].dump()),
                  scene.output.checkpoint_every, [](StateVisitor&) {});
    const bool go_on = options.passage != Passage::begin;
    if (options.passage == Passage::report && !keeper.there()) {
        throw input::InputError({{out.path().string(), "", "no checkpoint", "a folder with one, from which a report can be made", ""}});
    }
    Performance performance(scene, play, out, progress, keeper, options.passage == Passage::report);
    if (go_on) {
        out.go_on();
        sheet = manifest_to_go_on_with(out.file("manifest.json"), sheet, options.passage == Passage::go_on);
        if (keeper.there()) {
            performance.restore();
        }
        if (options.passage == Passage::go_on) {
            log(keeper.there() ? "going on from the last checkpoint" : "no checkpoint yet: the scene begins anew");
        }
    } else {
        out.begin();
    }
    if (!options.quiet) {
        log_start(play.model());
    }
    if (options.passage != Passage::report) { // which changes nothing before it has succeeded
        sheet["status"] = "running";
        out.write_manifest(sheet);
    }
    const SceneSeen seen = performance.go();
    progress.end_line();
    write_results(scene, play, seen, out, sheet, options.passage == Passage::report);
    if (seen.status == "interrupted") {
        spdlog::warn("interrupted; to go on: proveta resume {}", out.path().string());
    }
    return seen.status == "complete" ? RunStatus::complete : seen.status == "failed" ? RunStatus::failed : RunStatus::interrupted;
}

} // namespace

RunStatus run_scene(const Scene& scene, const RunOptions& options) {
    OutputFolder out(options.out);
    Progress progress(options.quiet);
    return with_way_on(out, [&] { return play_scene(scene, options, out, progress); });
}

void try_scene(const Scene& scene) {
    const ScenePlay play(scene);
    warn_of(play);
}

} // namespace proveta
