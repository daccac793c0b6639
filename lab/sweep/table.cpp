#include "lab/sweep/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/input/suggest.hpp"
#include "lab/series/statistics.hpp"
#include "specimens/hdf5_file.hpp"

namespace proveta {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::string with_unit(const std::string& name, const std::string& unit) { return report::Column{name, unit, ""}.heading(); }

std::string parameter_heading(const Parameter& p) { return with_unit(p.name, p.unit); }

// Standard deviation of a result over the jobs of a test, where all of them have it.
double deviation_of(const TrialResult& trial, const std::string& test, const std::string& result) {
    std::vector<double> values;
    for (const auto& job : trial.jobs) {
        if (job.test == test) {
            values.push_back(job.value(result).value_or(no_value));
        }
    }
    const Sample sample = sample_of(values);
    return sample.spread ? sample.spread->deviation : no_value;
}

// Names of all results of a test, with their units.
std::map<std::string, std::string> results_of(const std::vector<TrialResult>& trials, const std::string& test) {
    std::map<std::string, std::string> out;
    for (const auto& trial : trials) {
        for (const auto& job : trial.jobs) {
            if (job.test == test) {
                for (const auto& [name, value] : job.results) {
                    const auto unit = job.units.find(name);
                    out.emplace(name, unit == job.units.end() ? "" : unit->second);
                }
            }
        }
    }
    return out;
}

} // namespace

std::string full(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : std::string(); }

bool SweepTable::complete(std::size_t point) const {
    const auto& jobs = trials[point].jobs;
    return std::all_of(jobs.begin(), jobs.end(), [](const JobResult& job) { return job.status == "complete"; });
}

bool SweepTable::quasi_static(std::size_t point) const {
    const auto& jobs = trials[point].jobs;
    return std::all_of(jobs.begin(), jobs.end(), [](const JobResult& job) { return job.quasi_static || job.status != "complete"; });
}

std::size_t SweepTable::failed() const {
    std::size_t out = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        out += complete(i) ? 0 : 1;
    }
    return out;
}

SweepTable make_table(const Sweep& sweep, std::vector<TrialResult> trials) {
    SweepTable out;
    out.trials = std::move(trials);
    for (auto& trial : out.trials) {
        trial.values = sweep.space.resolved(trial.values);
    }
    for (const auto& test : sweep.tests) {
        for (const auto& [name, unit] : results_of(out.trials, test.name)) {
            if (!sweep.results.empty() && std::find(sweep.results.begin(), sweep.results.end(), name) == sweep.results.end()) {
                continue;
            }
            ResultColumn column{test.name, name, unit, {}, {}};
            for (const auto& trial : out.trials) {
                const auto mean = trial.mean(test.name, name);
                column.mean.push_back(mean.value_or(no_value));
                if (test.seeds.size() > 1) {
                    column.deviation.push_back(mean ? deviation_of(trial, test.name, name) : no_value);
                }
            }
            out.results.push_back(std::move(column));
        }
    }
    return out;
}

report::TextTable rows_of(const Sweep& sweep, const SweepTable& table) {
    report::TextTable t;
    t.title = "One row a point: parameters as the decks have them, results as means over the seeds. Empty: failed, or not determined.";
    std::vector<std::string> heading{"point", "trial"};
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        heading.push_back(parameter_heading(sweep.space[k]));
    }
    heading.insert(heading.end(), {"status", "quasi_static"});
    for (const auto& column : table.results) {
        heading.push_back(with_unit(column.name(), column.unit));
        if (!column.deviation.empty()) {
            heading.push_back(with_unit(column.name() + "_deviation", column.unit));
        }
    }
    t.rows.push_back(std::move(heading));
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        std::vector<std::string> row{std::to_string(i + 1), table.trials[i].key};
        for (const double value : table.trials[i].values) {
            row.push_back(full(value));
        }
        row.insert(row.end(), {table.complete(i) ? "complete" : "failed", table.quasi_static(i) ? "yes" : "no"});
        for (const auto& column : table.results) {
            row.push_back(full(column.mean[i]));
            if (!column.deviation.empty()) {
                row.push_back(full(column.deviation[i]));
            }
        }
        t.rows.push_back(std::move(row));
    }
    return t;
}

report::TextTable failures_of(const SweepTable& table) {
    report::TextTable t{"", {{"point", "trial", "job", "reason"}}};
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        for (const auto& job : table.trials[i].jobs) {
            if (job.status != "complete") {
                t.rows.push_back({std::to_string(i + 1), table.trials[i].key, job.name, job.reason});
            }
        }
    }
    return t;
}

namespace {

// HDF5 takes a slash for a folder: "J/m2" becomes "J_per_m2".
std::string dataset(std::string heading) {
    for (auto at = heading.find('/'); at != std::string::npos; at = heading.find('/')) {
        heading.replace(at, 1, "_per_");
    }
    return heading;
}

} // namespace

