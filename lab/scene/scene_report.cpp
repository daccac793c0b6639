#include "lab/scene/scene_report.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "lab/citation.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/quasi_static.hpp"
#include "lab/summary.hpp"

namespace proveta {

namespace {

std::vector<report::Scalar> results_of(const ScenePlay& play, const SceneSeen& seen) {
    const SceneState s = state_of(play.model());
    std::vector<report::Scalar> out{
        {"particles", "Particles at the end", static_cast<double>(s.particles), "", "in the scene"},
        {"mass", "Mass at the end", s.mass, "kg", "of these"},
        {"rms_speed", "Root mean square speed", s.rms_speed, "m/s", "of the particles' centres"},
        {"touching", "Contacts a particle", s.touching, "", "with others and surfaces, counted by spheres"},
    };
    out.push_back({"largest_overlap", "Largest overlap", play.model().largest_overlap(), "",
                   "of two spheres, or of a sphere and a surface, over the smaller radius, at any step"});
    for (const auto& box : seen.measures) {
        out.push_back({"solid_fraction_" + box.name, "Solid fraction in " + box.name, box.solid_fraction, "",
                       "share of the box inside spheres, overlaps once"});
        out.push_back({"bulk_density_" + box.name, "Bulk density in " + box.name, box.bulk_density, "kg/m3",
                       "mass of the particles whose centre is inside over the box's volume"});
        out.push_back({"touching_" + box.name, "Contacts a particle in " + box.name, box.touching, "",
                       fmt::format("{} particles whose centre is inside", box.particles)});
    }
    return out;
}

// Worst residual over what went through the ledger.
report::Badge energy_badge(const Model& m) {
    constexpr double most = 0.01;
    const double found = std::fabs(m.ledger().relative_residual());
    report::Badge badge{"Energy balance", found <= most, "", {}};
    badge.verdict = badge.good ? "closed" : "not closed: the time step is too large or the calculation lost its footing";
    badge.figures = {{"residual over the energy given", fmt::format("{:.2g} % (allowed {:.2g} %)", 100.0 * found, 100.0 * most)}};
    return badge;
}

std::vector<report::Plot> plots_of(const Model& m, const SceneSeen& seen) {
    const auto curve = [&](const report::Table& t, const std::string& y, const std::string& name, const std::string& colour) {
        return report::Curve{name, t.values("time"), t.values(y), colour};
    };
    std::vector<report::Plot> out;
    out.push_back({"Particles in the scene.", "time [s]", "particles", {curve(seen.curve, "particles", "", "#1f4e79")}, {}});
    out.push_back({"Speed of the particles.",
                   "time [s]",
                   "speed [m/s]",
                   {curve(seen.curve, "rms_speed", "root mean square", "#1f4e79"), curve(seen.curve, "fastest", "fastest", "#c0392b")},
                   {}});
    constexpr const char* colours[] = {"#1f4e79", "#c0392b", "#1e7b46"};
    for (std::size_t s = 0; s < std::min<std::size_t>(m.walls.surfaces.size(), 6); ++s) {
        const std::string& name = m.walls.surfaces[s].name;
        report::Plot forces{"Force of the particles on " + name + ".", "time [s]", "force [N]", {}, {}};
        report::Plot torques{"Torque of the particles on " + name + ".", "time [s]", "torque [N m]", {}, {}};
        for (int c = 0; c < 3; ++c) {
            const std::string axis(1, "xyz"[c]);
            forces.curves.push_back(curve(seen.curve, name + "_force_" + axis, axis, colours[c]));
            torques.curves.push_back(curve(seen.curve, name + "_torque_" + axis, axis, colours[c]));
        }
        out.push_back(std::move(forces));
        if (!m.walls.surfaces[s].motion.spin.isZero()) {
            out.push_back(std::move(torques));
        }
    }
    out.push_back(
        {"Where the energy went.",
         "time [s]",
         "energy [J]",
         {curve(seen.energy, "surfaces", "work of surfaces", "#111111"), curve(seen.energy, "gravity", "work of gravity", "#7f8c8d"),
          curve(seen.energy, "kinetic", "kinetic", "#0e8a93"), curve(seen.energy, "elastic", "elastic", "#1f4e79"),
          curve(seen.energy, "friction", "friction", "#b9770e"), curve(seen.energy, "dashpots", "impact", "#c0392b")},
         {}});
    return out;
}

std::vector<report::TextTable> tables_of(const Scene& scene, const ScenePlay& play, const SceneSeen& seen) {
    const Model& m = play.model();
    report::TextTable ledger{"Energy ledger at the end", {{"Term", "J", "What it is"}}};
    for (std::size_t k = 1; k < seen.energy.columns.size(); ++k) {
        ledger.rows.push_back(
            {seen.energy.columns[k].name, report::three_digits(seen.energy.rows.back()[k]), seen.energy.columns[k].meaning});
    }
    report::TextTable kinds{"Particles", {{"Kind", "Came", "Of", "What they are"}}};
    for (std::size_t k = 0; k < play.feed().counts().size(); ++k) {
        const auto& count = play.feed().counts()[k];
        const auto& kind = play.feed().kinds()[k];
        const std::string form = kind.forms.empty()
                                     ? "spheres"
                                     : fmt::format("clusters of up to {} spheres, {} forms", scene.particles[k].spheres, kind.forms.size());
        kinds.rows.push_back({count.name, fmt::format("{}", count.placed), fmt::format("{}", count.planned), form});
    }
    report::TextTable surfaces{"Surfaces", {{"Surface", "Faces", "Motion"}}};
    for (std::size_t k = 0; k < m.walls.surfaces.size(); ++k) {
        surfaces.rows.push_back(
            {m.walls.surfaces[k].name, fmt::format("{}", m.walls.surfaces[k].geometry.mesh.faces()), scene.surfaces[k].motion.kind});
    }
    const double sphere_steps = static_cast<double>(m.spheres.size()) * static_cast<double>(m.steps());
    const PhaseTimes& t = m.phase_times();
    report::TextTable provenance{
        "Provenance",
        {{"What", "Value"},
         {"Program", version_text()},
         {"Scene", scene.source},
         {"Steps", fmt::format("{} of {:.4g} s, {} searches, skin {:.3g} of the mean radius at the end", m.steps(), m.dt(), m.searches(),
                               m.skin() / mean_radius(play.feed().kinds()))},
         {"Wall time", fmt::format("{} on {} threads: {:.3g} steps of a sphere a second; searching {:.0f} %, forces {:.0f} %, motion "
                                   "{:.0f} %",
                                   Progress::duration(seen.seconds), omp_get_max_threads(), sphere_steps / std::max(seen.seconds, 1e-9),
                                   100.0 * t.search / (t.search + t.forces + t.motion), 100.0 * t.forces / (t.search + t.forces + t.motion),
                                   100.0 * t.motion / (t.search + t.forces + t.motion))},
         {"Final state", hex(m.state_hash())},
         {"To repeat", "proveta scene manifest.json --out NEW_FOLDER"},
         {"Written", now_utc()}}};
    return {kinds, surfaces, ledger, provenance};
}

} // namespace

report::Table particle_table(const Model& m) {
    report::Table t;
    t.notes = {"One row a sphere; the spheres of a cluster have its number in common."};
    t.columns = {{"particle", "", "number in the order of coming"},
                 {"kind", "", "number of the kind, from 0"},
                 {"x", "m", "centre"},
                 {"y", "m", "the same"},
                 {"z", "m", "the same"},
                 {"radius", "m", ""},
                 {"vx", "m/s", "velocity"},
                 {"vy", "m/s", "the same"},
                 {"vz", "m/s", "the same"}};
    const Spheres& s = m.spheres;
    for (std::size_t k = 0; k < s.size(); ++k) {
        t.rows.push_back({static_cast<double>(s.id[k]), static_cast<double>(s.group[k]), s.position.x[k], s.position.y[k], s.position.z[k],
                          s.radius[k], s.velocity.x[k], s.velocity.y[k], s.velocity.z[k]});
    }
    std::stable_sort(t.rows.begin(), t.rows.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
    return t;
}

report::Record scene_record(const Scene& scene, const ScenePlay& play, const SceneSeen& seen) {
    report::Record r;
    r.title = scene.title;
    r.subtitle = "Scene of loose particles among rigid surfaces";
    r.status = seen.status;
    r.stopped_by = seen.stopped_by;
    r.results = results_of(play, seen);
    r.key_figures = report::key_figures(r.results, {"particles", "mass", "rms_speed", "largest_overlap"});
    r.citation = citation("Scene", scene.title, resolved(scene));
    r.badges = {energy_badge(play.model())};
    if (seen.status != "complete") {
        r.warnings.push_back("This result is partial: " + seen.stopped_by + ".");
    }
    r.warnings.insert(r.warnings.end(), play.notes().begin(), play.notes().end());
    for (const auto& badge : r.badges) {
        if (!badge.good) {
            r.warnings.push_back(badge.name + ": " + badge.verdict + ".");
        }
    }
    for (const auto& body : play.model().walls.bodies) {
        if (body.crossings > 0) {
            r.warnings.push_back(
                fmt::format("{}: {} contacts of particles whose centre had got beyond its skin.", body.solid.name, body.crossings));
        }
    }
    if (const std::string made = coupling_warning(seen.energy); !made.empty()) {
        r.warnings.push_back(made);
    }
    for (const auto& count : play.feed().counts()) {
        if (count.left_out > 0) {
            r.warnings.push_back(fmt::format("{}: {} of {} would have reached into a surface or another particle and were left out.",
                                             count.name, count.left_out, count.planned));
        } else if (count.placed < count.planned) {
            r.warnings.push_back(fmt::format("{}: only {} of {} came in before the end.", count.name, count.placed, count.planned));
        }
    }
    if (const std::string soft = overlap_warning(play.model().largest_overlap()); !soft.empty()) {
        r.warnings.push_back(soft);
    }
    if (play.feed().lost() > 0) {
        r.warnings.push_back(fmt::format("{} particles left the domain and were taken out.", play.feed().lost()));
    }
    if (play.model().dt() < play.model().first_dt()) {
        r.warnings.push_back(fmt::format("The time step was shortened from {:.4g} s to {:.4g} s for faster impacts or stiffer contacts.",
                                         play.model().first_dt(), play.model().dt()));
    }
    for (std::size_t k = 0; k < scene.outlets.size(); ++k) {
        r.results.push_back({"taken_" + scene.outlets[k].name, "Taken out by " + scene.outlets[k].name,
                             static_cast<double>(play.feed().taken()[k]), "", "particles so far"});
    }
    r.plots = plots_of(play.model(), seen);
    r.pictures = seen.pictures;
    r.tables = tables_of(scene, play, seen);
    return r;
}

input::Json scene_summary(const report::Record& r, const ScenePlay& play) {
    const Model& m = play.model();
    input::Json j;
    j["title"] = r.title;
    j["status"] = r.status;
    j["stopped_by"] = r.stopped_by;
    for (const auto& s : r.results) {
        j["results"][s.name] = {{"value", *s.value}, {"unit", s.unit}, {"formula", s.formula}};
    }
    j["verdicts"] = verdicts_of(r.badges);
    j["warnings"] = r.warnings;
    j["steps"] = m.steps();
    j["searches"] = m.searches();
    j["time_step_s"] = m.dt();
    j["time_s"] = m.time();
    j["final_state_hash"] = hex(m.state_hash());
    return j;
}

} // namespace proveta
