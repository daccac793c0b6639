#include "lab/calibrate/calibrate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "lab/calibrate/calibrate_plots.hpp"
#include "lab/citation.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/trials/verdicts.hpp"

namespace proveta {

namespace {

using report::TextTable;

// A value in the unit that people use.
std::string shown(const std::string& name, double value, const std::string& unit) {
    const auto r = report::readable({name, "", value, unit, ""});
    return report::three_digits(r.value.value_or(value)) + (r.unit.empty() ? "" : " " + r.unit);
}

// A result in the unit that its jobs give it.
std::string shown_result(double value, const Target& target, const TrialResult& trial) {
    for (const auto& job : trial.jobs) {
        const auto unit = job.units.find(target.input.result);
        if (job.test == target.input.test && unit != job.units.end()) {
            return shown(target.input.result, value, unit->second);
        }
    }
    return shown(target.input.result, value, "");
}

TextTable targets_table(const std::vector<Target>& targets, const CalibrationOutcome& outcome, const TrialFolders& folders, bool fitted) {
    TextTable table{fitted ? "Targets and what the card gives" : "Predictions of what was left out of the fit",
                    {{"Target", "Kind", "Wanted", "Found", "Deviation", "Tolerance", "Met"}}};
    for (const auto& t : targets) {
        if (t.input.fitted() != fitted) {
            continue;
        }
        const TrialResult& trial = result_for(t, targets, outcome);
        const Comparison c = compare(t, trial, folders);
        const bool curve = t.input.is_curve();
        table.rows.push_back({t.input.title(), t.input.kind, curve ? "curve" : shown_result(t.input.value, t, trial),
                              !c.found ? "not determined"
                              : curve  ? "curve"
                                       : shown_result(c.value, t, trial),
                              c.found ? fmt::format("{:+.1f} %{}", 100.0 * c.distance, curve ? " rms" : "") : "",
                              fmt::format("{:.3g} %", 100.0 * t.input.tolerance),
                              c.found && std::fabs(c.distance) <= t.input.tolerance ? "yes" : "no"});
    }
    return table;
}

constexpr double hardly_told = 0.25; // standard error over the range

// A position between a parameter's bounds that is one of them.
bool at_bound(double u) { return u < 0.02 || u > 0.98; }

std::string range_of(const Parameter& p) {
    const std::string unit = p.times.empty() ? p.unit : "";
    return fmt::format("{} to {}", shown(p.name, p.low, unit), shown(p.name, p.high, unit));
}

// What keeps the card from being taken at its word.
std::vector<std::string> doubts(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                                const TrialFolders& folders) {
    std::vector<std::string> out;
    for (const auto& t : targets) {
        const TrialResult& trial = result_for(t, targets, outcome);
        const Comparison c = compare(t, trial, folders);
        if (!c.found || std::fabs(c.distance) > t.input.tolerance) {
            const std::string found = !c.found ? "not determined"
                                      : t.input.is_curve()
                                          ? fmt::format("{:.1f} % off (root mean square)", 100.0 * c.distance)
                                          : fmt::format("{} where {} is wanted ({:+.1f} %)", shown_result(c.value, t, trial),
                                                        shown_result(t.input.value, t, trial), 100.0 * c.distance);
            out.push_back(fmt::format("{} missed, {}: {}; its tolerance is {:.3g} %.", t.input.fitted() ? "Target" : "Prediction",
                                      t.input.title(), found, 100.0 * t.input.tolerance));
        }
    }
    const auto& best = outcome.best_trial();
    const auto own = plan.space.values(best.u);
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
        const auto& p = plan.space[k];
        const std::string value = p.name + " = " + shown(p.name, own[k], p.times.empty() ? p.unit : "");
        if (at_bound(best.u[k])) {
            out.push_back(fmt::format("{} is at a bound of {}: the best may lie beyond; widen it.", value, range_of(p)));
        }
        if (outcome.confidence && outcome.confidence->standard_error[k] > hardly_told) {
            out.push_back(fmt::format("{} is hardly told by these targets: its standard error is {}.", value,
                                      outcome.confidence->standard_error[k] > 1.0
                                          ? std::string("more than its whole range")
                                          : fmt::format("{:.0f} % of its range", 100.0 * outcome.confidence->standard_error[k])));
        }
    }
    if (outcome.confidence && best.deviations.score() < outcome.confidence->noise_of_score) {
        out.push_back(
            fmt::format("The score of {} lies below its noise floor of {}: by as much single specimens of one card differ, so that "
                        "the targets cannot tell this card from others near it.",
                        report::three_digits(best.deviations.score()), report::three_digits(outcome.confidence->noise_of_score)));
    }
    return out;
}

TextTable parameters_table(const CalibrationPlan& plan, const CalibrationOutcome& outcome) {
    TextTable table{"Parameters", {{"Parameter", "Value", "Bounds", "Standard error", "Remark"}}};
    const auto& best = outcome.best_trial();
    const auto own = plan.space.values(best.u);
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
        const auto& p = plan.space[k];
        const std::string unit = p.times.empty() ? p.unit : "";
        std::string error;
        std::string remark;
        if (outcome.confidence) {
            const double e = outcome.confidence->standard_error[k];
            error = e > 0.5 ? "more than half the range"
                            : "\u00b1 " + shown(p.name, 0.5 * std::fabs(p.at(best.u[k] + e) - p.at(best.u[k] - e)), unit);
            remark = e > hardly_told ? "hardly told by these targets" : "";
        }
        if (at_bound(best.u[k])) {
            remark += std::string(remark.empty() ? "" : "; ") + "at a bound: widen it";
        }
        table.rows.push_back(
            {p.name + (p.times.empty() ? "" : " (times " + p.times + ")"), shown(p.name, own[k], unit), range_of(p), error, remark});
    }
    return table;
}

