#include "lab/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/input/units.hpp"
#include "lab/deck_doubts.hpp"
#include "specimens/memory.hpp"

namespace proveta {

namespace {

constexpr double few_across = 8.0; // mean sphere diameters (docs/results.md, sizes)

void add_areas(const Bench& bench, const Deck& deck, std::vector<std::string>& out) {
    if (std::fabs(bench.partition.section - 1.0) > 0.015) {
        out.push_back(fmt::format("The bond areas make up {:.3f} of the section: stiffness and strength are off by as much "
                                  "(card's area rule: {}).",
                                  bench.partition.section, deck.material.values.area_rule));
    }
    if (bench.laguerre) {
        const auto pairs = static_cast<double>(bench.dropped + bench.model->bonds.size());
        if (static_cast<double>(bench.dropped) > 0.02 * pairs || bench.laguerre->unbonded_share > 0.05) {
            out.push_back(fmt::format("Exact areas: {} pairs within reach share no facet and are not bonded, and {:.1f} % of the facet "
                                      "area belongs to pairs beyond reach; set bonding.coordination so that both are few.",
                                      bench.dropped, 100.0 * bench.laguerre->unbonded_share));
        }
    }
}

} // namespace

std::vector<std::string> warnings_of_deck(const Deck& deck) {
    std::vector<std::string> out = doubts_of(deck);
    if (deck.material.values.status == "provisional") {
        out.push_back("The material card is provisional: " + deck.material.values.about + ".");
    }
    return out;
}

std::vector<std::string> warnings_in_press(const Bench& bench, const Deck& deck) {
    std::vector<std::string> out;
    const bool bonded = !deck.protocol->granular();
    if (bonded) {
        add_areas(bench, deck, out);
    }
    if (const auto& l = bench.long_bonds; l.count > 0) {
        out.push_back(
            fmt::format("{} of {} bonds are longer than {:.3g} mm, so that they soften by their own length and strengths depend on the "
                        "number of spheres: smaller spheres, or more tensile_characteristic_length.",
                        l.count, bench.model->bonds.size(), 1e3 * l.longest_allowed));
    }
    const Shape& shape = bench.specimen.shape;
    const double across = std::min(shape.lateral_size(), shape.height) / (2.0 * bench.statistics.mean_radius);
    if (bench.long_bonds.longest_allowed > 0.0 && across < few_across) {
        out.push_back(fmt::format("The specimen is only {:.1f} mean spheres wide at its narrowest; strengths scatter, and hold from about "
                                  "{:.0f} on.",
                                  across, few_across));
    }
    for (const auto& calibration : bench.calibrations) {
        if (!calibration.result.in_reach) {
            out.push_back(fmt::format("{}: Poisson's ratio {:.4g} is out of reach of the bond model, which comes to {:.3f} here; E is "
                                      "the card's. \"elasticity\": \"calibrated\" reaches higher ratios by the averaged stress.",
                                      calibration.name, calibration.result.wanted_poisson_ratio, calibration.result.poisson_ratio));
        }
    }
    if (bonded && bench.statistics.outside > 0) {
        out.push_back(fmt::format("{} spheres reach beyond the specimen's nominal surface.", bench.statistics.outside));
    }
    return out;
}

std::vector<std::string> check_before(const Deck& deck) {
    std::vector<std::string> out = warnings_of_deck(deck);
    if (deck.specimen.file.empty()) {
        require_memory(deck.specimen, deck.source, "/specimen");
        return out;
    }
    const Bench bench = set_up(deck, obtain_specimen(deck.specimen, deck.folder, deck.source));
    for (auto& warning : warnings_in_press(bench, deck)) {
        out.push_back(std::move(warning));
    }
    return out;
}

} // namespace proveta
