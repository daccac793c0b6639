#include "lab/run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/files/whole_file.hpp"
#include "lab/checks.hpp"
#include "lab/clock.hpp"
#include "lab/fields.hpp"
#include "lab/keeper.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/rate_check.hpp"
#include "lab/results.hpp"
#include "lab/summary.hpp"
#include "lab/test_run.hpp"
#include "lab/test_tables.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "reports/paraview.hpp"

namespace proveta {

namespace {

void write_picture(const OutputFolder& out, const std::string& name, const std::string& png) {
    make_folder(out.file("pictures"));
    report::write_file(out.file("pictures/" + name), png);
}

// Writes field files and keeps the series.
class FieldSeries {
  public:
    explicit FieldSeries(const OutputFolder& out) : out_(out) {}

    // stills: height of a picture in pixels; 0: none.
    void write(const Bench& bench, std::int64_t stills) {
        make_folder(out_.file("fields"));
        std::vector<std::string> parts{"spheres", "bonds", "platens"};
        std::vector<report::Geometry> geometry{sphere_fields(bench), bond_fields(bench), platen_fields(bench)};
        if (!bench.model->walls.bodies.empty()) {
            parts.emplace_back("membrane");
            geometry.push_back(body_fields(*bench.model));
        }
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const std::lock_guard lock(file_libraries());
            report::write_vtp(out_.file(name(parts[p], times_.size())), geometry[p]);
        }
        if (stills > 0) {
            write_picture(out_, fmt::format("still_{:04}.png", times_.size()),
                          still(bench, snapshot(*bench.model, "", ""), static_cast<int>(stills)));
        }
        times_.push_back(bench.model->time());
        std::vector<report::SeriesEntry> entries;
        for (std::size_t k = 0; k < times_.size(); ++k) {
            for (const auto& part : parts) {
                entries.push_back({times_[k], part, name(part, k)});
            }
        }
        report::write_file(out_.file("series.pvd"), report::to_pvd(entries));
        for (const auto& part : parts) { // each part alone too, as scripts want it
            std::vector<report::SeriesEntry> alone;
            std::copy_if(entries.begin(), entries.end(), std::back_inserter(alone), [&](const auto& entry) { return entry.part == part; });
            report::write_file(out_.file(part + ".pvd"), report::to_pvd(alone));
        }
        report::write_file(out_.file("views.py"), report::paraview_script());
    }

    void visit_state(StateVisitor& visit) { visit("field_times", times_); }

  private:
    static std::string name(const std::string& part, std::size_t k) { return fmt::format("fields/{}_{:04}.vtp", part, k); }

    const OutputFolder& out_;
    std::vector<double> times_; // of the files written so far, s
};

std::string progress_line(const Bench& bench, const TestData& data, double done, double seconds) {
    const auto& row = data.curve.rows.back();
    const double rate = static_cast<double>(bench.model->steps()) / std::max(seconds, 1e-9);
    return fmt::format("strain {:.4f} %  stress {:.2f} MPa  broken {}  {:.0f} steps/s  {:.0f} %  {}",
                       100.0 * row[data.curve.column("axial_strain")], 1e-6 * row[data.curve.column("axial_stress")], bench.model->broken(),
                       rate, 100.0 * done, Progress::left(seconds, done));
}

// Has a test kept, every so many seconds and where it must be, unless it is only reported, and restored if it is to go on.
void attach(Keeper& keeper, TestHooks& hooks, Passage passage) {
    if (passage != Passage::report) {
        hooks.keep = [&keeper](const VisitState& state, bool must) {
            if (must || keeper.due()) {
                keeper.save(state);
            }
        };
    }
    if (passage != Passage::begin && keeper.there()) {
        hooks.restore = [&keeper](const VisitState& state) { keeper.restore(state); };
    }
}

// Which test a checkpoint is of: deck and specimen, to the bit.
std::string owner_of(const Deck& deck, const Bench& bench) { return hash_of_text(resolved(deck).dump()) + " " + hex(bench.specimen_hash); }

void log_set_up(const Bench& bench, double seconds, const RunWatch& watch) {
    const std::string matter =
        bench.model->bonds.size() > 0
            ? fmt::format("{} bonds, {:.2f} a sphere", bench.model->bonds.size(), bench.coordination)
            : fmt::format("{} loose spheres in {} stones", bench.model->spheres.size(), bench.model->clusters.size());
    watch.log(fmt::format("{}; step {:.3g} s of at most {:.3g} s; set up in {:.1f} s", matter, bench.model->dt(),
                          bench.model->stable_step(), seconds));
    for (const auto& calibration : bench.calibrations) {
        watch.log(fmt::format("elasticity of {}: {}", calibration.name, text_of(calibration.result)));
    }
    if (const auto& scaling = bench.model->mass_scaling(); scaling.spheres > 0) {
        watch.log(text_of(scaling));
    }
}

} // namespace

