#include "lab/axial_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace proveta {

namespace {

constexpr double peak_fall = 0.95;    // of a peak, below which it counts as passed
constexpr double elastic_loss = 0.01; // of the work, dissipated in an elastic part at most
constexpr double capping = 0.1;       // of a radius: what an end's grinding or cap would level out

std::optional<double> last_of(const report::Table& t, const char* column) {
    return t.rows.empty() ? std::nullopt : std::optional(t.rows.back()[t.column(column)]);
}

} // namespace

Press axial_press(const Spheres& spheres, const Shape& shape, double friction, double stiffness) {
    Press press;
    press.platens = {make_platen(spheres, {}, 0.0, friction, shape.section(), capping),
                     make_platen(spheres, {.inward = -1.0}, shape.height, friction, shape.section(), capping)};
    for (auto& platen : press.platens) {
        platen.area_weight *= stiffness;
    }
    press.length = shape.height;
    press.area = shape.section();
    press.inner = shape.inner(0.6, 0.6);
    return press;
}

std::optional<double> peak_if_passed(const std::vector<double>& y) {
    if (y.empty()) {
        return std::nullopt;
    }
    const auto peak = std::max_element(y.begin(), y.end());
    return *std::min_element(peak, y.end()) < peak_fall * *peak ? std::optional(*peak) : std::nullopt;
}

Loading until_recovery(const Loading& l) {
    if (l.deviator.empty()) {
        return l;
    }
    const double largest = l.deviator[peak_index(l.deviator)];
    std::size_t peak = 0;
    double lowest = l.deviator[0]; // since the peak
    for (std::size_t k = 1; k < l.deviator.size(); ++k) {
        lowest = std::min(lowest, l.deviator[k]);
        if (l.deviator[k] > l.deviator[peak]) {
            if (l.deviator[peak] >= 0.5 * largest && lowest < peak_fall * l.deviator[peak]) {
                return first_samples(l, k);
            }
            peak = k;
            lowest = l.deviator[k];
        }
    }
    return l;
}

std::size_t elastic_samples(const Measured& m, const Loading& l) {
    std::vector<std::vector<double>> lost;
    for (const char* term : {"damage", "plastic", "friction"}) {
        lost.push_back(m.energy.values(term));
    }
    const auto platens = m.energy.values("platens");
    const auto pressure = m.energy.values("pressure");
    std::size_t n = 0;
    for (const auto row : l.row) {
        if (row >= platens.size() || lost[0][row] + lost[1][row] + lost[2][row] > elastic_loss * std::fabs(platens[row] + pressure[row])) {
            break;
        }
        ++n;
    }
    return n;
}

std::vector<report::Scalar> elastic_results(const Loading& l) {
    const auto line = line_between(l.gauge, l.deviator, 0.1, 1.0 / 3.0);
    const auto travel = line_between(l.strain, l.deviator, 0.1, 1.0 / 3.0);
    const auto lateral = slope_between(l.girth, l.deviator, 0.1, 1.0 / 3.0);
    const auto half = x_at_share(l.gauge, l.deviator, 0.5);
    const double peak = l.deviator.empty() ? 0.0 : l.deviator[peak_index(l.deviator)];
    const auto slope = [](const std::optional<Line>& x) { return x ? std::optional(x->slope) : std::nullopt; };
    const auto toe = travel && travel->slope > 0.0 ? std::optional(-travel->intercept / travel->slope) : std::nullopt;
    return {{"young_modulus", "Young's modulus E", slope(line), "Pa",
             "slope of deviatoric stress over middle gauge strain, 10 % to 33 % of the peak deviator (EN 12390-13)"},
            {"young_modulus_platens", "Modulus from platen travel", slope(travel), "Pa", "the same with platen travel as strain"},
            {"tangent_modulus", "Tangent modulus at 50 %", slope_between(l.gauge, l.deviator, 0.4, 0.6), "Pa",
             "slope between 40 % and 60 % of the peak deviator (ASTM D7012)"},
            {"secant_modulus", "Secant modulus at 50 %", half && *half > 0.0 ? std::optional(0.5 * peak / *half) : std::nullopt, "Pa",
             "half the peak deviator over its gauge strain (ASTM D7012)"},
            {"average_modulus", "Average modulus", slope_between(l.gauge, l.deviator, 0.2, 0.6), "Pa",
             "slope of the straighter part, 20 % to 60 % of the peak deviator (ASTM D7012)"},
            {"poisson_ratio", "Poisson's ratio", line && lateral ? std::optional(-line->slope / *lateral) : std::nullopt, "",
             "minus circumferential over gauge axial strain, 10 % to 33 % of the peak deviator"},
            {"toe_strain", "Toe of the platens' curve", toe, "",
             "where the straight part (10 % to 33 %), drawn on, meets zero deviator; strains above are not corrected by it"}};
}

