#include "lab/bench.hpp"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "core/geometry/hilbert.hpp"
#include "core/hash.hpp"
#include "core/input/units.hpp"
#include "lab/provenance.hpp"

namespace proveta {

Spheres make_spheres(const Specimen& specimen, const Deck& deck, std::vector<Material>& materials) {
    materials = {to_material(deck.material.values)};
    for (const auto& region : deck.regions) {
        materials.push_back(to_material(region.material.values));
    }
    Spheres s;
    s.planar = specimen.shape.planar();
    for (const auto k : hilbert_order(specimen.spheres.centre)) {
        const Vec3 at = specimen.spheres.centre.at(k);
        int material = 0;
        int group = specimen.group[k];
        for (std::size_t r = 0; r < deck.regions.size(); ++r) {
            const auto& box = deck.regions[r];
            bool inside = true;
            for (int c = 0; c < 3; ++c) {
                const auto axis = static_cast<std::size_t>(c);
                inside = inside && at[c] >= std::min(box.from[axis], box.to[axis]) && at[c] <= std::max(box.from[axis], box.to[axis]);
            }
            if (inside) {
                material = static_cast<int>(r) + 1;
                group = static_cast<int>(box.group);
            }
        }
        s.add(at, specimen.spheres.radius[k], materials[static_cast<std::size_t>(material)].density, group, material);
        s.id.back() = static_cast<std::int64_t>(k);
    }
    return s;
}

std::uint64_t hash_of(const Specimen& specimen) {
    Hash hash;
    for (const auto* values :
         {&specimen.spheres.centre.x, &specimen.spheres.centre.y, &specimen.spheres.centre.z, &specimen.spheres.radius}) {
        hash.mix(*values);
    }
    return hash.value();
}

namespace {

// What the cards leave to the specimen: global factors on areas, and areas that come from its tessellation.
void choose_areas(const Deck& deck, const Spheres& spheres, const std::vector<Pair>& pairs, std::vector<Material>& materials,
                  Bench& bench) {
    for (std::size_t k = 0; k < materials.size(); ++k) {
        const Card& card = k == 0 ? deck.material.values : deck.regions[k - 1].material.values;
        if (card.area_factor.word == "auto") {
            bench.area_factor = 40.0 * bench.statistics.porosity / bench.coordination;
            materials[k].area_factor = *bench.area_factor;
        }
        if (materials[k].area_rule == AreaRule::laguerre && !bench.laguerre) {
            bench.laguerre = laguerre_areas(bench.specimen.shape, spheres, pairs);
        }
    }
}

// A bond whose elastic energy at the limit exceeds its fracture energy would soften backwards in displacement.
void refuse_snap_back(const Bonds& bonds, const Deck& deck) {
    struct Worst {
        double length = 0.0;
        double allowed = 0.0;
    } tension, shear;
    const auto look = [](Worst& worst, double length, double limit, double end) {
        if (end > 0.0 && limit > end && length > worst.length) {
            worst = {length, length * end / limit};
        }
    };
    for (const auto& block : bonds.blocks) {
        const BondLaw& law = bonds.laws[block.law];
        for (auto b = block.begin; b < block.end; ++b) {
            look(tension, bonds.length[b], law.sigma_f * bonds.area[b] / bonds.stiffness[b], law.opening_f);
            look(shear, bonds.length[b], law.tau_f * bonds.area[b] / (law.shear_ratio * bonds.stiffness[b]), law.slip_f);
        }
    }
    input::Problems problems;
    for (const auto& [worst, key, what] :
         {std::tuple{tension, "fracture_energy_tension", "2 E G_f / sigma_f^2"}, {shear, "fracture_energy_shear", "2 G G_s / tau_f^2"}}) {
        if (worst.length > 0.0) {
            problems.push_back(
                {deck.source, std::string("/material/") + key,
                 fmt::format("too small for bonds {} long, which would snap back",
                             input::format_quantity(worst.length, input::Unit::length)),
                 fmt::format("bonds of at most {}, which is {}", input::format_quantity(worst.allowed, input::Unit::length), what),
                 "more spheres make shorter bonds; or give more fracture energy or less strength"});
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

} // namespace

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

    std::vector<Material> materials;
    Spheres spheres = make_spheres(bench.specimen, deck, materials);
    // Skin flags belong to the specimen's order; bring them into the model's.
    const auto flags = skin_spheres(bench.specimen);
    for (const auto id : spheres.id) {
        bench.skin.push_back(flags[static_cast<std::size_t>(id)]);
    }

    const bool automatic = deck.bonding.interaction_range.word == "auto";
    std::vector<Pair> pairs;
    try {
        pairs = bonded_pairs(spheres,
                             {deck.bonding.interaction_range.number, automatic ? coordination_of(deck.bonding, bench.specimen.shape) : 0.0,
                              deck.bonding.nearest == "absolute"},
                             bench.beta);
    } catch (const std::runtime_error& e) {
        fail("/bonding/coordination", fmt::format("{:.4g}; {}", coordination_of(deck.bonding, bench.specimen.shape), e.what()),
             "a coordination that the packing can have",
             fmt::format("the specimen has {} spheres with {:.3g} touching neighbours each", spheres.size(), bench.statistics.touching));
    }
    if (pairs.empty()) {
        fail("/bonding", "no bonds at all", "an interaction range that bonds neighbours");
    }
    bench.coordination = 2.0 * static_cast<double>(pairs.size()) / static_cast<double>(spheres.size());
    std::vector<double> weight;
    choose_areas(deck, spheres, pairs, materials, bench);
    Bonds bonds = make_bonds(spheres, materials, pairs, bench.skin, weight, bench.laguerre ? &bench.laguerre->areas : nullptr);
    if (bonds.size() == 0) {
        fail("/material/area_rule", "no bond with an area", "a rule that gives the bonds areas");
    }
    bench.dropped = pairs.size() - bonds.size();
    bench.coordination = 2.0 * static_cast<double>(bonds.size()) / static_cast<double>(spheres.size());
    refuse_snap_back(bonds, deck);
    bench.partition = partition(bench.specimen.shape, spheres, bonds);
    bench.wave_speed = std::sqrt(materials.front().normal_factor * materials.front().young_modulus / materials.front().density);

    try {
        bench.press = deck.protocol->press(spheres, bonds, bench.specimen.shape);
    } catch (const std::invalid_argument& e) {
        fail("/specimen", e.what(), "a specimen that fits this test's machine", "ask for more spheres");
    }
    for (std::size_t p = 0; p < 2; ++p) {
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
    try {
        bench.model = std::make_unique<Model>(std::move(spheres), std::move(materials), std::move(bonds), std::move(weight),
                                              std::move(bench.press.platens), numerics);
        bench.model->pressures = std::move(bench.press.pressures);
    } catch (const UnstableStep& e) {
        fail("/numerics/time_step", input::format_quantity(e.asked, input::Unit::time),
             fmt::format("at most the stable step of {}", input::format_quantity(e.stable, input::Unit::time)),
             "leave it out to get the largest safe step");
    }
    return bench;
}

} // namespace proveta
