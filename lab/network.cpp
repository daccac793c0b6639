#include "lab/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "core/geometry/hilbert.hpp"
#include "core/hash.hpp"
#include "core/input/units.hpp"
#include "lab/strength_scatter.hpp"

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
    for (const auto& form : specimen.forms) {
        for (const Vec3& centre : form.centre) {
            hash.mix(std::vector<double>(centre.begin(), centre.end()));
        }
        hash.mix(form.radius);
        hash.mix({form.volume, form.inertia.x(), form.inertia.y(), form.inertia.z()});
    }
    for (const auto& stone : specimen.stones) {
        const auto& [form, size, position, attitude] = stone;
        hash.mix(static_cast<std::uint64_t>(form));
        hash.mix({size, position.x(), position.y(), position.z(), attitude.w(), attitude.x(), attitude.y(), attitude.z()});
    }
    return hash.value();
}

namespace {

const Card& card_of(const Deck& deck, std::size_t material) {
    return material == 0 ? deck.material.values : deck.regions[material - 1].material.values;
}

// What the cards leave to the specimen: global factors on areas, and areas that come from its tessellation.
void choose_areas(const Deck& deck, const Spheres& spheres, const std::vector<Pair>& pairs, std::vector<Material>& materials,
                  const Specimen& specimen, double porosity, Network& out) {
    for (std::size_t k = 0; k < materials.size(); ++k) {
        const Card& card = card_of(deck, k);
        if (card.area_factor.word == "auto") {
            out.area_factor = 40.0 * porosity / out.coordination;
            materials[k].area_factor = *out.area_factor;
        }
        if (materials[k].area_rule == AreaRule::laguerre && !out.laguerre) {
            out.laguerre = laguerre_areas(specimen.shape, spheres, pairs);
        }
    }
}

// Calibrations by what they follow from: a series, or a check at half the rate, sets the same specimen up several times.
class Remembered {
  public:
    static std::optional<ElasticCalibration> find(const std::string& key) {
        const std::lock_guard lock(mutex());
        const auto at = known().find(key);
        return at == known().end() ? std::nullopt : std::optional(at->second);
    }
    static void keep(const std::string& key, const ElasticCalibration& found) {
        const std::lock_guard lock(mutex());
        known()[key] = found;
    }

