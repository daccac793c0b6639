#include "lab/sweep/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "lab/citation.hpp"
#include "lab/progress.hpp"
#include "lab/provenance.hpp"
#include "lab/sweep/sweep_plots.hpp"
#include "lab/trials/verdicts.hpp"

namespace proveta {

namespace {

constexpr std::size_t most_rows = 200; // of the page's table of points

report::TextTable parameter_table(const Sweep& sweep) {
    report::TextTable t{"Parameters", {{"Parameter", "In the decks", "Low", "High", "Unit", "Scale"}}};
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        const Parameter& p = sweep.space[k];
        const Shown s = shown(sweep, k);
        t.rows.push_back({label(p), p.path, s.text(p.low), s.text(p.high), s.unit, p.scale});
    }
    return t;
}

report::TextTable test_table(const Sweep& sweep, const SweepTable& table) {
    report::TextTable t{"Tests of each point", {{"Test", "Kind", "Spheres", "Seeds", "Quasi-static"}}};
    const auto verdicts = verdicts_of(table.trials);
    for (const auto& test : sweep.tests) {
        const auto& specimen = test.deck["specimen"];
        t.rows.push_back({test.name, test.deck["test"],
                          test.seeds.empty()             ? "stored specimen"
                          : specimen.contains("spheres") ? specimen["spheres"].dump()
                                                         : "loose particles",
                          fmt::format("{}", fmt::join(test.seeds, ", ")),
                          verdicts.contains(test.name) ? input::text_at(verdicts[test.name], "verdict") : "no test complete"});
    }
    return t;
}

report::TextTable influence_table(const Sweep& sweep, const SweepOutcome& o) {
    report::TextTable t{sweep.trajectories()
                            ? "Influence on all results: Morris' mu* over the largest of the result's"
                            : fmt::format("Influence on all results: Spearman's rank correlation, beyond \u00b1{:.2f} by chance "
                                          "once in twenty",
                                          significant_correlation(o.table.trials.size() - o.table.failed())),
                        {{"Result", "Unit", "Least", "Most"}}};
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        t.rows.front().push_back(sweep.space[k].name);
    }
    for (std::size_t c = 0; c < o.table.results.size(); ++c) {
        const auto& column = o.table.results[c];
        std::vector<double> values;
        std::copy_if(column.mean.begin(), column.mean.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
        if (values.empty()) {
            continue;
        }
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        const Shown s(column.result, column.unit, values);
        std::vector<std::string> row{column.name(), s.unit, s.text(*least), s.text(*most)};
        for (const auto& of_parameter : o.sensitivities[c]) {
            row.push_back(std::isfinite(of_parameter.value) ? fmt::format("{:.2f}", of_parameter.value) : "");
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

report::TextTable effects_table(const Sweep& sweep, const SweepOutcome& o) {
    report::TextTable t{"Elementary effects of the main results: change per full range of the parameter",
                        {{"Result", "Parameter", "Unit", "Effects", "mu", "mu*", "sigma"}}};
    for (const auto& test : sweep.tests) {
        for (const auto c : main_results(sweep, o.table, test.name)) {
            const auto& column = o.table.results[c];
            for (const auto k : by_influence(o.sensitivities[c])) {
                const Effects& e = o.sensitivities[c][k].effects;
                if (e.n > 0) {
                    const Shown s(column.result, column.unit, {e.mu_star});
                    t.rows.push_back({column.name(), sweep.space[k].name, s.unit, std::to_string(e.n), s.text(e.mu), s.text(e.mu_star),
                                      s.text(e.sigma)});
                }
            }
        }
    }
    return t;
}

report::TextTable point_table(const Sweep& sweep, const SweepOutcome& o) {
    const std::size_t n = o.table.trials.size();
    report::TextTable t{n > most_rows ? fmt::format("The first {} of {} points; all are in table.csv", most_rows, n) : "Points",
                        {{"Point"}}};
    std::vector<Shown> parameters;
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        std::vector<double> values;
        for (const auto& trial : o.table.trials) {
            values.push_back(trial.values[k]);
        }
        parameters.emplace_back(sweep.space[k].times.empty() ? sweep.space[k].name : "", sweep.space[k].unit, values);
        t.rows.front().push_back(parameters.back().heading(sweep.space[k].name));
    }
    std::vector<std::pair<std::size_t, Shown>> results;
    for (const auto& test : sweep.tests) {
        for (const auto c : main_results(sweep, o.table, test.name)) {
            results.emplace_back(c, Shown(o.table.results[c].result, o.table.results[c].unit, o.table.results[c].mean));
            t.rows.front().push_back(results.back().second.heading(o.table.results[c].name()));
        }
    }
    t.rows.front().insert(t.rows.front().end(), {"Status", "Quasi-static"});
    for (std::size_t i = 0; i < std::min(n, most_rows); ++i) {
        std::vector<std::string> row{std::to_string(i + 1)};
        for (std::size_t k = 0; k < parameters.size(); ++k) {
            row.push_back(parameters[k].text(o.table.trials[i].values[k]));
        }
        for (const auto& [c, s] : results) {
            row.push_back(s.text(o.table.results[c].mean[i]));
        }
        row.insert(row.end(), {o.table.complete(i) ? "complete" : "failed", o.table.quasi_static(i) ? "yes" : "no"});
        t.rows.push_back(std::move(row));
    }
    return t;
}

} // namespace

std::vector<std::size_t> main_results(const Sweep& sweep, const SweepTable& table, const std::string& test) {
    constexpr std::size_t most = 4;
    constexpr const char* usual[] = {"strength", "young_modulus", "strain_at_peak", "poisson_ratio"};
    std::vector<std::size_t> out;
    std::vector<std::size_t> others;
    const auto take = [&](const auto& wanted) {
        for (std::size_t c = 0; c < table.results.size(); ++c) {
            const auto& column = table.results[c];
            if (column.test == test && out.size() < most && std::find(out.begin(), out.end(), c) == out.end() && wanted(column.result)) {
                out.push_back(c);
            }
        }
    };
    for (const auto& name : sweep.results) {
        take([&](const std::string& result) { return result == name; });
    }
    if (!sweep.results.empty()) {
        return out;
    }
    for (const std::string name : usual) {
        take([&](const std::string& result) { return result == name || (name == "strength" && result.ends_with("_strength")); });
    }
    if (out.empty()) {
        take([](const std::string&) { return true; });
    }
    return out;
}

std::vector<std::size_t> by_influence(const std::vector<Sensitivity>& of_result) {
    std::vector<std::size_t> out(of_result.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    const auto size = [&](std::size_t k) { return std::isfinite(of_result[k].value) ? std::fabs(of_result[k].value) : -1.0; };
    std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
    return out;
}

namespace {

// The points, and of each test's first results the parameter that matters most.
std::vector<report::KeyFigure> first_figures(const Sweep& sweep, const SweepOutcome& o) {
    constexpr std::size_t most = 4;
    const std::size_t n = o.table.trials.size();
    std::vector<report::KeyFigure> out{
        {"Points complete", fmt::format("{} of {}", n - o.table.failed(), n), "", fmt::format("of {} parameters", sweep.space.size())}};
    for (const auto& test : sweep.tests) {
        for (const auto c : main_results(sweep, o.table, test.name)) {
            const std::size_t k = by_influence(o.sensitivities[c]).front();
            const double value = o.sensitivities[c][k].value;
            if (out.size() < most && std::isfinite(value)) {
                const bool real = beyond_chance(o.sensitivities[c][k]);
                out.push_back({"Most influence on " + o.table.results[c].name(), real ? sweep.space[k].name : "none", "",
                               sweep.trajectories() ? fmt::format("mu* over the largest {:.2f}", value)
                               : real               ? fmt::format("rank correlation {:.2f}", value)
                                                    : fmt::format("beyond chance, \u00b1{:.2f}", o.sensitivities[c][k].bound)});
            }
        }
    }
    return out;
}

// Main results on which no parameter has an influence that chance would not give.
std::string within_chance(const Sweep& sweep, const SweepOutcome& o) {
    std::vector<std::string> parts;
    for (const auto& test : sweep.tests) {
        for (const auto c : main_results(sweep, o.table, test.name)) {
            const std::size_t k = by_influence(o.sensitivities[c]).front();
            const Sensitivity& most = o.sensitivities[c][k];
            if (std::isfinite(most.value) && !beyond_chance(most)) {
                parts.push_back(fmt::format("{} ({} {:.2f}, by chance up to {:.2f})", o.table.results[c].name(), sweep.space[k].name,
                                            std::fabs(most.value), most.bound));
            }
        }
    }
    return parts.empty() ? "" : fmt::format("No influence beyond chance on {}: their order says nothing.", fmt::join(parts, ", "));
}

} // namespace

report::Record sweep_record(const Sweep& sweep, const SweepOutcome& o) {
    report::Record r;
    const std::size_t n = o.table.trials.size();
    const std::size_t failed = o.table.failed();
    r.title = sweep.input.title;
    r.subtitle = fmt::format("Sweep of {} parameters, {} points", sweep.space.size(), n);
    r.status = failed == n ? "failed" : "complete";
    r.stopped_by = fmt::format("{} of {} points complete{}", n - failed, n, failed > 0 ? fmt::format(", {} failed", failed) : "");
    if (failed > 0) {
        r.warnings.push_back(
            fmt::format("{} of {} points failed; failures.csv says why. Sensitivities are those of the others.", failed, n));
    }
    std::size_t hasty = 0;
    for (std::size_t i = 0; i < n; ++i) {
        hasty += o.table.quasi_static(i) ? 0 : 1;
    }
    if (hasty > 0) {
        r.warnings.push_back(
            fmt::format("At {} of {} points a test was not loaded quasi-statically (column quasi_static of table.csv).", hasty, n));
    }
    for (auto& warning : unknown_results(sweep, o.table)) {
        r.warnings.push_back(std::move(warning));
    }
    if (!sweep.trajectories() && n - failed < 10) {
        r.warnings.emplace_back("Fewer than ten points: rank correlations say little.");
    }
    if (const std::string none = within_chance(sweep, o); !none.empty()) {
        r.warnings.push_back(none);
    }
    r.key_figures = first_figures(sweep, o);
    r.citation = citation("Sweep", sweep.input.title, resolved(sweep));
    r.overview = {parameter_table(sweep), test_table(sweep, o.table)};
    for (const auto& test : sweep.tests) { // what belongs to a test stands together
        const auto curves = std::find_if(o.curves.begin(), o.curves.end(), [&](const auto& c) { return c.test == test.name; });
        if (curves != o.curves.end() && curves->sensitivity) {
            r.plots.push_back(along_curve_plot(sweep, *curves));
        }
        auto columns = main_results(sweep, o.table, test.name);
        std::erase_if(columns, [&](std::size_t c) { // what does not vary, or at too few points
            return std::none_of(o.sensitivities[c].begin(), o.sensitivities[c].end(), [](const auto& s) { return std::isfinite(s.value); });
        });
        if (!columns.empty()) {
            r.plots.push_back(influence_plot(sweep, o, test.name, columns));
        }
        for (std::size_t j = 0; j < std::min<std::size_t>(columns.size(), 2); ++j) {
            r.plots.push_back(scatter_plot(sweep, o, columns[j]));
        }
        if (curves != o.curves.end()) {
            r.plots.push_back(all_curves_plot(*curves));
        }
    }
    r.tables = {influence_table(sweep, o)};
    if (sweep.trajectories()) {
        r.tables.push_back(effects_table(sweep, o));
    }
    r.tables.push_back(point_table(sweep, o));
    double seconds = 0.0;
    for (const auto& trial : o.table.trials) {
        seconds += trial.seconds();
    }
    r.tables.push_back({"Provenance",
                        {{"What", "Value"},
                         {"Program", "Proveta " + version()},
                         {"Wall time", Progress::duration(seconds) + " of all tests together"},
                         {"To repeat", "proveta sweep manifest.json --out NEW_FOLDER"}}});
    if (failed > 0) {
        r.tables.push_back(failures_of(o.table));
        r.tables.back().title = "Failures";
    }
    return r;
}

} // namespace proveta
