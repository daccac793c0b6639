#include "lab/calibrate/calibrate_plots.hpp"

#include <algorithm>
#include <cmath>

namespace proveta {

using report::Curve;
using report::CurveStyle;
using report::Plot;

namespace {

std::string axis_of(const std::string& quantity) {
    return quantity == "total_stress"        ? "total axial stress [MPa]"
           : quantity == "deviatoric_stress" ? "deviatoric stress [MPa]"
           : quantity == "axial_strain"      ? "axial strain, platens [%]"
           : quantity == "gauge_strain"      ? "axial strain, gauge [%]"
           : quantity == "volumetric_strain" ? "volumetric strain [%]"
                                             : "circumferential strain [%]";
}

double scale_of(const std::string& quantity) { return quantity.ends_with("stress") ? 1e-6 : 100.0; }

} // namespace

const TrialResult& result_for(const Target& target, const std::vector<Target>& targets, const CalibrationOutcome& outcome) {
    for (const auto& t : targets) {
        if (t.input.test == target.input.test && t.input.fitted()) {
            return outcome.best_trial().result;
        }
    }
    return outcome.predictions;
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
    if (!best.x.empty()) { // it stays so to the end
        best.x.push_back(static_cast<double>(outcome.trials.size()));
        best.y.push_back(least);
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

} // namespace proveta
