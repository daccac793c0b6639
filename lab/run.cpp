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

const char* name(RunStatus status) {
    return status == RunStatus::complete ? "complete" : status == RunStatus::interrupted ? "interrupted" : "failed";
}

// Writes field files and keeps the series.
class FieldSeries {
  public:
    explicit FieldSeries(const OutputFolder& out) : out_(out) {}

    void write(const Bench& bench) {
        std::filesystem::create_directories(out_.path() / "fields");
        const auto one = [&](const char* part, const report::Geometry& geometry) {
            const std::string file = fmt::format("fields/{}_{:04}.vtp", part, count_);
            report::write_vtp(out_.file(file), geometry);
            entries_.push_back({bench.model->time(), part, file});
        };
        one("spheres", sphere_fields(bench));
        one("bonds", bond_fields(bench));
        one("platens", platen_fields(bench));
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

} // namespace

RunStatus run_test(const Deck& deck, const RunOptions& options) {
    OutputFolder out(options.out);
    Progress progress(options.quiet);
    const std::string started = now_utc();
    const auto clock = Clock::now();

    Specimen specimen = obtain_specimen(deck.specimen, deck.folder, deck.source,
                                        [&](double done) { progress.show(fmt::format("making the specimen  {:.0f} %", 100.0 * done)); });
    progress.end_line();
    if (!options.quiet) {
        spdlog::info("specimen of {} spheres ready after {:.1f} s", specimen.size(), since(clock));
    }
    const auto before_set_up = Clock::now();
    Bench bench = set_up(deck, std::move(specimen));
    if (!options.quiet) {
        spdlog::info("{} bonds, {:.2f} a sphere; step {:.3g} s of at most {:.3g} s; set up in {:.1f} s", bench.model->bonds.size(),
                     bench.coordination, bench.model->dt(), bench.model->stable_step(), since(before_set_up));
        if (const auto& scaling = bench.model->mass_scaling(); scaling.spheres > 0) {
            spdlog::info("{}", text_of(scaling));
        }
    }

    out.begin();
    const std::string folder = out.path().string();
    report::write_json(out.file("manifest.json"), manifest(deck, bench, options.command, "running", started, folder));
    FieldSeries series(out);
    const auto loading = Clock::now();
    auto saved = Clock::now();
    TestHooks hooks;
    hooks.progress = [&](const TestData& data, double done) {
        if (!data.curve.rows.empty()) {
            progress.show(progress_line(bench, data, done, since(loading)));
        }
        if (deck.output.checkpoint_every > 0.0 && since(saved) > deck.output.checkpoint_every) {
            save_checkpoint(*bench.model, resolved(deck).dump(), out.file("checkpoint.h5"));
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
                progress.show("half-rate check: " + progress_line(bench, again, done, since(loading)));
            }
        });
    }
    progress.end_line();

    const RunStatus status = !data.failure.empty() ? RunStatus::failed : data.interrupted ? RunStatus::interrupted : RunStatus::complete;
    report::write_file(out.file("curve.csv"), report::to_csv(data.curve));
    report::write_file(out.file("energy.csv"), report::to_csv(data.energy));
    report::write_file(out.file("events.csv"), report::to_csv(event_table(data.events)));
    const AcousticRule rule = acoustic_rule(bench);
    const auto acoustic = acoustic_events(data.events, rule);
    report::write_file(out.file("acoustic.csv"), report::to_csv(acoustic_table(acoustic, rule)));
    if (status != RunStatus::failed) { // a failed state is not worth going on from
        save_checkpoint(*bench.model, resolved(deck).dump(), out.file("checkpoint.h5"));
    }
    const report::Record record = make_record(deck, bench, data, acoustic, name(status));
    report::write_json(out.file("manifest.json"), manifest(deck, bench, options.command, name(status), started, folder));
    report::write_file(out.file("report.html"), report::to_html(record));
    report::write_json(out.file("summary.json"), summary(record, bench, data, seconds));
    fmt::print("{}", as_text(record));
    fmt::print("results in {}\n", folder);
    return status;
}

} // namespace proveta
