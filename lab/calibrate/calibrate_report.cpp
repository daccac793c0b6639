#include "lab/calibrate/calibrate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "lab/citation.hpp"
#include "lab/provenance.hpp"
#include "lab/trials/verdicts.hpp"

namespace proveta {

namespace {

using report::Curve;
using report::CurveStyle;
using report::Plot;
using report::TextTable;

// A value in the unit that people use.
std::string shown(double value, const std::string& unit) {
    const auto r = report::readable({"", "", value, unit, ""});
    return fmt::format("{:.4g}{}{}", r.value.value_or(value), r.unit.empty() ? "" : " ", r.unit);
}

// A result in the unit that its jobs give it.
std::string shown_result(double value, const Target& target, const TrialResult& trial) {
    for (const auto& job : trial.jobs) {
        const auto unit = job.units.find(target.input.result);
        if (job.test == target.input.test && unit != job.units.end()) {
            return shown(value, unit->second);
        }
    }
    return shown(value, "");
}

const TrialResult& result_for(const Target& target, const std::vector<Target>& targets, const CalibrationOutcome& outcome) {
    for (const auto& t : targets) {
        if (t.input.test == target.input.test && t.input.fitted()) {
            return outcome.best_trial().result;
        }
    }
    return outcome.predictions;
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
            error = "+- " + shown(0.5 * std::fabs(p.at(best.u[k] + e) - p.at(best.u[k] - e)), unit);
            remark = e > 0.25 ? "hardly told by these targets" : "";
        }
        if (best.u[k] < 0.02 || best.u[k] > 0.98) {
            remark += std::string(remark.empty() ? "" : "; ") + "at a bound: widen it";
        }
        table.rows.push_back({p.name + (p.times.empty() ? "" : " (times " + p.times + ")"), shown(own[k], unit),
                              fmt::format("{} to {}", shown(p.low, unit), shown(p.high, unit)), error, remark});
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
            {std::to_string(k + 1), fmt::format("{:.3f}", outcome.rounds[k].expected), fmt::format("{:.3f}", outcome.rounds[k].score)});
    }
    return table;
}

Plot progress_plot(const CalibrationOutcome& outcome) {
    Plot plot{"The search: score (weighted root mean square deviation, in tolerances)", "trial", "score", {}, {}};
    Curve small{"small specimens", {}, {}, "#9aa5b1", CurveStyle::points};
    Curve best{"best so far", {}, {}, "#1f4e79"};
    Curve whole{"whole specimens", {}, {}, "#c0392b", CurveStyle::points};
    double least = INFINITY;
    for (std::size_t k = 0; k < outcome.trials.size(); ++k) {
        const auto& t = outcome.trials[k];
        if (!t.deviations.complete) {
            continue;
        }
        const double score = std::min(t.deviations.score(), missing_deviation);
        (t.whole ? whole : small).x.push_back(static_cast<double>(k + 1));
        (t.whole ? whole : small).y.push_back(score);
        if (!t.whole && score < least) {
            least = score;
            best.x.push_back(static_cast<double>(k + 1));
            best.y.push_back(score);
        }
    }
    plot.curves = {small, best, whole};
    return plot;
}

Plot profile_plot(const CalibrationPlan& plan, const Confidence& c) {
    Plot plot{"Profiles: score with one parameter moved, the others at the best (small specimens, corrected)",
              "position between the parameter's bounds",
              "score",
              {},
              {}};
    for (std::size_t k = 0; k < c.profiles.size(); ++k) {
        Curve curve{plan.space[k].name, {}, {}};
        tell_apart(curve, k);
        for (std::size_t p = 0; p < c.profiles[k].u.size(); ++p) {
            if (std::isfinite(c.profiles[k].score[p])) {
                curve.x.push_back(c.profiles[k].u[p]);
                curve.y.push_back(c.profiles[k].score[p]);
            }
        }
        plot.curves.push_back(std::move(curve));
    }
    plot.x_from_zero = true;
    return plot;
}

std::string axis_of(const std::string& quantity) {
    return quantity == "total_stress"        ? "total axial stress [MPa]"
           : quantity == "deviatoric_stress" ? "deviatoric stress [MPa]"
           : quantity == "axial_strain"      ? "axial strain, platens [%]"
           : quantity == "gauge_strain"      ? "axial strain, gauge [%]"
           : quantity == "volumetric_strain" ? "volumetric strain [%]"
                                             : "circumferential strain [%]";
}

double scale_of(const std::string& quantity) { return quantity.ends_with("stress") ? 1e-6 : 100.0; }

std::vector<Plot> curve_plots(const std::vector<Target>& targets, const CalibrationOutcome& outcome, const TrialFolders& folders) {
    std::vector<Plot> out;
    for (const auto& t : targets) {
        if (!t.input.is_curve()) {
            continue;
        }
        const Comparison c = compare(t, result_for(t, targets, outcome), folders);
        const double sx = scale_of(t.input.x);
        const double sy = scale_of(t.input.y);
        Plot plot{t.input.test + (t.input.fitted() ? " (fitted)" : " (predicted)"), axis_of(t.input.x), axis_of(t.input.y), {}, {}};
        Curve wanted{t.input.kind, {}, {}, "#111111", CurveStyle::points};
        const auto& all = t.file.measured;
        Curve found{"this card, mean over specimens", {}, {}, t.input.fitted() ? "#1f4e79" : "#c0392b"};
        for (std::size_t k = 0; k < all.x.size(); k += all.x.size() / 60 + 1) { // so many that they can be told apart
            wanted.x.push_back(sx * all.x[k]);
            wanted.y.push_back(sy * all.y[k]);
        }
        for (std::size_t k = 0; c.found && k < c.curve.x.size(); ++k) {
            found.x.push_back(sx * c.curve.x[k]);
            found.y.push_back(sy * c.curve.y[k]);
        }
        plot.curves = {found, wanted};
        out.push_back(std::move(plot));
    }
    return out;
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
        const auto read = report::readable({"", "", values[k], unit, ""});
        r.key_figures.push_back({p.name + (p.times.empty() ? "" : " over " + p.times),
                                 fmt::format("{:.4g}", read.value.value_or(values[k])), read.unit,
                                 fmt::format("sought from {} to {}", shown(p.low, unit), shown(p.high, unit))});
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
