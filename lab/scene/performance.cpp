#include "lab/scene/performance.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "lab/fields.hpp"
#include "lab/keeper.hpp"
#include "lab/scene/vectors.hpp"
#include "lab/test_state.hpp"
#include "reports/files.hpp"

namespace proveta {

namespace {

constexpr std::int64_t steps_a_look = 256; // between looks at the clock and at whether all is well

} // namespace

Performance::Performance(const Scene& scene, ScenePlay& play, const OutputFolder& out, Progress& progress, Keeper& keeper, bool watch_only)
    : scene_(scene), play_(play), out_(out), progress_(progress), keeper_(keeper), watch_only_(watch_only),
      stage_(stage_of(scene, play.model().walls)) {
    seen_.curve = empty_scene_curve(play.model());
    seen_.energy = empty_scene_energy();
}

void Performance::restore() {
    keeper_.restore([this](StateVisitor& visit) { visit_state(visit); });
    play_.restored();
}

SceneSeen Performance::go() {
    try {
        while (seen_.stopped_by.empty()) {
            const bool interrupted = watch_only_ || play_on();
            if (interrupted && seen_.stopped_by.empty()) {
                seen_.stopped_by = "interrupted by the user";
                seen_.status = "interrupted";
            }
        }
        play_.step(true); // the end itself, measured
    } catch (const NumericalFailure& e) {
        seen_.stopped_by = std::string("the calculation failed: ") + e.what();
        seen_.status = "failed";
    }
    seen_.seconds = seconds();
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

// One step, with all that is due at it; whether the user wants it to be the last. What is about to be looked at, and perhaps kept, is
// checked by the model first: a diverged state is not worth keeping.
bool Performance::play_on() {
    const bool stop = interrupted();
    const double time = play_.model().time();
    const auto due = [&](std::int64_t done, std::int64_t all) {
        return time >= scene_.stop.time * static_cast<double>(done) / static_cast<double>(all);
    };
    const bool sample = due(samples_, scene_.output.samples);
    const bool looks = (play_.model().steps() + 1) % steps_a_look == 0;
    play_.step(sample || looks || stop);
    if (sample) {
        look();
    }
    if (scene_.output.fields > 0 && due(static_cast<std::int64_t>(fields_.size()), scene_.output.fields)) {
        write_fields();
    }
    if (stop || !seen_.stopped_by.empty() || ((sample || looks) && keeper_.due())) {
        keeper_.save([this](StateVisitor& visit) { visit_state(visit); });
    }
    return stop;
}

void Performance::picture(const std::string& when) {
    for (auto& p : scene_slices(play_.model(), vector(scene_.gravity), stage_, when)) {
        seen_.pictures.push_back(std::move(p));
    }
}

void Performance::look() {
    const Model& m = play_.model();
    sample_scene(m, play_.feed(), seen_.curve, seen_.energy);
    if (samples_ == 0) {
        picture("At the start");
    } else if (samples_ == scene_.output.samples / 2) {
        picture(fmt::format("After {:.3g} s", m.time()));
    }
    ++samples_;
    const double done = m.time() / scene_.stop.time;
    const double spheres = static_cast<double>(m.spheres.size()) * static_cast<double>(m.steps());
    progress_.show(fmt::format("time {:.4g} s  {} particles  speed {:.3g} m/s  {:.3g} sphere-steps/s  {:.0f} %  {}", m.time(),
                               seen_.curve.rows.back()[1], seen_.curve.rows.back()[5], spheres / std::max(seconds(), 1e-9), 100.0 * done,
                               Progress::left(seconds(), done)));
    seen_.stopped_by = play_.over();
}

void Performance::write_fields() {
    make_folder(out_.file("fields"));
    const Model& m = play_.model();
    std::vector<std::pair<std::string, report::Geometry>> parts{{"particles", particle_fields(m)}, {"surfaces", surface_fields(m)}};
    if (!m.walls.bodies.empty()) {
        parts.emplace_back("bodies", body_fields(m));
    }
    const auto name = [](const std::string& part, std::size_t k) { return fmt::format("fields/{}_{:04}.vtp", part, k); };
    for (const auto& [part, geometry] : parts) {
        report::write_vtp(out_.file(name(part, fields_.size())), geometry);
    }
    fields_.push_back(m.time());
    std::vector<report::SeriesEntry> series;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
        for (const auto& part : parts) {
            series.push_back({fields_[k], part.first, name(part.first, k)});
        }
    }
    report::write_file(out_.file("series.pvd"), report::to_pvd(series));
}

void Performance::visit_state(StateVisitor& visit) {
    double so_far = seconds();
    visit("scene_seconds", so_far);
    before_ = so_far - since(begin_);
    visit("scene_stopped_by", seen_.stopped_by);
    visit("scene_samples", samples_);
    visit("scene_field_times", fields_);
    visit_rows("curve_", seen_.curve, visit);
    visit_rows("energy_", seen_.energy, visit);
    auto pictures = static_cast<std::int64_t>(seen_.pictures.size());
    visit("scene_pictures", pictures);
    seen_.pictures.resize(static_cast<std::size_t>(pictures));
    for (std::size_t k = 0; k < seen_.pictures.size(); ++k) {
        visit_picture(fmt::format("picture_{}_", k), seen_.pictures[k], visit);
    }
    play_.visit_state(visit);
}

} // namespace proveta