void write_hdf5(const Sweep& sweep, const SweepTable& table, const std::string& file) {
    Hdf5File out(file, Hdf5File::Mode::create);
    std::vector<std::string> keys;
    std::vector<std::int32_t> complete;
    std::vector<std::int32_t> quasi_static;
    for (std::size_t i = 0; i < table.trials.size(); ++i) {
        keys.push_back(table.trials[i].key);
        complete.push_back(table.complete(i) ? 1 : 0);
        quasi_static.push_back(table.quasi_static(i) ? 1 : 0);
    }
    out.put_text("trial", fmt::format("{}", fmt::join(keys, "\n")));
    out.put("complete", complete);
    out.put("quasi_static", quasi_static);
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        std::vector<double> values;
        for (const auto& trial : table.trials) {
            values.push_back(trial.values[k]);
        }
        out.put(dataset(parameter_heading(sweep.space[k])), values);
    }
    for (const auto& column : table.results) {
        out.put(dataset(with_unit(column.name(), column.unit)), column.mean);
        if (!column.deviation.empty()) {
            out.put(dataset(with_unit(column.name() + "_deviation", column.unit)), column.deviation);
        }
    }
    out.close();
}

std::vector<std::string> unknown_results(const Sweep& sweep, const SweepTable& table) {
    std::set<std::string> known;
    for (const auto& test : sweep.tests) {
        for (const auto& [name, unit] : results_of(table.trials, test.name)) {
            known.insert(name);
        }
    }
    std::vector<std::string> out;
    for (const auto& name : sweep.results) {
        if (!known.contains(name)) {
            const std::string best = input::nearest(name, {known.begin(), known.end()});
            out.push_back(fmt::format("No test gave a result \"{}\"{}.", name,
                                      best.empty() ? fmt::format("; there are {}", fmt::join(known, ", "))
                                                   : fmt::format("; did you mean \"{}\"?", best)));
        }
    }
    return out;
}

std::vector<std::vector<Sensitivity>> sensitivities(const Sweep& sweep, const SweepTable& table) {
    const std::size_t parameters = sweep.space.size();
    std::vector<std::vector<Sensitivity>> out;
    for (const auto& column : table.results) {
        std::vector<Sensitivity> row(parameters);
        const auto effects = sweep.trajectories() ? elementary_effects(sweep.points, column.mean) : std::vector<Effects>(parameters);
        double largest = 0.0;
        for (const auto& e : effects) {
            largest = std::max(largest, e.mu_star);
        }
        const auto finite = std::count_if(column.mean.begin(), column.mean.end(), [](double y) { return std::isfinite(y); });
        for (std::size_t k = 0; k < parameters; ++k) {
            if (sweep.trajectories()) {
                row[k] = {effects[k].n, effects[k].n > 0 && largest > 0.0 ? effects[k].mu_star / largest : no_value, 0.0, effects[k]};
                continue;
            }
            std::vector<double> x;
            for (const auto& point : sweep.points) {
                x.push_back(point[k]);
            }
            const auto n = static_cast<std::size_t>(finite);
            row[k] = {n, rank_correlation(x, column.mean).value_or(no_value), significant_correlation(n), {}};
        }
        out.push_back(std::move(row));
    }
    return out;
}

report::TextTable sensitivity_rows(const Sweep& sweep, const SweepTable& table, const std::vector<std::vector<Sensitivity>>& found) {
    report::TextTable t;
    if (sweep.trajectories()) {
        t.title = "Morris' elementary effects: change of the result (its unit) per full range of the parameter.";
        t.rows.push_back({"test", "result", "unit", "parameter", "effects", "mu", "mu_star", "sigma"});
    } else {
        t.title = "Spearman's rank correlation; one beyond the bound would come by chance once in twenty.";
        t.rows.push_back({"test", "result", "unit", "parameter", "points", "rank_correlation", "bound_95"});
    }
    for (std::size_t c = 0; c < table.results.size(); ++c) {
        const auto& column = table.results[c];
        for (std::size_t k = 0; k < sweep.space.size(); ++k) {
            const Sensitivity& s = found[c][k];
            std::vector<std::string> row{column.test, column.result, column.unit, sweep.space[k].name, std::to_string(s.n)};
            if (!sweep.trajectories()) {
                row.insert(row.end(), {full(s.value), full(s.bound)});
            } else if (s.n == 0) {
                row.insert(row.end(), 3, "");
            } else {
                row.insert(row.end(), {full(s.effects.mu), full(s.effects.mu_star), full(s.effects.sigma)});
            }
            t.rows.push_back(std::move(row));
        }
    }
    return t;
}

} // namespace proveta
