#include "lab/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/derived.hpp"

namespace proveta {

namespace {

constexpr double most_imbalance = 0.02;
constexpr double most_kinetic = 0.01;
constexpr double most_unbalanced = 0.01;
constexpr double most_rate_effect = 0.03;
constexpr double most_residual = 0.01;

std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

std::string against(double found, double allowed) { return fmt::format("{} (allowed {})", percent(found), percent(allowed)); }

// Rows of the loading from a fifth of what it added to the stress up to the peak.
std::vector<std::size_t> rows_to_peak(const report::Table& curve, double sense) {
    Loading l = loading_of(curve, sense);
    if (l.stress.empty()) {
        return {};
    }
    const double start = l.row.front() > 0 ? sense * curve.rows[l.row.front() - 1][curve.column("axial_stress")] : 0.0;
    for (double& s : l.stress) {
        s -= start;
    }
    const std::size_t peak = peak_index(l.stress);
    const auto first = first_reaching(l.stress, 0.2 * l.stress[peak], peak);
    if (!first || *first == peak) {
        return {};
    }
    return {l.row.begin() + static_cast<std::ptrdiff_t>(*first), l.row.begin() + static_cast<std::ptrdiff_t>(peak) + 1};
}

} // namespace

report::Badge quasi_static_verdict(const report::Table& curve, double sense, const report::Table& energy,
                                   const std::optional<RateCheck>& check) {
    report::Badge badge{"Quasi-static loading", false, "", {}};
    const auto bottom = curve.values("force_bottom");
    const auto top = curve.values("force_top");
    const auto ratio = curve.values("unbalanced_ratio");
    const auto kinetic = energy.values("kinetic");
    const auto elastic = energy.values("elastic");
    const auto rows = rows_to_peak(curve, sense);
    if (rows.empty()) {
        badge.verdict = "too few samples before the peak to judge";
        return badge;
    }
    double imbalance = 0.0;
    double motion = 0.0;
    double unbalanced = 0.0;
    for (const auto k : rows) {
        imbalance = std::max(imbalance, std::fabs(bottom[k] - top[k]) / std::max(std::fabs(0.5 * (bottom[k] + top[k])), 1e-300));
        motion = std::max(motion, kinetic[k] / std::max(elastic[k], 1e-300));
        unbalanced = std::max(unbalanced, ratio[k]);
    }
    badge.good = imbalance <= most_imbalance && motion <= most_kinetic && unbalanced <= most_unbalanced;
    const bool confirmed = check && check->difference <= most_rate_effect;
    const char* yes = confirmed ? "yes, and half the rate confirms the peak" : "yes; the rate was not checked";
    const bool refuted = check && !confirmed;
    badge.verdict = badge.good && !refuted ? yes : "no: load more slowly, or read the strength as a dynamic one";
    badge.good = badge.good && !refuted;
    badge.figures = {{"difference of the platens' forces over their mean, worst", against(imbalance, most_imbalance)},
                     {"kinetic over elastic energy, worst", against(motion, most_kinetic)},
                     {"unbalanced force ratio, worst", against(unbalanced, most_unbalanced)},
                     {"judged", "from 20 % of the peak stress to the peak"},
                     {"peak against that at half the rate",
                      check ? against(check->difference, most_rate_effect) : "not checked (\"rate_check\": \"half_rate\" does)"}};
    return badge;
}

std::vector<report::Scalar> rate_results(const report::Table& curve, double sense) {
    const auto rate = curve.values("rate");
    const auto time = curve.values("time");
    const auto rows = rows_to_peak(curve, sense);
    std::optional<double> lowest;
    std::optional<double> highest;
    std::optional<double> mean;
    if (!rows.empty()) {
        lowest = highest = sense * rate[rows.front()];
        double travel = 0.0;
        double duration = 0.0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            lowest = std::min(*lowest, sense * rate[rows[k]]);
            highest = std::max(*highest, sense * rate[rows[k]]);
            if (k > 0) {
                const double dt = time[rows[k]] - time[rows[k - 1]];
                travel += 0.5 * sense * (rate[rows[k]] + rate[rows[k - 1]]) * dt;
                duration += dt;
            }
        }
        mean = travel / duration;
    }
    const char* range = "speed at which the platens approach or part, from 20 % of the peak stress to the peak";
    return {{"lowest_rate", "Lowest rate", lowest, "m/s", range},
            {"mean_rate", "Mean rate", mean, "m/s", range},
            {"highest_rate", "Highest rate", highest, "m/s", range}};
}

std::string overlap_warning(double overlap) {
    constexpr double most = 0.05; // a contact area of a tenth of the section: beyond, Hertz's theory and the particles' volume are off
    return overlap <= most ? ""
                           : fmt::format("The largest overlap was {:.2g} of the smaller radius, more than {:.2g}: forces, densities and "
                                         "durations of impacts are those of squashed particles. A higher young_modulus makes it less.",
                                         overlap, most);
}

std::string coupling_warning(const report::Table& energy) {
    constexpr double most = 0.02;
    if (energy.rows.empty()) {
        return "";
    }
    const auto& last = energy.rows.back();
    double scale = 0.0; // the largest term
    for (std::size_t c = 1; c < last.size(); ++c) {
        scale = energy.columns[c].unit == "J" ? std::max(scale, std::fabs(last[c])) : scale;
    }
    const double made = last[energy.column("coupling")];
    return std::fabs(made) <= most * scale ? ""
                                           : fmt::format("Sharing contact forces out over bodies {} {:.2g} % of the largest energy: finer "
                                                         "meshes or stiffer contacts make it less.",
                                                         made > 0.0 ? "made" : "took", 100.0 * std::fabs(made) / scale);
}

report::Badge energy_verdict(const report::Table& energy) {
    report::Badge badge{"Energy balance", false, "", {}};
    if (energy.rows.empty()) {
        badge.verdict = "no samples";
        return badge;
    }
    auto work = energy.values("platens");
    const auto by_pressure = energy.values("pressure");
    for (std::size_t k = 0; k < work.size(); ++k) {
        work[k] += by_pressure[k];
    }
    const auto residual = energy.values("residual");
    double worst = 0.0;
    for (std::size_t k = 0; k < work.size(); ++k) {
        if (std::fabs(work[k]) > 0.01 * std::fabs(work.back())) {
            worst = std::max(worst, std::fabs(residual[k] / work[k]));
        }
    }
    badge.good = worst <= most_residual;
    badge.verdict = badge.good ? "closed" : "not closed: the time step is too large or the calculation lost its footing";
    badge.figures = {{"residual over the work put in, worst", against(worst, most_residual)}};
    return badge;
}

} // namespace proveta