TextTable correlation_table(const CalibrationPlan& plan, const Confidence& c) {
    TextTable table{"Correlation of the parameters' errors (1: only their difference is known; -1: only their sum)", {{""}}};
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
        table.rows.front().push_back(plan.space[k].name);
    }
    for (std::size_t a = 0; a < plan.space.size(); ++a) {
        std::vector<std::string> row{plan.space[a].name};
        for (std::size_t b = 0; b < plan.space.size(); ++b) {
            row.push_back(fmt::format("{:.2f}", c.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b))));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

TextTable rounds_table(const CalibrationOutcome& outcome) {
    TextTable table{"Rounds on whole specimens", {{"Round", "Score expected from small specimens", "Score found"}}};
    for (std::size_t k = 0; k < outcome.rounds.size(); ++k) {
        table.rows.push_back(
            {std::to_string(k + 1), report::three_digits(outcome.rounds[k].expected), report::three_digits(outcome.rounds[k].score)});
    }
    return table;
}

// What the targets and the data were taken to be.
TextTable statement_table(const std::vector<Target>& targets) {
    TextTable table{"What the targets are", {{"Target", "Use", "Kind", "Source", "How it was read"}}};
    for (const auto& t : targets) {
        const auto& in = t.input;
        const std::string how =
            in.is_curve() ? fmt::format("{}; strain offset {:.3g} taken off; x from {:.4g} to {:.4g}", fmt::join(t.file.notes, "; "),
                                        in.x_offset, t.file.compared.x.front(), t.file.compared.x.back())
                          : "as given";
        table.rows.push_back({in.title(), in.use, in.kind, in.source, how});
    }
    return table;
}

} // namespace

TextTable trials_table(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                       const TrialFolders& folders) {
    TextTable table{"One row a trial. Parameters as written into the decks, SI; score in tolerances; results SI, of a curve its relative "
                    "root mean square distance",
                    {{"trial", "phase", "specimens"}}};
    auto& heading = table.rows.front();
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
        heading.push_back(plan.space[k].name);
    }
    heading.emplace_back("score");
    for (const auto& t : targets) {
        if (t.input.fitted()) {
            heading.push_back(t.input.title());
        }
    }
    heading.emplace_back("failures");
    for (std::size_t k = 0; k < outcome.trials.size(); ++k) {
        const auto& trial = outcome.trials[k];
        std::vector<std::string> row{std::to_string(k + 1), trial.phase, trial.whole ? "whole" : "small"};
        for (const double v : trial.result.values) {
            row.push_back(fmt::format("{:.9g}", v));
        }
        row.push_back(fmt::format("{:.6g}", trial.deviations.score()));
        for (const auto& t : targets) {
            if (t.input.fitted()) {
                const Comparison c = compare(t, trial.result, folders);
                row.push_back(!c.found ? "" : fmt::format("{:.9g}", t.input.is_curve() ? c.distance : c.value));
            }
        }
        std::string failures;
        for (const auto& job : trial.result.jobs) {
            failures += job.status == "complete" ? "" : job.name + ": " + job.reason + "; ";
        }
        row.push_back(failures);
        table.rows.push_back(std::move(row));
    }
    return table;
}

