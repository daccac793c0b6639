// proveta elastic
#include <fmt/format.h>

#include <memory>

#include "core/files/whole_file.hpp"
#include "lab/cli/commands.hpp"
#include "lab/clock.hpp"
#include "lab/elastic/stiffness.hpp"
#include "lab/elastic/uniaxial.hpp"
#include "lab/network.hpp"
#include "reports/files.hpp"

namespace proveta {

namespace {

struct ElasticArguments {
    std::string specimen;
    std::string card = "concrete_sfer";
    std::vector<std::string> settings;
    std::string json;
    int threads = 0;
};

// What the command found.
struct Elasticity {
    Network network;
    std::optional<StiffnessTensor> tensor; // none of a plate
    UniaxialReading lubricated, stuck;
    double seconds = 0.0;
};

void print(const Elasticity& e, const Specimen& specimen) {
    const auto& n = e.network;
    const Material& m = n.materials.front();
    fmt::print("specimen             {}, {} spheres, {} bonds, {:.2f} a sphere\n", specimen.shape.text(), n.spheres.size(), n.bonds.size(),
               n.coordination);
    fmt::print("material             {}: a = {:.4f}, b = {:.4f}, k_t/k_n = {:.4f}, lambda/(a E) = {:.4f}\n", m.name, m.normal_factor,
               m.shear_factor, m.shear_ratio(), m.averaged_factor);
    for (const auto& calibration : n.calibrations) {
        fmt::print("calibration          {} ({} solves)\n", text_of(calibration.result), calibration.result.solves);
    }
    const auto uniaxial = [](const char* what, const UniaxialReading& r) {
        fmt::print("{}E = {:.4f} GPa, nu = {:.4f}; by platen travel {:.4f} GPa ({} iterations)\n", what, 1e-9 * r.young_modulus,
                   r.poisson_ratio, 1e-9 * r.travel_modulus, r.solution.iterations);
    };
    uniaxial("uniaxial, lubricated ", e.lubricated);
    uniaxial("uniaxial, stuck      ", e.stuck);
    if (e.tensor) {
        const auto& t = *e.tensor;
        fmt::print("interior             E = {:.4f} GPa, nu = {:.4f}, K = {:.4f} GPa, G = {:.4f} GPa ({} iterations)\n",
                   1e-9 * t.young_modulus, t.poisson_ratio, 1e-9 * t.bulk_modulus, 1e-9 * t.shear_modulus, t.iterations);
        fmt::print("isotropy             universal index {:.5f} (0: isotropic), {:.2f} % from the nearest isotropic tensor\n", t.anisotropy,
                   100.0 * t.from_isotropic);
        fmt::print("stiffness in GPa, order xx yy zz yz zx xy\n");
        for (int r = 0; r < 6; ++r) {
            for (int c = 0; c < 6; ++c) {
                fmt::print("{:10.4f}", 1e-9 * t.voigt(r, c));
            }
            fmt::print("\n");
        }
    }
    fmt::print("solved in {:.1f} s\n", e.seconds);
}

input::Json to_json(const Elasticity& e) {
    const Material& m = e.network.materials.front();
    const auto uniaxial = [](const UniaxialReading& r) {
        return input::Json{{"young_modulus", r.young_modulus}, {"poisson_ratio", r.poisson_ratio}, {"modulus_by_travel", r.travel_modulus}};
    };
    input::Json j{{"material", m.name},
                  {"normal_factor", m.normal_factor},
                  {"shear_factor", m.shear_factor},
                  {"averaged_factor", m.averaged_factor},
                  {"shear_ratio", m.shear_ratio()},
                  {"uniaxial_lubricated", uniaxial(e.lubricated)},
                  {"uniaxial_stuck", uniaxial(e.stuck)}};
    if (!e.network.calibrations.empty()) {
        j["in_reach"] = e.network.calibrations.front().result.in_reach;
    }
    if (e.tensor) {
        const auto& t = *e.tensor;
        j["interior"] = {{"young_modulus", t.young_modulus}, {"poisson_ratio", t.poisson_ratio}, {"bulk_modulus", t.bulk_modulus},
                         {"shear_modulus", t.shear_modulus}, {"anisotropy", t.anisotropy},       {"from_isotropic", t.from_isotropic}};
        for (int r = 0; r < 6; ++r) {
            j["interior"]["stiffness"].push_back(std::vector<double>(6));
            for (int c = 0; c < 6; ++c) {
                j["interior"]["stiffness"][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = t.voigt(r, c);
            }
        }
    }
    j["units"] = "Pa; stiffness in Voigt's order xx yy zz yz zx xy with engineering shear strains";
    return j;
}

int elastic(const ElasticArguments& a) {
    use_threads(a.threads);
    input::Json json{{"test", "ucs"}, {"specimen", {{"file", a.specimen}}}, {"material", {{"card", a.card}}}};
    apply_settings(json, a.settings);
    if (!a.json.empty()) {
        require_writable(a.json);
    }
    const Deck deck = read_deck(json, "elastic");
    const Specimen specimen = obtain_specimen(deck.specimen, deck.folder, deck.source);
    const auto start = Clock::now();
    Elasticity e;
    e.network = make_network(deck, specimen, statistics(specimen));
    const auto& n = e.network;
    try {
        e.lubricated = press_uniaxially(specimen.shape, n.spheres, n.materials, n.bonds, false);
        e.stuck = press_uniaxially(specimen.shape, n.spheres, n.materials, n.bonds, true, &e.lubricated.solution);
        if (!specimen.shape.planar()) {
            e.tensor = stiffness_tensor(specimen.shape, n.spheres, n.bonds, n.skin);
        }
    } catch (const std::invalid_argument& problem) {
        throw input::InputError({{a.specimen, "", problem.what(), "a specimen with spheres at both ends and inside", "more spheres"}});
    }
    e.seconds = since(start);
    print(e, specimen);
    if (!a.json.empty()) {
        report::write_json(a.json, to_json(e));
    }
    return 0;
}

} // namespace

void add_elastic(CLI::App& app, Command& chosen) {
    auto a = std::make_shared<ElasticArguments>();
    auto* command = app.add_subcommand("elastic", "stiffness, E and nu of a stored specimen, by a linear elastic solve");
    command->add_option("specimen", a->specimen, "specimen (.h5)")->required();
    command->add_option("--material", a->card, "card: one of the program's or a JSON file")->capture_default_str();
    command->add_option("--set", a->settings, "change a value of the deck: material.elasticity=as-given, bonding.coordination=9");
    command->add_option("--json", a->json, "file to write the figures to");
    command->add_option("--threads", a->threads, "number of threads; results do not depend on it")->check(CLI::Range(1, 1024));
    command->callback([a, &chosen] { chosen = [a] { return elastic(*a); }; });
}

} // namespace proveta
