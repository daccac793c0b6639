#include "lab/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "lab/deck.hpp"
#include "lab/derived.hpp"

namespace proveta {

namespace {

constexpr std::size_t few = 9;           // spheres under a platen
constexpr double coordination_off = 0.1; // strengths go about with the number of bonds (docs/results.md, packings)
constexpr double unloading_off = 0.005;  // of all bonds
constexpr double modulus_tolerance = 0.1;

std::string stress(double pascal) { return fmt::format("{:.3g} MPa", 1e-6 * pascal); }

// In the prefix that fits it, from Pa to GPa.
std::string modulus(double pascal) { return input::format_quantity(std::stod(fmt::format("{:.3g}", pascal)), input::Unit::pressure); }

} // namespace

std::string few_at_platens(const std::vector<std::size_t>& touching) {
    if (std::none_of(touching.begin(), touching.end(), [](std::size_t n) { return n <= few; })) {
        return "";
    }
    return fmt::format(
        "The platens touch {} spheres at the start: with {} or fewer, stiffness and strength are those of these contacts rather "
        "than of the material.",
        fmt::join(touching, " and "), few);
}

std::string unlike_the_cards(const Card& card, double coordination, bool planar) {
    BondingInput usual;
    Shape shape;
    shape.kind = planar ? ShapeKind::plate : ShapeKind::cylinder;
    const double wanted = coordination_of(usual, shape);
    if (card.status == "user" || std::fabs(coordination / wanted - 1.0) <= coordination_off) {
        return "";
    }
    return fmt::format("{:.1f} bonds a sphere, where the card's strengths hold for {:.1f}: those found are about as much {}.", coordination,
                       wanted, coordination > wanted ? "higher" : "lower");
}

std::string recovered_peak(const Loading& l) {
    const std::size_t again = until_recovery(l).deviator.size();
    if (again == l.deviator.size()) {
        return "";
    }
    const auto begin = l.deviator.begin();
    const auto peak = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(again));
    const auto trough = std::min_element(peak, begin + static_cast<std::ptrdiff_t>(again));
    const double highest = *std::max_element(trough, l.deviator.end());
    return fmt::format(
        "The stress fell from a peak of {} by {:.0f} % and rose above it again, to {}: no single figure is its strength; see "
        "the curve.",
        stress(*peak), 100.0 * (1.0 - *trough / *peak), stress(highest));
}

std::string broken_by_unloading(const report::Table& curve, const std::vector<FailureEvent>& events, std::size_t bonds, double sense) {
    const auto stage = curve.values("stage");
    const auto phase = curve.values("phase");
    const auto time = curve.values("time");
    const auto strain = curve.values("axial_strain");
    std::size_t most = 0;
    std::size_t cycle = 0;
    for (std::size_t k = 1, n = 0; k < stage.size(); ++k) {
        if (phase[k] != phase_cycling || phase[k - 1] != phase_loading) {
            continue; // not the first row of an unloading
        }
        ++n;
        std::size_t end = k;
        std::size_t top = k - 1; // the platens have a way to go on until they stop
        for (std::size_t row = k; row < stage.size() && stage[row] == stage[k]; ++row) {
            end = row;
            top = sense * strain[row] > sense * strain[top] ? row : top;
        }
        const auto failed = static_cast<std::size_t>(
            std::count_if(events.begin(), events.end(), [&](const auto& e) { return e.time > time[top] && e.time <= time[end]; }));
        if (failed > most) {
            most = failed;
            cycle = n;
        }
    }
    const double share = bonds > 0 ? static_cast<double>(most) / static_cast<double>(bonds) : 0.0;
    return share <= unloading_off ? ""
                                  : fmt::format("{:.1f} % of all bonds failed while the specimen was unloaded (cycle {}): its unloading "
                                                "modulus is not that of an elastic unloading.",
                                                100.0 * share, cycle);
}

std::string modulus_off(const Card& card, const std::vector<report::Scalar>& results, const Measured& m) {
    const auto measured = [&](const char* name) {
        return std::find_if(results.begin(), results.end(), [&](const auto& s) { return s.name == name && s.value && *s.value != 0.0; });
    };
    auto e = measured("young_modulus");
    e = e == results.end() ? measured("young_modulus_platens") : e; // where the gauge saw nothing
    const bool asked = std::any_of(results.begin(), results.end(), [](const auto& s) { return s.name == "young_modulus"; });
    if (asked && e == results.end() && card.elasticity != "as-given") {
        return fmt::format("E could not be measured, so that nothing tells whether the specimen has the {} of its card.",
                           modulus(card.young_modulus));
    }
    if (card.elasticity == "as-given" || e == results.end() || std::fabs(*e->value / card.young_modulus - 1.0) <= modulus_tolerance) {
        return "";
    }
    const Loading l = loading_of(m.curve, m.press.sense);
    const auto third = first_reaching(l.deviator, l.deviator[peak_index(l.deviator)] / 3.0, l.deviator.size() - 1);
    const bool lossy = third && elastic_samples(m, l) <= *third;
    return fmt::format("E comes out as {}, where the card asks for {} ({:+.0f} %){}", modulus(*e->value), modulus(card.young_modulus),
                       100.0 * (*e->value / card.young_modulus - 1.0),
                       lossy ? ": the range that it is taken from is no longer elastic." : ".");
}

std::vector<std::string> doubts_about(const Card& card, const Bench& bench, const std::vector<report::Scalar>& results, const Measured& m) {
    std::vector<std::size_t> touching;
    for (std::size_t p = 0; p < 2; ++p) {
        const auto& capped = bench.model->walls.platens[p].capped;
        touching.push_back(static_cast<std::size_t>(std::count_if(capped.begin(), capped.end(), [](double d) { return d > 0.0; })));
    }
    std::vector<std::string> out{few_at_platens(touching), unlike_the_cards(card, bench.coordination, bench.specimen.shape.planar()),
                                 recovered_peak(loading_of(m.curve, m.press.sense)),
                                 broken_by_unloading(m.curve, m.events, bench.model->bonds.size(), m.press.sense),
                                 bench.model->materials.size() == 1 ? modulus_off(card, results, m) : ""};
    std::erase(out, "");
    return out;
}

} // namespace proveta
