#include "lab/sweep/curves.hpp"

#include <algorithm>
#include <cmath>

#include "lab/deck.hpp"

namespace proveta {

namespace {

// The column of a name, whether its heading has the unit with it or not ("axial_stress_Pa"); null when there is none.
const report::Column* find_column(const report::Table& curve, const std::string& name) {
    const report::Column* best = nullptr;
    for (const auto& column : curve.columns) {
        if (column.name == name) {
            return &column;
        }
        if (column.name.starts_with(name + "_") && (best == nullptr || column.name.size() < best->name.size())) {
            best = &column;
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
            const report::Column* x = find_column(read, spec.curves.front().x);
            const report::Column* y = find_column(read, spec.curves.front().y);
            good = x != nullptr && y != nullptr;
            if (good) {
                curves.x = x->heading();
                curves.y = y->heading();
                SampledCurve curve{read.values(x->name), read.values(y->name)};
                for (double& v : curve.x) {
                    v *= std::copysign(1.0, spec.x_scale);
                }
                for (double& v : curve.y) {
                    v *= std::copysign(1.0, spec.y_scale);
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
            std::vector<std::string> row{c.test, c.x, full(c.sensitivity->x[i]), c.y, full(c.sensitivity->mean[i])};
            for (const auto& of_parameter : c.sensitivity->s) {
                row.push_back(full(of_parameter[i]));
            }
            t.rows.push_back(std::move(row));
        }
    }
    return t;
}

} // namespace proveta
