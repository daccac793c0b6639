// Table, results and plots of acoustic emission.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/acoustic.hpp"

namespace proveta {

report::Table acoustic_table(const std::vector<AcousticEvent>& events, const AcousticRule& rule) {
    report::Table t;
    t.notes = {
        fmt::format("One row an event: failures of bonds linked by chains whose members are at most {:.6g} m ({:.3g} mean diameters) and "
                    "{:.6g} s ({:.3g} times the travel time at {:.6g} m/s) apart.",
                    rule.distance(), rule.reach, rule.duration(), rule.patience, rule.wave_speed),
        "In the order of their first failures. Magnitudes are relative: the energy is dissipated, not radiated."};
    t.columns = {{"time", "s", "time of the first failure since the start of loading"},
                 {"duration", "s", "from the first failure to the last"},
                 {"axial_strain", "", "nominal strain at the first failure"},
                 {"x", "m", "centre, weighted by energy"},
                 {"y", "m", "the same"},
                 {"z", "m", "the same"},
                 {"bonds", "", "failed bonds"},
                 {"tension_share", "", "share of them that failed in tension, the rest in shear"},
                 {"energy", "J", "dissipated by the damage of these bonds"},
                 {"magnitude", "", "(2/3) (log10(energy / J) - 4.8); nan without energy"},
                 {"radius", "m", "of gyration about the centre, weighted by energy"}};
    for (const auto& e : events) {
        t.rows.push_back({e.start, e.duration, e.axial_strain, e.centre.x(), e.centre.y(), e.centre.z(), static_cast<double>(e.bonds),
                          e.tension, e.energy, e.magnitude.value_or(std::numeric_limits<double>::quiet_NaN()), e.radius});
    }
    return t;
}

std::vector<report::Scalar> acoustic_results(const std::vector<AcousticEvent>& events) {
    double energy = 0.0;
    for (const auto& e : events) {
        energy += e.energy;
    }
    const auto magnitudes = magnitudes_of(events);
    const auto law = magnitude_law(magnitudes);
    const auto of_law = [&](const std::string& formula) { return law ? formula : "not found: " + law.reason; };
    const std::optional<double> none;
    return {{"acoustic_events", "Acoustic events", static_cast<double>(events.size()), "",
             "failures of bonds clustered in space and time, see acoustic.csv"},
            {"acoustic_energy", "Energy of acoustic events", energy, "J", "dissipated by the failed bonds' damage, not radiated"},
            {"largest_magnitude", "Largest magnitude",
             magnitudes.empty() ? none : std::optional(*std::max_element(magnitudes.begin(), magnitudes.end())), "",
             "(2/3) (log10(E / J) - 4.8), relative"},
            {"b_value", "b-value", law ? std::optional(law->b) : none, "", of_law("log10(e) / (mean M - M_c) over M >= M_c (Aki)")},
            {"b_value_error", "Its standard error", law ? std::optional(law->error) : none, "",
             of_law("ln(10) b^2 times the standard error of the mean magnitude (Shi and Bolt)")},
            {"magnitude_of_completeness", "Magnitude of completeness", law ? std::optional(law->completeness) : none, "",
             of_law("lower edge of the fullest of bins of 0.1")}};
}

report::Plot acoustic_activity_plot(const std::vector<AcousticEvent>& events) {
    report::Plot plot{"Acoustic events and their energy up to a strain, over their totals.", "axial strain [%]", "share", {}, {}};
    report::Curve number{"number of events", {}, {}, "#1f4e79"};
    report::Curve energy{"energy", {}, {}, "#c0392b"};
    double total = 0.0;
    for (const auto& e : events) {
        total += e.energy;
    }
    const std::size_t every = events.size() / 800 + 1; // more points than pixels help nobody
    double sum = 0.0;
    for (std::size_t k = 0; k < events.size(); ++k) {
        sum += events[k].energy;
        if (k % every == 0 || k + 1 == events.size()) {
            const double strain = 100.0 * events[k].axial_strain;
            number.x.push_back(strain);
            number.y.push_back(static_cast<double>(k + 1) / static_cast<double>(events.size()));
            energy.x.push_back(strain);
            energy.y.push_back(total > 0.0 ? sum / total : 0.0);
        }
    }
    plot.curves = {std::move(number), std::move(energy)};
    return plot;
}

report::Plot magnitude_plot(const std::vector<AcousticEvent>& events) {
    report::Plot plot{"Acoustic events by magnitude.", "magnitude M", "log10 of the number of events >= M", {}, {}};
    plot.x_from_zero = false;
    auto magnitudes = magnitudes_of(events);
    std::sort(magnitudes.begin(), magnitudes.end());
    report::Curve counts{"events", {}, {}, "#1f4e79", report::CurveStyle::points};
    if (!magnitudes.empty()) {
        const auto at_least = [&](double m) { return magnitudes.end() - std::lower_bound(magnitudes.begin(), magnitudes.end(), m); };
        constexpr double width = 0.1; // points at the edges of the histogram's bins
        for (double bin = std::floor(magnitudes.front() / width + 0.5); (bin - 0.5) * width <= magnitudes.back(); bin += 1.0) {
            const double m = (bin - 0.5) * width;
            if (at_least(m) > 0) {
                counts.x.push_back(m);
                counts.y.push_back(std::log10(static_cast<double>(at_least(m))));
            }
        }
    }
    plot.curves.push_back(std::move(counts));
    if (const auto law = magnitude_law(magnitudes)) {
        report::Curve line{fmt::format("b = {:.3g} \u00b1 {:.1g}", law->b, law->error), {}, {}, "#c0392b", report::CurveStyle::dashed};
        const double top = std::log10(static_cast<double>(law->events));
        line.x = {law->completeness, std::min(magnitudes.back(), law->completeness + top / law->b)};
        line.y = {top, top - law->b * (line.x[1] - line.x[0])};
        plot.curves.push_back(std::move(line));
    }
    return plot;
}

} // namespace proveta