const char* name(RunStatus status) {
    return status == RunStatus::complete ? "complete" : status == RunStatus::interrupted ? "interrupted" : "failed";
}

std::mutex& file_libraries() {
    static std::mutex mutex;
    return mutex;
}

Finished carry_out(const Deck& deck, Specimen specimen, OutputFolder& out, const std::string& command, const RunWatch& watch,
                   Passage passage) {
    const auto before_set_up = Clock::now();
    Bench bench = set_up(deck, std::move(specimen));
    log_set_up(bench, since(before_set_up), watch);
    for (const auto& warning : passage == Passage::begin ? warnings_in_press(bench, deck) : std::vector<std::string>{}) {
        watch.warn(warning);
    }

    if (passage == Passage::begin && interrupted()) {
        throw StoppedBefore();
    }
    const std::string owner = owner_of(deck, bench); // before anything is cleared: a text may be none that can be written
    input::Json sheet = manifest(deck, bench, command, out.path().string());
    const bool go_on = passage != Passage::begin;
    if (go_on) {
        out.go_on();
        sheet = manifest_to_go_on_with(out.file("manifest.json"), sheet, passage == Passage::go_on);
    } else {
        out.begin();
    }
    const auto write_manifest = [&](const char* status) {
        sheet["status"] = status;
        out.write_manifest(sheet);
    };
    if (passage != Passage::report) { // which changes nothing before it has succeeded
        write_manifest("running");
    }

    FieldSeries series(out);
    double before = 0.0; // seconds of loading in earlier processes
    const auto loading = Clock::now();
    Keeper keeper(out, "checkpoint.h5", owner, deck.output.checkpoint_every, [&](StateVisitor& visit) {
        double seconds = before + since(loading);
        visit("seconds_of_loading", seconds);
        before = seconds - since(loading);
        series.visit_state(visit);
    });
    TestHooks hooks;
    hooks.progress = [&](const TestData& data, double done) {
        if (!data.curve.rows.empty()) {
            watch.progress("loading", progress_line(bench, data, done, before + since(loading)), done);
        }
    };
    hooks.fields = [&] { series.write(bench, deck.output.pictures); };
    // Who only reports stops where the checkpoint was made.
    hooks.interrupted = passage == Passage::report ? [] { return true; } : +[] { return interrupted(); };
    attach(keeper, hooks, passage);
    if (passage == Passage::report && !hooks.restore) {
        throw input::InputError({{out.path().string(), "", "no checkpoint", "a folder with one, from which a report can be made", ""}});
    }
    if (passage == Passage::go_on) {
        watch.log(hooks.restore ? "going on from the last checkpoint" : "no checkpoint yet: the test begins anew");
    }
    TestData data = run_protocol(deck, bench, hooks);
    if (deck.protocol->checks_rate() && data.failure.empty() && !data.interrupted) {
        Keeper of_check(out, "rate_check.h5", owner, deck.output.checkpoint_every, [](StateVisitor&) {});
        TestHooks again;
        again.progress = [&](const TestData& slow, double done) {
            if (!slow.curve.rows.empty()) {
                watch.progress("half-rate check", progress_line(bench, slow, done, before + since(loading)), done);
            }
        };
        again.interrupted = hooks.interrupted;
        attach(of_check, again, passage);
        data.rate_check = check_rate(deck, bench.specimen, data.curve, again);
        data.interrupted = !data.rate_check && hooks.interrupted();
    }
    data.seconds = before + since(loading);
    if (passage != Passage::report) {
        sheet["wall_time_of_loading_s"] = data.seconds;
    }

    const RunStatus status = !data.failure.empty() ? RunStatus::failed : data.interrupted ? RunStatus::interrupted : RunStatus::complete;
    report::write_file(out.file("curve.csv"), report::to_csv(data.curve));
    report::write_file(out.file("energy.csv"), report::to_csv(data.energy));
    report::write_file(out.file("events.csv"), report::to_csv(event_table(data.events)));
    const AcousticRule rule = acoustic_rule(bench);
    const auto acoustic = acoustic_events(data.events, rule);
    report::write_file(out.file("acoustic.csv"), report::to_csv(acoustic_table(acoustic, rule)));
    report::Record record = make_record(deck, bench, data, acoustic, name(status));
    if (const std::string warning = physics_warning(sheet); !warning.empty()) {
        record.warnings.push_back(warning);
    }
    if (deck.output.pictures > 0) {
        for (const auto& portrait : portraits(bench, data.moments, static_cast<int>(deck.output.pictures))) {
            write_picture(out, portrait.file, portrait.portrait.png);
        }
        constexpr int on_page = 380; // pixels
        for (auto& [file, portrait] : portraits(bench, data.moments, on_page)) {
            if (file != "past_peak_displacement.png" && file != "past_peak_sideways.png" &&
                file != "peak_cracks.png") { // a page that can still be sent by mail
                record.portraits.push_back(std::move(portrait));
            }
        }
    }
    report::write_file(out.file("report.html"), report::to_html(record));
    report::write_json(out.file("summary.json"), summary(record, bench, data));
    write_manifest(name(status)); // the last: who finds it complete finds all of it
    return {status, std::move(record), main_curve(*deck.protocol, data), data.seconds};
}

