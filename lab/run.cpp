#include "lab/run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>

#include "lab/fields.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/rate_check.hpp"
#include "lab/results.hpp"
#include "lab/test_run.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "specimens/checkpoint.hpp"

namespace proveta {

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Writes field files and keeps the series.
class FieldSeries {
  public:
    explicit FieldSeries(const OutputFolder& out) : out_(out) {}

    void write(const Bench& bench) {
        std::filesystem::create_directories(out_.path() / "fields");
        const auto one = [&](const char* part, const report::Geometry& geometry) {
            const std::string file = fmt::format("fields/{}_{:04}.vtp", part, count_);
            const std::lock_guard lock(file_libraries());
            report::write_vtp(out_.file(file), geometry);
            entries_.push_back({bench.model->time(), part, file});
        };
        one("spheres", sphere_fields(bench));
        one("bonds", bond_fields(bench));
        one("platens", platen_fields(bench));
        if (!bench.model->walls.bodies.empty()) {
            one("membrane", body_fields(*bench.model));
        }
        ++count_;
        report::write_file(out_.file("series.pvd"), report::to_pvd(entries_));
    }

  private:
    const OutputFolder& out_;
    int count_ = 0;
    std::vector<report::SeriesEntry> entries_;
};

std::string progress_line(const Bench& bench, const TestData& data, double done, double seconds) {
    const auto& row = data.curve.rows.back();
    const double rate = static_cast<double>(bench.model->steps()) / std::max(seconds, 1e-9);
    return fmt::format("strain {:.4f} %  stress {:.2f} MPa  broken {}  {:.0f} steps/s  {:.0f} %  at most {} left",
                       100.0 * row[data.curve.column("axial_strain")], 1e-6 * row[data.curve.column("axial_stress")], bench.model->broken(),
                       rate, 100.0 * done, Progress::duration(seconds * (1.0 / std::max(done, 1e-9) - 1.0)));
}

void save(const Deck& deck, const Bench& bench, const OutputFolder& out) {
    const std::lock_guard lock(file_libraries());
    save_checkpoint(*bench.model, resolved(deck).dump(), out.file("checkpoint.h5"));
}

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

Finished carry_out(const Deck& deck, Specimen specimen, OutputFolder& out, const std::string& command, const RunWatch& watch) {
    const std::string started = now_utc();
    const auto before_set_up = Clock::now();
    Bench bench = set_up(deck, std::move(specimen));
    log_set_up(bench, since(before_set_up), watch);

    out.begin();
    const std::string folder = out.path().string();
    report::write_json(out.file("manifest.json"), manifest(deck, bench, command, "running", started, folder));
    FieldSeries series(out);
    const auto loading = Clock::now();
    auto saved = Clock::now();
    TestHooks hooks;
    hooks.progress = [&](const TestData& data, double done) {
        if (!data.curve.rows.empty()) {
            watch.progress("loading", progress_line(bench, data, done, since(loading)), done);
        }
        if (deck.output.checkpoint_every > 0.0 && since(saved) > deck.output.checkpoint_every) {
            save(deck, bench, out);
            saved = Clock::now();
        }
    };
    hooks.fields = [&] { series.write(bench); };
    hooks.interrupted = interrupted;
    TestData data = run_protocol(deck, bench, hooks);
    const double seconds = since(loading);
    if (deck.protocol->checks_rate() && data.failure.empty() && !data.interrupted) {
        data.rate_check = check_rate(deck, bench.specimen, data.curve, interrupted, [&](const TestData& again, double done) {
            if (!again.curve.rows.empty()) {
                watch.progress("half-rate check", progress_line(bench, again, done, since(loading)), done);
            }
        });
    }

    const RunStatus status = !data.failure.empty() ? RunStatus::failed : data.interrupted ? RunStatus::interrupted : RunStatus::complete;
    report::write_file(out.file("curve.csv"), report::to_csv(data.curve));
    report::write_file(out.file("energy.csv"), report::to_csv(data.energy));
    report::write_file(out.file("events.csv"), report::to_csv(event_table(data.events)));
    const AcousticRule rule = acoustic_rule(bench);
    const auto acoustic = acoustic_events(data.events, rule);
    report::write_file(out.file("acoustic.csv"), report::to_csv(acoustic_table(acoustic, rule)));
    if (status != RunStatus::failed) { // a failed state is not worth going on from
        save(deck, bench, out);
    }
    report::Record record = make_record(deck, bench, data, acoustic, name(status));
    report::write_json(out.file("manifest.json"), manifest(deck, bench, command, name(status), started, folder));
    report::write_file(out.file("report.html"), report::to_html(record));
    report::write_json(out.file("summary.json"), summary(record, bench, data, seconds));
    return {status, std::move(record), main_curve(*deck.protocol, data)};
}

RunStatus run_test(const Deck& deck, const RunOptions& options) {
    OutputFolder out(options.out);
    Progress progress(options.quiet);
    const auto clock = Clock::now();
    const auto log = [&](const std::string& line) {
        progress.end_line();
        if (!options.quiet) {
            spdlog::info("{}", line);
        }
    };
    Specimen specimen = obtain_specimen(deck.specimen, deck.folder, deck.source,
                                        [&](double done) { progress.show(fmt::format("making the specimen  {:.0f} %", 100.0 * done)); });
    log(fmt::format("specimen of {} {} ready after {:.1f} s", specimen.size(), specimen.stones.empty() ? "spheres" : "stones",
                    since(clock)));
    const auto show = [&](const std::string& phase, const std::string& figures, double) {
        progress.show(phase == "loading" ? figures : phase + ": " + figures);
    };
    const Finished finished = carry_out(deck, std::move(specimen), out, options.command, {show, log});
    progress.end_line();
    fmt::print("{}", as_text(finished.record));
    fmt::print("results in {}\n", out.path().string());
    return finished.status;
}

} // namespace proveta
