#include "lab/calibrate/residuals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lab/derived.hpp"

namespace proveta {

namespace {

constexpr std::size_t curve_points = 40;

// Results that are known once the stress has fallen a little from its peak.
constexpr std::array before_the_peak{"strength",           "strain_at_peak",    "gauge_strain_at_peak",   "young_modulus",
                                     "tangent_modulus",    "secant_modulus",    "average_modulus",        "young_modulus_platens",
                                     "poisson_ratio",      "peak_total_stress", "peak_deviatoric_stress", "toe_strain",
                                     "constrained_modulus"};

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
    out.curve.x = evenly(target.file.compared);
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
        const double y = value_at(target.file.compared, out.curve.x[k]);
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
        std::string kind;
        double young = 0.0;
        double last = std::numeric_limits<double>::infinity(); // a strain that the user has the test end at
        for (const auto& test : plan.tests) {
            if (test.name == t.input.test) {
                t.weight *= test.weight;
                kind = input::text_at(test.deck, "test");
                const input::Json::json_pointer stop("/loading/stop/axial_strain");
                const input::Json modulus = test.deck.value(input::Json::json_pointer("/material/young_modulus"), input::Json());
                young = modulus.is_number() ? modulus.get<double>() : 0.0;
                last = t.input.x == "axial_strain" && test.written.contains(stop) ? test.deck.value(stop, last) : last;
            }
        }
        try {
            if (t.input.is_curve()) {
                t.file = load_target_curve(t.input, kind, last, young);
            }
        } catch (const std::runtime_error& e) {
            problems.push_back({plan.source, fmt::format("/targets/{}/curve", k), e.what(), "a table that holds the measured curve", ""});
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
            last = std::max(last, reach * t.file.compared.x.back());
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
