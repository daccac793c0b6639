// Why the law facet softens in two stages: bars cut into few and many facets (docs/theory.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/laws/bond_laws.hpp"
#include "lab/verification/cases.hpp"
#include "lab/verification/facet_walk.hpp"
#include "specimens/random.hpp"

namespace proveta::verification {

namespace facet_bar_case {

constexpr double e_0 = 35.0e9;   // Pa
constexpr double bar = 0.3;      // m
constexpr double scatter = 0.25; // of the strengths of the facets in a section, even around the mean
constexpr int abreast = 64;
constexpr std::array<int, 4> cuts{20, 30, 45, 75}; // facets along the bar: 15 to 4 mm

Facet::Parameters concrete(bool two_stages) {
    Facet::Parameters p;
    p.sigma_t = 2.6e6;
    p.length_t = 0.5;
    p.exponent = 1.0;
    p.first_length = two_stages ? 0.0108 : 0.0;
    return p;
}

// The facets of a section.
std::vector<Facet::Parameters> scattered(const Facet::Parameters& p) {
    Random random(5, Stream::positions);
    std::vector<Facet::Parameters> out;
    for (int k = 0; k < abreast; ++k) {
        out.push_back(Facet::scaled(p, 1.0 + scatter * (2.0 * random.uniform() - 1.0)));
    }
    return out;
}

// Largest mean of the papers' exponentials over the facets of a section, Pa.
double papers_peak(double length) {
    const auto facets = scattered(concrete(true));
    double peak = 0.0;
    for (double e = 0.0; e < 3.0 * 2.6e6 / e_0; e += 1e-3 * 2.6e6 / e_0) {
        double mean = 0.0;
        for (const auto& one : facets) {
            mean += facet_bond_case::papers_stress(one, length, 0.5 * std::numbers::pi, e) / abreast;
        }
        peak = std::max(peak, mean);
    }
    return peak;
}

// Stress against the opening of one section, of facets of 1 m2 abreast whose strengths scatter.
struct Section {
    std::vector<double> opening, stress;
    double peak = 0.0;
    double energy = 0.0; // J/m2, that the law says was dissipated
};

Section torn(bool two_stages, double length) {
    const auto p = concrete(two_stages);
    std::vector<Facet::Constants> facets;
    for (const auto& one : scattered(p)) {
        facets.push_back(Facet::constants(one, {e_0, 0.3, 0.25}));
    }
    std::vector<Facet::State<double>> state(facets.size(), {{0, 0, 0}, 0, 0, 0});
    const BondShape<double> shape{e_0 / length, 1.0, length, 0.0, 1.0};
    Section out;
    const double step = 0.01 * p.sigma_t / e_0 * length;
    double u = 0.0;
    std::size_t failed = 0;
    while (failed < facets.size()) {
        const double du = step * (1.0 + 0.002 * u / step); // finer where it counts
        u += du;
        double force = 0.0;
        failed = 0;
        for (std::size_t k = 0; k < facets.size(); ++k) {
            const auto r = Facet::advance<double>(facets[k], shape, {-u, -du, {0.0, 0.0, 0.0}}, state[k]);
            force -= r.normal / abreast;
            out.energy += r.damage_work / abreast;
            failed += Facet::failed(state[k]) ? 1 : 0;
        }
        out.opening.push_back(u);
        out.stress.push_back(force);
        out.peak = std::max(out.peak, force);
    }
    return out;
}

// Of the whole bar: one section tears, the others give back what they hold.
report::Curve pulled(const Section& section, int facets, const char* colour) {
    const double length = bar / facets;
    report::Curve curve;
    curve.name = std::to_string(facets) + " facets";
    curve.colour = colour;
    for (std::size_t k = 0; k < section.opening.size(); ++k) {
        curve.x.push_back(1e6 * (section.opening[k] + section.stress[k] / e_0 * (bar - length)));
        curve.y.push_back(1e-6 * section.stress[k]);
    }
    return curve;
}

// Largest over smallest.
double spread(const std::vector<double>& of) {
    return *std::max_element(of.begin(), of.end()) / *std::min_element(of.begin(), of.end()) - 1.0;
}

} // namespace facet_bar_case

Case facet_bar() {
    using namespace facet_bar_case;
    return {"facet-bar", "",
            "A bar of facets of 15 to 4 mm, whose strengths scatter in each section: strength and energy against their length.", false, [] {
                Outcome out;
                constexpr std::array<const char*, 4> colours{"#1f4e79", "#1e7b46", "#b9770e", "#c0392b"};
                for (const bool two_stages : {true, false}) {
                    std::vector<double> strength;
                    std::vector<double> energy;
                    const std::string name = two_stages ? "two stages" : "one stage";
                    report::Plot plot{"A bar of 300 mm, " + name + ".", "elongation [um]", "stress [MPa]", {}, {}};
                    for (std::size_t k = 0; k < cuts.size(); ++k) {
                        const Section section = torn(two_stages, bar / cuts[k]);
                        strength.push_back(section.peak);
                        energy.push_back(section.energy);
                        plot.curves.push_back(pulled(section, cuts[k], colours[k]));
                    }
                    // G_t goes with the square of the strength: (1 + scatter^2 / 3) times that of the mean, on average.
                    out.checks.push_back(
                        {name + ": spread of the energy of a tear over lengths", 0.0, spread(energy), 0.03, Compare::absolute, ""});
                    if (two_stages) {
                        out.checks.push_back(
                            {name + ": spread of the strength over lengths", 0.0, spread(strength), 1e-3, Compare::absolute, ""});
                        // Both walk in steps of a hundredth and a thousandth of the strain at the peak, which is flat.
                        out.checks.push_back({name + ": strength of a section of 15 mm facets, by the papers' exponentials",
                                              papers_peak(bar / cuts[0]), strength[0], 1e-3, Compare::relative, "Pa"});
                    } else {
                        out.checks.push_back({name + ": strength of 4 mm facets over that of 15 mm, less 1", 0.0,
                                              strength.back() / strength.front() - 1.0, 0.0, Compare::reported, ""});
                    }
                    out.plots.push_back(plot);
                }
                out.notes.emplace_back(
                    "The scatter stands for what the irregular network does to its facets. With one stage short facets hold on "
                    "longer past their peak, so that a section of them is stronger.");
                return out;
            }};
}

} // namespace proveta::verification