  private:
    static std::mutex& mutex() {
        static std::mutex m;
        return m;
    }
    static std::map<std::string, ElasticCalibration>& known() {
        static std::map<std::string, ElasticCalibration> k;
        return k;
    }
};

// Gives the materials that ask for it the factors with which the whole specimen, of this material alone, has the card's E and nu.
void calibrate(const Deck& deck, const Specimen& specimen, const BondingRule& rule, Network& out) {
    Spheres whole; // of one material and group, and their bonds: made for the first card that wants them
    std::vector<Pair> pairs;
    std::optional<LaguerreAreas> exact;
    for (std::size_t k = 0; k < out.materials.size(); ++k) {
        const Card& card = card_of(deck, k);
        if (card.elasticity == "as-given") {
            continue;
        }
        const auto take = [&](const ElasticCalibration& found) {
            Material& material = out.materials[k];
            material.normal_factor = found.factors.normal_factor;
            material.shear_factor = found.factors.shear_factor;
            material.averaged_factor = found.factors.averaged_factor;
            out.calibrations.push_back({card.name, found});
        };
        const std::string key =
            fmt::format("{:x} {} {} {} {}", hash_of(specimen), input::write(card).dump(), rule.beta, rule.coordination, rule.absolute);
        if (const auto known = Remembered::find(key)) {
            take(*known);
            continue;
        }
        if (pairs.empty()) {
            whole = out.spheres;
            std::fill(whole.group.begin(), whole.group.end(), 0);
            std::fill(whole.material.begin(), whole.material.end(), 0);
            double beta = 0.0;
            pairs = bonded_pairs(whole, rule, beta);
        }
        const Material& material = out.materials[k];
        if (material.area_rule == AreaRule::laguerre && !exact) {
            exact = laguerre_areas(specimen.shape, whole, pairs);
        }
        const auto bonded = [&](const Material& trial) {
            std::vector<double> weight;
            return make_bonds(whole, {trial}, pairs, out.skin, weight, exact ? &exact->areas : nullptr);
        };
        try {
            const auto found = calibrate_elasticity(specimen.shape, whole, material, card.elasticity == "calibrated", bonded);
            Remembered::keep(key, found);
            take(found);
        } catch (const NotCalibrated& e) {
            const std::string path = k == 0 ? "/material/elasticity" : fmt::format("/regions/{}/material/elasticity", k - 1);
            throw input::InputError({{deck.source, path, "\"" + card.elasticity + "\", but " + e.what(),
                                      "a specimen whose elasticity can be found by pressing it",
                                      "more spheres; or \"elasticity\": \"as-given\" with normal_factor and shear_factor"}});
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
        const auto* law = std::get_if<Dempack::Constants>(&bonds.groups[block.group].law);
        for (auto b = block.begin; law != nullptr && b < block.end; ++b) {
            look(tension, bonds.length[b], law->sigma_f * bonds.area[b] / bonds.stiffness[b], law->opening_f);
            look(shear, bonds.length[b], law->tau_f * bonds.area[b] / (law->shear_ratio * bonds.stiffness[b]), law->slip_f);
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

// Facets beyond the length at which both softening stages fit.
LongBonds long_bonds(const Bonds& bonds) {
    LongBonds out;
    for (const auto& block : bonds.blocks) {
        const auto* law = std::get_if<Facet::Constants>(&bonds.groups[block.group].law);
        if (law == nullptr) {
            continue;
        }
        const double allowed = Facet::longest_bond(*law);
        out.longest_allowed = out.longest_allowed > 0.0 ? std::min(out.longest_allowed, allowed) : allowed;
        out.count += static_cast<std::size_t>(std::count_if(bonds.length.begin() + block.begin, bonds.length.begin() + block.end,
                                                            [&](double length) { return length > allowed; }));
    }
    return out;
}

} // namespace

Network make_network(const Deck& deck, const Specimen& specimen, const SpecimenStatistics& known) {
    Network out;
    const auto fail = [&](const std::string& path, const std::string& found, const std::string& expected, const std::string& hint = "") {
        throw input::InputError({{deck.source, path, found, expected, hint}});
    };
    if (!specimen.stones.empty()) {
        fail("/specimen", fmt::format("{} loose stones", specimen.stones.size()), "spheres to be bonded");
    }
    out.spheres = make_spheres(specimen, deck, out.materials);
    // Skin flags belong to the specimen's order; bring them into the model's.
    const auto flags = skin_spheres(specimen);
    for (const auto id : out.spheres.id) {
        out.skin.push_back(flags[static_cast<std::size_t>(id)]);
    }

    const bool automatic = deck.bonding.interaction_range.word == "auto";
    const BondingRule rule{deck.bonding.interaction_range.number, automatic ? coordination_of(deck.bonding, specimen.shape) : 0.0,
                           deck.bonding.nearest == "absolute"};
    std::vector<Pair> pairs;
    try {
        pairs = bonded_pairs(out.spheres, rule, out.beta);
    } catch (const std::runtime_error& e) {
        fail("/bonding/coordination", fmt::format("{:.4g}; {}", coordination_of(deck.bonding, specimen.shape), e.what()),
             "a coordination that the packing can have",
             fmt::format("the specimen has {} spheres with {:.3g} touching neighbours each", out.spheres.size(), known.touching));
    }
    if (pairs.empty()) {
        fail("/bonding", "no bonds at all", "an interaction range that bonds neighbours");
    }
    out.coordination = 2.0 * static_cast<double>(pairs.size()) / static_cast<double>(out.spheres.size());
    choose_areas(deck, out.spheres, pairs, out.materials, specimen, known.porosity, out);
    calibrate(deck, specimen, rule, out);
    out.bonds = make_bonds(out.spheres, out.materials, pairs, out.skin, out.weight, out.laguerre ? &out.laguerre->areas : nullptr);
    if (out.bonds.size() == 0) {
        fail("/material/area_rule", "no bond with an area", "a rule that gives the bonds areas");
    }
    out.dropped = pairs.size() - out.bonds.size();
    out.coordination = 2.0 * static_cast<double>(out.bonds.size()) / static_cast<double>(out.spheres.size());
    refuse_snap_back(out.bonds, deck);
    out.bonds.strength = scattered_strengths(out.spheres, out.bonds, static_cast<std::uint64_t>(deck.specimen.seed));
    out.long_bonds = long_bonds(out.bonds);
    return out;
}

} // namespace proveta
