#include "lab/calibrate/residuals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lab/derived.hpp"
#include "lab/trials/csv.hpp"
#include "materials/measured.hpp"

namespace proveta {

namespace {

constexpr std::size_t curve_points = 40;

// Results that are known once the stress has fallen a little from its peak.
constexpr std::array before_the_peak{"strength",           "strain_at_peak",    "gauge_strain_at_peak",   "young_modulus",
                                     "tangent_modulus",    "secant_modulus",    "average_modulus",        "young_modulus_platens",
                                     "poisson_ratio",      "peak_total_stress", "peak_deviatoric_stress", "toe_strain",
                                     "constrained_modulus"};

std::size_t column_of(const report::Table& table, const std::string& name) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        if (table.columns[k].name == name) {
            return k;
        }
    }
    std::vector<std::string> names;
    for (const auto& c : table.columns) {
        names.push_back(c.name);
    }
    throw std::runtime_error(fmt::format("no column \"{}\"; there are {}", name, fmt::join(names, ", ")));
}

using Points = std::vector<std::pair<double, double>>;

// The columns of any CSV file.
Points points_of_table(const TargetInput& t) {
    const report::Table table = read_csv(t.curve);
    const std::size_t x = column_of(table, t.x_column);
    const std::size_t y = column_of(table, t.y_column);
    Points points;
    for (const auto& row : table.rows) {
        if (std::isfinite(row[x]) && std::isfinite(row[y])) { // files may say "nan", which has no place in an order
            points.emplace_back(t.x_factor * row[x], t.y_factor * row[y]);
        }
    }
    return points;
}

// An experiment's file says itself what its columns are, and whether its stress is total or deviatoric.
Points points_of_experiment(const TargetInput& t) {
    const MeasuredCurve m = load_measured_curve(t.curve);
    if (m.empty()) {
        throw std::runtime_error("an empty slot: its measured points have to be filled in first");
    }
    const auto values = [&](const std::string& name) {
        std::vector<double> out;
        for (std::size_t k = 0; k < m.axial_strain.size(); ++k) {
            const double more = name == "total_stress" && !m.total       ? m.confinement
                                : name == "deviatoric_stress" && m.total ? -m.confinement
                                                                         : 0.0;
            out.push_back(name == "axial_strain" || name == "gauge_strain" ? m.axial_strain[k]
                          : name == "circumferential_strain"               ? m.lateral_strain[k]
                          : name == "volumetric_strain"                    ? m.axial_strain[k] + 2.0 * m.lateral_strain[k]
                                                                           : m.axial_stress[k] + more);
        }
        return out;
    };
    const auto x = values(t.x);
    const auto y = values(t.y);
    Points points;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (std::isfinite(x[k]) && std::isfinite(y[k])) {
            points.emplace_back(x[k], y[k]);
        }
    }
    return points;
}

SampledCurve load_curve(const TargetInput& t) {
    Points points = is_measured_curve(t.curve) ? points_of_experiment(t) : points_of_table(t);
    for (auto& point : points) {
        point.first -= t.x_offset;
    }
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    SampledCurve curve;
    for (const auto& [px, py] : points) {
        curve.x.push_back(px);
        curve.y.push_back(py);
    }
    if (t.toe == "removed") {
        const auto line = line_between(curve.x, curve.y, 0.1, 1.0 / 3.0);
        if (!line || !(line->slope > 0.0)) {
            throw std::runtime_error("no straight part between 10 % and 33 % of the peak, from which the toe could be removed");
        }
        const double toe = -line->intercept / line->slope;
        for (double& px : curve.x) {
            px -= toe;
        }
    }
    SampledCurve out;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const bool counts = (!t.from.word.empty() || curve.x[k] >= t.from.number) && (!t.to.word.empty() || curve.x[k] <= t.to.number);
        if (counts && (out.x.empty() || curve.x[k] > out.x.back())) {
            out.x.push_back(curve.x[k]);
            out.y.push_back(curve.y[k]);
        }
    }
    if (out.x.size() < 3) {
        throw std::runtime_error(fmt::format("{} points in the range that counts, at least 3 are wanted", out.x.size()));
    }
    if (std::all_of(out.y.begin(), out.y.end(), [](double v) { return v == 0.0; })) {
        throw std::runtime_error("all values are 0");
    }
    return out;
}

// The value at x of a curve with rising x; its end values beyond.
double value_at(const SampledCurve& c, double x) {
    const auto above = std::upper_bound(c.x.begin(), c.x.end(), x);
    if (above == c.x.begin()) {
        return c.y.front();
    }
    if (above == c.x.end()) {
        return c.y.back();
    }
    const auto k = static_cast<std::size_t>(above - c.x.begin());
    return c.y[k - 1] + (c.y[k] - c.y[k - 1]) * (x - c.x[k - 1]) / (c.x[k] - c.x[k - 1]);
}

const std::vector<double>& quantity(const Loading& l, const std::string& name) {
    return name == "axial_strain"             ? l.strain
           : name == "gauge_strain"           ? l.gauge
           : name == "circumferential_strain" ? l.girth
           : name == "volumetric_strain"      ? l.volume
           : name == "total_stress"           ? l.stress
                                              : l.deviator;
}

std::vector<double> evenly(const SampledCurve& curve) {
    std::vector<double> x;
    for (std::size_t k = 0; k < curve_points; ++k) {
        x.push_back(std::lerp(curve.x.front(), curve.x.back(), static_cast<double>(k) / (curve_points - 1)));
    }
    return x;
}