namespace {

RunStatus make_and_test(const Deck& deck, const RunOptions& options) {
    OutputFolder out(options.out);
    Progress progress(options.quiet);
    const auto clock = Clock::now();
    const auto log = [&](const std::string& line) {
        progress.end_line();
        if (!options.quiet) {
            spdlog::info("{}", line);
        }
    };
    const auto warn = [&](const std::string& line) {
        progress.end_line();
        spdlog::warn("{}", line);
    };
    for (const auto& warning : options.passage == Passage::begin ? warnings_of_deck(deck) : std::vector<std::string>{}) {
        warn(warning);
    }
    Specimen specimen = obtain_specimen(deck.specimen, deck.folder, deck.source, [&](double done) {
        if (options.passage == Passage::begin && interrupted()) {
            throw StoppedBefore();
        }
        progress.show(fmt::format("making the specimen  {:.0f} %", 100.0 * done));
    });
    log(fmt::format("specimen of {} {} ready after {:.1f} s", specimen.size(), specimen.stones.empty() ? "spheres" : "stones",
                    since(clock)));
    if (options.passage == Passage::begin && interrupted()) {
        throw StoppedBefore();
    }
    const auto show = [&](const std::string& phase, const std::string& figures, double) {
        progress.show(phase == "loading" ? figures : phase + ": " + figures);
    };
    const Finished finished = with_way_on(out, [&] {
        return carry_out(deck, std::move(specimen), out, options.command, {show, log, warn}, options.passage);
    });
    progress.end_line();
    fmt::print("{}", as_text(finished.record));
    fmt::print("results in {}\n", out.path().string());
    if (finished.status == RunStatus::interrupted) {
        spdlog::warn("interrupted; to go on: proveta resume {}", out.path().string());
    }
    return finished.status;
}

} // namespace

RunStatus run_test(const Deck& deck, const RunOptions& options) {
    try {
        return make_and_test(deck, options);
    } catch (const StoppedBefore& e) {
        spdlog::warn("{}", e.what());
        return RunStatus::interrupted;
    }
}

} // namespace proveta
