#include "lab/deck_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/input/units.hpp"

namespace proveta {

namespace {

using input::DeclaredQuantity;
using input::format_quantity;
using input::Unit;

// Of dense matter in a press no stress is as low, no length as large and no density as low as these.
constexpr double low_stress = 1e3;   // Pa
constexpr double long_length = 10.0; // m
constexpr double low_density = 50.0; // kg/m3
constexpr double high_density = 3e4; // kg/m3, above all matter
// Stiffness over strength of what breaks is some 100 to 100,000.
constexpr double stiffest = 1e7;
constexpr double softest = 20.0;

// The unit that a value lacks by the look of it; empty: none.
std::string lacking(const DeclaredQuantity& q) {
    switch (q.unit) {
    case Unit::pressure: return q.value <= 0.0 || q.value >= low_stress ? "" : q.key == "young_modulus" ? "GPa" : "MPa";
    case Unit::length: return std::fabs(q.value) > long_length ? "mm" : "";
    case Unit::density: return q.value > 0.0 && q.value < low_density ? "g/cm3" : "";
    case Unit::angle: return std::fabs(q.value) > 2.0 * std::numbers::pi + 1e-9 ? "deg" : "";
    default: return "";
    }
}

// Strains and stresses of the loading that no such test comes to.
void look_at_loading(const Deck& deck, const std::vector<DeclaredQuantity>& all, std::vector<std::string>& out) {
    constexpr double far = 0.25;   // of a test's axial strain
    constexpr double heavy = 0.05; // of E
    const double young = deck.material.values.young_modulus;
    for (const auto& q : all) {
        if (q.key == "axial_strain" && q.path.starts_with("/loading/stop") && q.value > far) {
            out.push_back(fmt::format("{}: {:.4g} is {:.4g} %: is \"{:.4g} %\" meant?", q.path, q.value, 100.0 * q.value, q.value));
        }
        if (q.unit == Unit::pressure && q.path.starts_with("/loading") && q.path.find("membrane") == std::string::npos &&
            q.value > heavy * young) {
            out.push_back(fmt::format("{}: {} is {:.2g} of /material/young_modulus, {}: is one of the two in another unit?", q.path,
                                      format_quantity(q.value, q.unit), q.value / young, format_quantity(young, Unit::pressure)));
        }
    }
}

// Stiffness against strengths of one material; path: its object.
void look_at_strengths(const Card& card, const std::string& path, std::vector<std::string>& out) {
    const auto strengths = strengths_of(card);
    if (strengths.empty()) {
        return;
    }
    const auto [low, high] =
        std::minmax_element(strengths.begin(), strengths.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    const std::string modulus = fmt::format("{}/young_modulus: {}", path, format_quantity(card.young_modulus, Unit::pressure));
    if (card.young_modulus < high->value) {
        out.push_back(fmt::format(
            "{} is below {} = {}, so that bonds stretch to more than twice their length before they break: does one of the two lack its "
            "unit?",
            modulus, high->key, format_quantity(high->value, Unit::pressure)));
    } else if (card.young_modulus < softest * high->value) {
        out.push_back(
            fmt::format("{} is only {:.2g} times {} = {}, where 100 to 100,000 times are usual: is one of the two in another unit?",
                        modulus, card.young_modulus / high->value, high->key, format_quantity(high->value, Unit::pressure)));
    } else if (card.young_modulus > stiffest * low->value) {
        out.push_back(fmt::format("{} is {:.2g} times {} = {}, where 100 to 100,000 times are usual: is one of the two in another unit?",
                                  modulus, card.young_modulus / low->value, low->key, format_quantity(low->value, Unit::pressure)));
    }
}

} // namespace

std::vector<std::string> likely_without_unit(const std::vector<DeclaredQuantity>& all) {
    std::vector<std::string> out;
    for (const auto& q : all) {
        if (q.unit == Unit::density && q.value > high_density) {
            out.push_back(fmt::format("{}: {} is more than any matter has: is it in kg/m3?", q.path, format_quantity(q.value, q.unit)));
        }
        if (const std::string unit = lacking(q); !unit.empty()) {
            out.push_back(fmt::format("{}: {} is likely to lack its unit: \"{} {}\"?", q.path, format_quantity(q.value, q.unit),
                                      input::format_number(q.value), unit));
        }
    }
    return out;
}

std::vector<std::string> doubts_of(const Deck& deck) {
    const auto all = input::quantities(deck);
    std::vector<std::string> out = likely_without_unit(all);
    if (!deck.protocol->granular()) {
        look_at_loading(deck, all, out);
        look_at_strengths(deck.material.values, "/material", out);
        for (std::size_t k = 0; k < deck.regions.size(); ++k) {
            look_at_strengths(deck.regions[k].material.values, fmt::format("/regions/{}/material", k), out);
        }
    }
    return out;
}

} // namespace proveta
