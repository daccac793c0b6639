#include "lab/scene/run_scene.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>

#include "lab/clock.hpp"
#include "lab/fields.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/results.hpp"
#include "lab/scene/scene_play.hpp"
#include "lab/scene/scene_report.hpp"
#include "lab/scene/vectors.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"

namespace proveta {

namespace {

using input::Json;

Json manifest_of(const Scene& scene, const RunOptions& options, const std::string& status, const std::string& started) {
    return {{"proveta_scene_manifest", 1},
            {"status", status},
            {"version", version()},
            {"compiler", PROVETA_COMPILER},
            {"build", PROVETA_BUILD},
            {"command", options.command},
            {"started", started},
            {"written", now_utc()},
            {"repeat_with", fmt::format("proveta scene {}/manifest.json --out NEW_FOLDER", options.out)},
            {"scene", resolved(scene)}};
}

// Plays a scene and keeps what is seen.
class Performance {
  public:
    Performance(const Scene& scene, ScenePlay& play, const OutputFolder& out, Progress& progress)
        : scene_(scene), play_(play), out_(out), progress_(progress), stage_(stage_of(scene, play.model().walls)) {
        seen_.curve = empty_scene_curve(play.model());
        seen_.energy = empty_scene_energy();
    }

    SceneSeen go() {
        try {
            while (seen_.stopped_by.empty()) {
                const double time = play_.model().time();
                const auto due = [&](std::int64_t done, std::int64_t all) {
                    return time >= scene_.stop.time * static_cast<double>(done) / static_cast<double>(all);
                };
                const bool sample = due(samples_, scene_.output.samples);
                play_.step(sample);
                if (sample) {
                    look();
                }
                if (scene_.output.fields > 0 && due(fields_, scene_.output.fields)) {
                    write_fields();
                }
                if (interrupted()) {
                    seen_.stopped_by = "interrupted by the user";
                    seen_.status = "interrupted";
                }
            }
            play_.step(true); // the end itself, measured
        } catch (const NumericalFailure& e) {
            seen_.stopped_by = std::string("the calculation failed: ") + e.what();
            seen_.status = "failed";
        }
        seen_.seconds = since(begin_);
        if (seen_.status != "failed" || seen_.curve.rows.empty()) {
            sample_scene(play_.model(), play_.feed(), seen_.curve, seen_.energy);
        }
        if (scene_.output.fields > 0) {
            write_fields();
        }
        picture("At the end");
        for (const auto& box : scene_.measures) {
            seen_.measures.push_back(content_of(box, play_.model()));
        }
        return std::move(seen_);
    }

  private:
    void picture(const std::string& when) {
        for (auto& p : scene_slices(play_.model(), vector(scene_.gravity), stage_, when)) {
            seen_.pictures.push_back(std::move(p));
        }
    }

    void look() {
        const Model& m = play_.model();
        sample_scene(m, play_.feed(), seen_.curve, seen_.energy);
        if (samples_ == 0) {
            picture("At the start");
        } else if (samples_ == scene_.output.samples / 2) {
            picture(fmt::format("After {:.3g} s", m.time()));
        }
        ++samples_;
        const double done = m.time() / scene_.stop.time;
        const double seconds = since(begin_);
        const double spheres = static_cast<double>(m.spheres.size()) * static_cast<double>(m.steps());
        progress_.show(fmt::format("time {:.4g} s  {} particles  speed {:.3g} m/s  {:.3g} sphere-steps/s  {:.0f} %  at most {} left",
                                   m.time(), seen_.curve.rows.back()[1], seen_.curve.rows.back()[5], spheres / std::max(seconds, 1e-9),
                                   100.0 * done, Progress::duration(seconds * (1.0 / std::max(done, 1e-9) - 1.0))));
        seen_.stopped_by = play_.over();
    }

    void write_fields() {
        std::filesystem::create_directories(out_.path() / "fields");
        const Model& m = play_.model();
        std::vector<std::pair<std::string, report::Geometry>> parts{{"particles", particle_fields(m)}, {"surfaces", surface_fields(m)}};
        if (!m.walls.bodies.empty()) {
            parts.emplace_back("bodies", body_fields(m));
        }
        for (const auto& [part, geometry] : parts) {
            const std::string file = fmt::format("fields/{}_{:04}.vtp", part, fields_);
            report::write_vtp(out_.file(file), geometry);
            series_.push_back({play_.model().time(), part, file});
        }
        ++fields_;
        report::write_file(out_.file("series.pvd"), report::to_pvd(series_));
    }

    const Scene& scene_;
    ScenePlay& play_;
    const OutputFolder& out_;
    Progress& progress_;
    SceneSeen seen_;
    Clock::time_point begin_ = Clock::now();
    Eigen::AlignedBox3d stage_; // that pictures show
    std::int64_t samples_ = 0;
    std::int64_t fields_ = 0;
    std::vector<report::SeriesEntry> series_;
};

} // namespace

RunStatus run_scene(const Scene& scene, const RunOptions& options) {
    OutputFolder out(options.out);
    Progress progress(options.quiet);
    const std::string started = now_utc();
    progress.show("making surfaces and particles");
    ScenePlay play(scene);
    progress.end_line();
    if (!options.quiet) {
        const Model& m = play.model();
        std::size_t faces = 0;
        for (const auto& s : m.walls.surfaces) {
            faces += s.geometry.mesh.faces();
        }
        spdlog::info("{} particles at the start, {} surfaces of {} faces; step {:.3g} s", state_of(m).particles, m.walls.surfaces.size(),
                     faces, m.dt());
    }
    out.begin();
    report::write_json(out.file("manifest.json"), manifest_of(scene, options, "running", started));
    const SceneSeen seen = Performance(scene, play, out, progress).go();
    progress.end_line();
    const report::Record record = scene_record(scene, play, seen);
    report::write_file(out.file("curve.csv"), report::to_csv(seen.curve));
    report::write_file(out.file("energy.csv"), report::to_csv(seen.energy));
    report::write_file(out.file("particles.csv"), report::to_csv(particle_table(play.model())));
    report::write_json(out.file("manifest.json"), manifest_of(scene, options, seen.status, started));
    report::write_json(out.file("summary.json"), scene_summary(record, play, seen));
    report::write_file(out.file("report.html"), report::to_html(record));
    fmt::print("{}results in {}\n", as_text(record), out.path().string());
    return seen.status == "complete" ? RunStatus::complete : seen.status == "failed" ? RunStatus::failed : RunStatus::interrupted;
}

void try_scene(const Scene& scene) { ScenePlay play(scene); }

} // namespace proveta