void compare_curve(const Target& target, const TrialResult& result, const TrialFolders& folders, Comparison& out) {
    out.curve.x = evenly(target.curve);
    out.curve.y.assign(curve_points, 0.0);
    int n = 0;
    for (const auto& job : result.jobs) {
        if (job.test != target.input.test) {
            continue;
        }
        if (job.status != "complete") {
            return;
        }
        const Loading l = loading_of(job_curve(folders.trial(result.key) / job.name), job.sense);
        const SampledCurve path = advancing({quantity(l, target.input.x), quantity(l, target.input.y)});
        if (path.x.size() < 2) {
            return;
        }
        for (std::size_t k = 0; k < curve_points; ++k) {
            out.curve.y[k] += value_at(path, out.curve.x[k]);
        }
        ++n;
    }
    if (n == 0) {
        return;
    }
    double own = 0.0;
    double missed = 0.0;
    for (std::size_t k = 0; k < curve_points; ++k) {
        out.curve.y[k] /= n;
        const double y = value_at(target.curve, out.curve.x[k]);
        own += y * y / curve_points;
        out.deviation.push_back(out.curve.y[k] - y);
        missed += out.deviation.back() * out.deviation.back() / curve_points;
    }
    out.distance = std::sqrt(missed / own);
    for (double& d : out.deviation) {
        d /= std::sqrt(own * curve_points) * target.input.tolerance;
    }
    out.found = true;
}

} // namespace

std::vector<Target> make_targets(const CalibrationPlan& plan) {
    std::vector<Target> out;
    input::Problems problems;
    for (std::size_t k = 0; k < plan.input.targets.size(); ++k) {
        Target t{plan.input.targets[k], plan.input.targets[k].weight, {}};
        for (const auto& test : plan.tests) {
            t.weight *= test.name == t.input.test ? test.weight : 1.0;
        }
        try {
            if (t.input.is_curve()) {
                t.curve = load_curve(t.input);
            }
        } catch (const std::runtime_error& e) {
            problems.push_back({plan.source, fmt::format("/targets/{}/curve", k), e.what(), "a CSV file with two columns of numbers", ""});
        }
        out.push_back(std::move(t));
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return out;
}

Comparison compare(const Target& target, const TrialResult& result, const TrialFolders& folders) {
    Comparison out;
    if (target.input.is_curve()) {
        compare_curve(target, result, folders, out);
        if (!out.found) {
            out.deviation.assign(curve_points, missing_deviation / std::sqrt(static_cast<double>(curve_points)));
        }
        return out;
    }
    const auto value = result.mean(target.input.test, target.input.result);
    if (!value) {
        out.deviation = {missing_deviation};
        return out;
    }
    out.found = true;
    out.value = *value;
    out.distance = (*value - target.input.value) / std::fabs(target.input.value);
    const bool positive = *value > 0.0 && target.input.value > 0.0;
    out.deviation = {(positive ? std::log(*value / target.input.value) : out.distance) / target.input.tolerance};
    return out;
}

double Deviations::score() const { return std::sqrt(std::inner_product(all.begin(), all.end(), all.begin(), 0.0)); }

Deviations deviations(const std::vector<Target>& targets, const TrialResult& result, const TrialFolders& folders) {
    double weights = 0.0;
    for (const auto& t : targets) {
        weights += t.input.fitted() ? t.weight : 0.0;
    }
    Deviations out;
    for (const auto& t : targets) {
        if (t.input.fitted()) {
            const Comparison c = compare(t, result, folders);
            out.complete = out.complete && c.found;
            for (const double d : c.deviation) {
                out.all.push_back(d * std::sqrt(t.weight / weights));
            }
        }
    }
    return out;
}

void shorten(TrialTest& test, const std::vector<Target>& targets) {
    const auto written = [&](const char* key) {
        return test.written.contains(input::Json::json_pointer(std::string("/loading/stop/") + key));
    };
    const input::Json::json_pointer stop("/loading/stop");
    if (!test.deck.contains(stop) || !test.deck[stop].contains("axial_strain") || !test.deck[stop].contains("post_peak_drop")) {
        return;
    }
    bool to_the_peak = true; // nothing past it is spoken of
    double last = 0.0;       // axial strain of the curves
    bool results = false;    // most of them, strength first, are there only once the peak is passed
    for (const auto& t : targets) {
        if (t.input.test != test.name) {
            continue;
        }
        if (t.input.is_curve()) {
            to_the_peak = false;
            // The gauge shortens less than the platens close once a crack lies beside it.
            const double reach = t.input.x == "axial_strain"   ? 1.05
                                 : t.input.x == "gauge_strain" ? 1.3
                                                               : std::numeric_limits<double>::infinity();
            last = std::max(last, reach * t.curve.x.back());
        } else {
            results = true;
            to_the_peak = to_the_peak && std::find(before_the_peak.begin(), before_the_peak.end(), t.input.result) != before_the_peak.end();
        }
    }
    if (to_the_peak && !written("post_peak_drop")) {
        test.deck[stop]["post_peak_drop"] = 0.1;
    }
    // A card that is too strong for the curve passes its peak later than the curve ends; its strength says by how much it is.
    last *= results ? 2.0 : 1.0;
    if (last > 0.0 && std::isfinite(last)) {
        if (!written("axial_strain")) {
            test.deck[stop]["axial_strain"] = last;
        }
        if (!written("post_peak_drop")) {
            test.deck[stop]["post_peak_drop"] = 0.95;
        }
    }
}

} // namespace proveta