std::vector<report::Scalar> softening_results(const Loading& l) {
    std::optional<std::size_t> below90;
    std::optional<std::size_t> below60;
    const std::size_t peak = peak_index(l.deviator);
    for (std::size_t k = peak; k < l.deviator.size(); ++k) {
        if (!below90 && l.deviator[k] < 0.9 * l.deviator[peak]) {
            below90 = k;
        }
        if (!below60 && l.deviator[k] < 0.6 * l.deviator[peak]) {
            below60 = k;
        }
    }
    const auto line = below90 && below60 ? fit(l.strain, l.deviator, *below90, *below60) : std::nullopt;
    return {{"post_peak_slope", "Post-peak slope", line ? std::optional(line->slope) : std::nullopt, "Pa",
             "deviatoric stress over platen strain between 90 % and 60 % of the peak, falling"}};
}

std::vector<report::Scalar> loop_results(std::size_t n) {
    return {{fmt::format("unloading_modulus_{}", n), fmt::format("Unloading modulus, cycle {}", n), std::nullopt, "Pa",
             "secant over the middle gauge from its largest strain to where the platens turned again"},
            {fmt::format("unloading_strain_{}", n), fmt::format("Strain at unloading, cycle {}", n), std::nullopt, "",
             "largest strain of the middle gauge, since the loading began"},
            {fmt::format("residual_strain_{}", n), fmt::format("Residual strain, cycle {}", n), std::nullopt, "",
             "strain of the middle gauge where the platens turned again, since the loading began"}};
}

std::vector<report::Scalar> cycle_results(const report::Table& curve, double sense) {
    std::vector<report::Scalar> out;
    std::size_t n = 0;
    const auto stage = curve.values("stage");
    const auto phase = curve.values("phase");
    const auto strain = curve.values("gauge_axial_strain");
    const auto stress = curve.values("deviatoric_stress");
    const auto begun = std::find(phase.begin(), phase.end(), phase_loading) - phase.begin();
    for (std::size_t k = 1; k < stage.size(); ++k) {
        if (phase[k] != phase_cycling || phase[k - 1] != phase_loading) {
            continue; // not the first row of an unloading
        }
        std::size_t end = k;
        while (end + 1 < stage.size() && stage[end + 1] == stage[k]) {
            ++end;
        }
        std::size_t top = k - 1; // the platens have a way to go on until they stop
        for (std::size_t row = k; row <= end; ++row) {
            top = sense * strain[row] > sense * strain[top] ? row : top;
        }
        const double drop = sense * (stress[top] - stress[end]);
        const double back = sense * (strain[top] - strain[end]);
        const double left = sense * (strain[end] - strain[static_cast<std::size_t>(begun)]);
        auto loop = loop_results(++n);
        loop[0].value = back > 0.0 ? std::optional(drop / back) : std::nullopt;
        loop[1].value = left + back;
        loop[2].value = left;
        out.insert(out.end(), loop.begin(), loop.end());
    }
    return out;
}

std::vector<report::Scalar> energy_results(const Measured& m) {
    double area = 0.0;
    double energy = 0.0;
    for (const auto& failure : m.events) {
        area += failure.area;
        energy += failure.energy;
    }
    return {{"work", "Work of the platens", last_of(m.energy, "platens"), "J", "to the end of the test"},
            {"damage_energy", "Energy dissipated by cracking", last_of(m.energy, "damage"), "J",
             "damage and failure of bonds, to the end of the test"},
            {"crack_area", "Area of the cracks", area, "m2", "sum of the areas of failed bonds, to the end of the test"},
            {"crack_energy", "Energy per area of the cracks", area > 0.0 ? std::optional(energy / area) : std::nullopt, "J/m2",
             "dissipated by the bonds that failed, over their area"}};
}

PlotSpec stress_strain_plot(const std::string& title, const std::string& stress) {
    return {title,
            "axial strain [%]",
            "axial stress [MPa]",
            100.0,
            1e-6,
            {{"axial_strain", stress, "platens", "#1f4e79"},
             {"gauge_axial_strain", stress, "middle gauge", "#1e7b46", true},
             {"circumferential_strain", stress, "circumferential", "#b9770e", true}},
            true};
}

} // namespace proveta
