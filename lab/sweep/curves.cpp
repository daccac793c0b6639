#include "lab/sweep/curves.hpp"

#include <algorithm>
#include <cmath>

#include "lab/deck.hpp"

namespace proveta {

namespace {

// The heading of a column whose name is known, but not its unit: "axial_stress_Pa". Empty when there is none.
std::string heading_of(const report::Table& curve, const std::string& name) {
    std::string best;
    for (const auto& column : curve.columns) {
        if (column.name == name) {
            return name;
        }
        if (column.name.starts_with(name + "_") && (best.empty() || column.name.size() < best.size())) {
            best = column.name;
        }
    }
    return best;
}

// The mean of the curves of some jobs, as far as all of them go; a single one as it is, without backward parts.
SampledCurve mean_of(const std::vector<SampledCurve>& jobs) {
    if (jobs.size() == 1) {
        return advancing(jobs.front());
    }
    const auto mean = mean_curve(jobs);
    if (!mean) {
        return {};
    }
    const auto end = static_cast<std::ptrdiff_t>(mean->common) + 1;
    return {{mean->x.begin(), mean->x.begin() + end}, {mean->mean.begin(), mean->mean.begin() + end}};
}

void read_curves(TestCurves& curves, const PlotSpec& spec, const SweepTable& table, const TrialFolders& folders) {
    for (const auto& trial : table.trials) {
        std::vector<SampledCurve> jobs;
        bool good = true;
        for (const auto& job : trial.jobs) {
            if (job.test != curves.test || !good) {
                continue;
            }
            good = job.status == "complete";
            if (!good) {
                continue;
            }
            const report::Table read = job_curve(folders.trial(trial.key) / job.name);
            curves.x.name = heading_of(read, spec.curves.front().x);
            curves.y.name = heading_of(read, spec.curves.front().y);
            good = !curves.x.name.empty() && !curves.y.name.empty();
            if (good) {
                SampledCurve curve{read.values(curves.x.name), read.values(curves.y.name)};
                for (double& x : curve.x) {
                    x *= std::copysign(1.0, spec.x_scale);
                }
                for (double& y : curve.y) {
                    y *= std::copysign(1.0, spec.y_scale);
                }
                jobs.push_back(std::move(curve));
            }
        }
        curves.at.push_back(good && !jobs.empty() ? mean_of(jobs) : SampledCurve{});
    }
}

} // namespace

std::vector<TestCurves> curves_of(const Sweep& sweep, const SweepTable& table, const TrialFolders& folders) {
    std::vector<TestCurves> out;
    for (const auto& test : sweep.tests) {
        const PlotSpec spec = read_deck(test.deck, test.name).protocol->plots().front();
        TestCurves curves;
        curves.test = test.name;
        curves.axes = {spec.title, spec.x_title, spec.y_title, std::fabs(spec.x_scale), std::fabs(spec.y_scale)};
        read_curves(curves, spec, table, folders);
        curves.sensitivity = curve_sensitivity(sweep.points, curves.at, sweep.trajectories());
        if (std::any_of(curves.at.begin(), curves.at.end(), [](const auto& c) { return !c.x.empty(); })) {
            out.push_back(std::move(curves));
        }
    }
    return out;
}

report::TextTable curve_rows(const Sweep& sweep, const std::vector<TestCurves>& curves) {
    report::TextTable t;
    t.title = sweep.trajectories()
                  ? "Along the main curve: Morris' mu* of its y at each x, over the largest of the test's."
                  : "Along the main curve: rank correlation of its y at each x with the parameters. Empty: y does not vary.";
    t.rows.push_back({"test", "x_column", "x", "y_column", "mean_y"});
    for (std::size_t k = 0; k < sweep.space.size(); ++k) {
        t.rows.front().push_back(sweep.space[k].name);
    }
    for (const auto& c : curves) {
        for (std::size_t i = 0; c.sensitivity && i < c.sensitivity->x.size(); ++i) {
            std::vector<std::string> row{c.test, c.x.name, full(c.sensitivity->x[i]), c.y.name, full(c.sensitivity->mean[i])};
            for (const auto& of_parameter : c.sensitivity->s) {
                row.push_back(full(of_parameter[i]));
            }
            t.rows.push_back(std::move(row));
        }
    }
    return t;
}

} // namespace proveta
