#include "lab/bench.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/input/units.hpp"
#include "lab/granular.hpp"
#include "lab/provenance.hpp"

namespace proveta {

Bench set_up(const Deck& deck, Specimen specimen) {
    Bench bench;
    bench.specimen = std::move(specimen);
    bench.statistics = statistics(bench.specimen);
    bench.specimen_hash = hash_of(bench.specimen);
    const auto fail = [&](const std::string& path, const std::string& found, const std::string& expected, const std::string& hint = "") {
        throw input::InputError({{deck.source, path, found, expected, hint}});
    };

    if (!deck.expected_specimen.empty() && hex(bench.specimen_hash) != deck.expected_specimen) {
        fail("/specimen_hash", deck.expected_specimen + ", while the specimen now has " + hex(bench.specimen_hash),
             "the specimen that the manifest was written for",
             "its file has changed, or the program makes packings differently now; run its deck instead");
    }

    const bool granular = deck.protocol->granular();
    Network network = granular ? make_loose(deck, bench.specimen) : make_network(deck, bench.specimen, bench.statistics);
    static_cast<NetworkFacts&>(bench) = network;
    const Material& main = network.materials.front();
    bench.grain = 2.0 * bench.statistics.mean_radius;
    if (granular) {
        const double porosity = bench.statistics.porosity;
        constexpr double typical_coordination = 6.0;
        bench.wave_speed = std::sqrt(pack_moduli(main, porosity, typical_coordination, deck.protocol->pressure()).young() /
                                     ((1.0 - porosity) * main.density));
    } else {
        bench.partition = partition(bench.specimen.shape, network.spheres, network.bonds);
        bench.wave_speed = std::sqrt(main.normal_factor * main.young_modulus / main.density);
    }

    try {
        bench.press =
            deck.protocol->press({network.spheres, network.bonds, bench.specimen.shape, network.materials, bench.grain, bench.wave_speed});
    } catch (const std::invalid_argument& e) {
        fail("/specimen", e.what(), "a specimen that fits this test's machine",
             "ask for more spheres, or for a round specimen where there is a membrane");
    }
    for (std::size_t p = 0; p < 2 && !granular; ++p) {
        const auto& platen = bench.press.platens[p];
        if (std::none_of(platen.capped.begin(), platen.capped.end(), [](double d) { return d > 0.0; })) {
            fail("/specimen", fmt::format("no sphere at the platen at {:.4g} m", platen.position),
                 "a specimen whose surface meets the platens", "import it with its true size");
        }
    }
    Numerics numerics;
    if (deck.numerics.time_step.word.empty()) {
        numerics.time_step = deck.numerics.time_step.number;
    }
    numerics.safety = deck.numerics.safety;
    numerics.skin = deck.numerics.skin;
    numerics.mass_scaling = deck.numerics.mass_scaling;
    numerics.damping = {deck.numerics.damping_translation, deck.numerics.damping_rotation, deck.numerics.damping == "viscous"};
    numerics.scheme = deck.numerics.scheme == "symplectic_euler" ? Scheme::symplectic_euler
                      : deck.numerics.scheme == "forward_euler"  ? Scheme::forward_euler
                      : deck.numerics.scheme == "taylor"         ? Scheme::taylor
                                                                 : Scheme::velocity_verlet;
    numerics.gravity = Vec3(0.0, 0.0, -deck.protocol->gravity());
    if (granular) {
        numerics.fastest = 0.5; // a stone that is flung aside is no failure
        // Hertz's contacts stiffen with their overlap: that of a hundredth of a radius more is reckoned with, not of the whole skin.
        numerics.overlap_growth = 0.01 * mean_radius(network.spheres);
    }
    try {
        Walls walls(std::move(bench.press.platens), {}, std::move(bench.press.bodies));
        bench.model = std::make_unique<Model>(std::move(network.spheres), std::move(network.materials), std::move(network.bonds),
                                              std::move(network.weight), std::move(walls), numerics, std::move(network.clusters));
        bench.model->pressures = std::move(bench.press.pressures);
    } catch (const UnstableStep& e) {
        fail("/numerics/time_step", input::format_quantity(e.asked, input::Unit::time),
             fmt::format("at most the stable step of {}", input::format_quantity(e.stable, input::Unit::time)),
             "leave it out to get the largest safe step");
    }
    return bench;
}

} // namespace proveta