report::Record calibration_record(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                                  const TrialFolders& folders) {
    const auto& best = outcome.best_trial();
    report::Record r;
    r.title = plan.input.title;
    r.subtitle = fmt::format("calibration of {} parameters on {} tests", plan.space.size(), plan.tests.size());
    r.status = "complete";
    std::size_t failed = 0;
    for (const auto& t : outcome.trials) {
        failed += t.deviations.complete ? 0 : 1;
    }
    r.stopped_by = fmt::format("{} trials, of which {} did not give every target", outcome.trials.size(), failed);
    r.overview = {targets_table(targets, outcome, folders, true)};
    for (const auto& [kind, what] : {std::pair{"estimate", "an estimate"}, {"computed", "a calculation"}}) {
        std::vector<std::string> titles;
        for (const auto& t : targets) {
            if (t.input.kind == kind) {
                titles.push_back(t.input.title());
            }
        }
        if (!titles.empty()) {
            r.warnings.push_back(fmt::format("Each of these targets is {}, not a measurement: {}.", what, fmt::join(titles, "; ")));
        }
    }
    for (const auto& t : targets) {
        for (const auto& warning : t.file.warnings) {
            r.warnings.push_back(t.input.title() + ": " + warning + ".");
        }
    }
    if (std::any_of(targets.begin(), targets.end(), [](const Target& t) { return !t.input.fitted(); })) {
        r.overview.push_back(targets_table(targets, outcome, folders, false));
    }
    r.overview.push_back(parameters_table(plan, outcome));
    if (!best.deviations.complete) {
        r.warnings.emplace_back("The best trial lacks results that targets speak of.");
    }
    for (const auto& job : best.result.jobs) {
        if (job.status == "complete" && !job.quasi_static) {
            r.warnings.push_back(job.name + " of the best trial was not quasi-static by its own verdict.");
        }
    }
    for (auto& doubt : doubts(plan, targets, outcome, folders)) {
        r.warnings.push_back(std::move(doubt));
    }
    double seconds = outcome.predictions.seconds();
    for (const auto& t : outcome.trials) {
        seconds += t.result.seconds();
    }
    r.results.push_back({"score", "Score of the card", best.deviations.score(), "",
                         "weighted root mean square deviation from the fitted targets, in tolerances"});
    if (outcome.confidence) {
        r.results.push_back({"noise_of_score", "Noise floor of the score", outcome.confidence->noise_of_score, "",
                             "root mean square of what single small specimens of one card differ by, in tolerances"});
    }
    std::size_t fitted = 0;
    std::size_t met = 0;
    for (const auto& t : targets) {
        const Comparison c = compare(t, result_for(t, targets, outcome), folders);
        fitted += t.input.fitted() ? 1 : 0;
        met += t.input.fitted() && c.found && std::fabs(c.distance) <= t.input.tolerance ? 1 : 0;
    }
    r.key_figures = {{"Targets met", fmt::format("{} of {}", met, fitted), "", "within their tolerances"},
                     {"Score", fmt::format("{:.3g}", best.deviations.score()), "tolerances", "root mean square deviation"}};
    const auto values = plan.space.values(best.u);
    for (std::size_t k = 0; k < std::min<std::size_t>(plan.space.size(), 2); ++k) {
        const auto& p = plan.space[k];
        const std::string unit = p.times.empty() ? p.unit : "";
        const auto read = report::readable({p.name, "", values[k], unit, ""});
        r.key_figures.push_back({p.name + (p.times.empty() ? "" : " over " + p.times), report::three_digits(read.value.value_or(values[k])),
                                 read.unit, "sought from " + range_of(p)});
    }
    r.citation = citation("Calibration", plan.input.title, plan.written);
    r.plots = curve_plots(targets, outcome, folders);
    r.plots.push_back(progress_plot(outcome));
    if (outcome.confidence) {
        r.plots.push_back(profile_plot(plan, *outcome.confidence));
        r.tables.push_back(correlation_table(plan, *outcome.confidence));
    }
    if (!outcome.rounds.empty()) {
        r.tables.push_back(rounds_table(outcome));
    }
    r.tables.push_back(statement_table(targets));
    r.tables.push_back({"Provenance",
                        {{"What", "Value"},
                         {"Program", version_text()},
                         {"Calibration", plan.source},
                         {"Wall time", Progress::duration(seconds) + " of all trials together"},
                         {"Every trial", "ledger.jsonl, trials.csv and the folders in trials"},
                         {"To repeat", "proveta calibrate manifest.json --out NEW_FOLDER"}}});
    return r;
}

input::Json calibration_summary(const CalibrationPlan& plan, const std::vector<Target>& targets, const CalibrationOutcome& outcome,
                                const report::Record& record, const input::Json& card) {
    input::Json j{{"title", plan.input.title}, {"status", record.status}, {"stopped_by", record.stopped_by}};
    for (const auto& s : record.results) {
        j["results"][s.name] = {{"value", s.value ? input::Json(*s.value) : input::Json()}, {"unit", s.unit}, {"formula", s.formula}};
    }
    for (const auto& t : targets) {
        if (t.input.is_curve()) {
            j["curves"].push_back({{"target", t.input.title()},
                                   {"file", std::filesystem::path(t.input.curve).filename().string()},
                                   {"read", t.file.notes},
                                   {"toe_strain", t.file.toe},
                                   {"warnings", t.file.warnings}});
        }
    }
    j["verdicts"] = verdicts_of({outcome.best_trial().result, outcome.predictions});
    j["evidence"] = card["evidence"];
    j["warnings"] = record.warnings;
    return j;
}

} // namespace proveta
