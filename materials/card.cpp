#include "materials/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include "core/input/suggest.hpp"
#include "core/input/units.hpp"
#include "materials/builtin_cards.hpp"

namespace proveta {

using input::above;
using input::at_least;
using input::between;
using input::Unit;

namespace {

// What laws declare, for a visitor of decks.
struct LawVisitor {
    using Unit = input::Unit;
    static input::Bounds above(double low) { return input::above(low); }
    static input::Bounds at_least(double low) { return input::at_least(low); }
    static input::Bounds between(double low, double high) { return input::between(low, high); }

    input::Visitor& to;

    void number(const char* key, double& value, Unit unit, const input::Bounds& bounds, const char* meaning) {
        to.number(key, value, unit, bounds, meaning);
    }
    template <std::size_t n>
    void numbers(const char* key, double (&values)[n], Unit unit, const input::Bounds& bounds, const char* meaning) {
        std::vector<double> list(std::begin(values), std::end(values));
        to.numbers(key, list, n, unit, bounds, meaning);
        std::copy(list.begin(), list.end(), values);
    }
};

// The keys that laws declare, with the laws that have them.
struct LawKeys {
    using Unit = LawVisitor::Unit;
    static input::Bounds above(double low) { return input::above(low); }
    static input::Bounds at_least(double low) { return input::at_least(low); }
    static input::Bounds between(double low, double high) { return input::between(low, high); }

    std::map<std::string, std::vector<std::string>> laws;
    std::string now;

    template <class T> void number(const char* key, T&, Unit, const input::Bounds&, const char*) { laws[key].push_back(now); }
    template <class T> void numbers(const char* key, T&, Unit, const input::Bounds&, const char*) { laws[key].push_back(now); }
};

const std::map<std::string, std::vector<std::string>>& law_keys() {
    static const auto keys = [] {
        LawKeys all;
        for_each_bond_law([&](auto law) {
            using Law = typename decltype(law)::type;
            typename Law::Parameters p;
            all.now = Law::name;
            Law::declare(all, p);
        });
        return all.laws;
    }();
    return keys;
}

// Names the law in the meaning, for the reference and the schema; a key that an earlier law declared already is left to that one.
struct LawReference : LawVisitor {
    std::string law;

    [[nodiscard]] std::string meaning_of(const char* key, const char* meaning) const {
        const auto& laws = law_keys().at(key);
        return fmt::format("law{} {}: {}", laws.size() > 1 ? "s" : "", fmt::join(laws, ", "), meaning);
    }
    [[nodiscard]] bool first(const char* key) const { return law_keys().at(key).front() == law; }
    void number(const char* key, double& value, Unit unit, const input::Bounds& bounds, const char* meaning) {
        if (first(key)) {
            LawVisitor::number(key, value, unit, bounds, meaning_of(key, meaning).c_str());
        }
    }
    template <std::size_t n>
    void numbers(const char* key, double (&values)[n], Unit unit, const input::Bounds& bounds, const char* meaning) {
        if (first(key)) {
            LawVisitor::numbers(key, values, unit, bounds, meaning_of(key, meaning).c_str());
        }
    }
};

std::vector<input::Choice> law_choices() {
    std::vector<input::Choice> out;
    for_each_bond_law([&](auto law) { out.push_back({decltype(law)::type::name, decltype(law)::type::meaning}); });
    return out;
}

// Gives the card the parameters of its law, which start from the law's defaults when it had another.
void use_law(Card& c) {
    for_each_bond_law([&](auto law) {
        using Law = typename decltype(law)::type;
        if (c.law == Law::name && !std::holds_alternative<typename Law::Parameters>(c.bond)) {
            c.bond = typename Law::Parameters{};
        }
    });
}

void declare_law(input::Visitor& v, Card& c) {
    if (v.wants_all()) {
        for_each_bond_law([&](auto law) {
            using Law = typename decltype(law)::type;
            typename Law::Parameters p;
            LawReference reference{{v}, Law::name};
            Law::declare(reference, p);
        });
        return;
    }
    LawVisitor visitor{v};
    std::visit([&](auto& p) { LawOf<decltype(p)>::declare(visitor, p); }, c.bond);
    for (const auto& [key, laws] : law_keys()) {
        if (std::find(laws.begin(), laws.end(), c.law) == laws.end()) {
            v.refused(key.c_str(), fmt::format("it belongs to law {}; this card has law \"{}\"", fmt::join(laws, ", "), c.law).c_str());
        }
    }
}

void check_envelope(const double (&lcs)[3], const std::string& source, const std::string& path, input::Problems& problems) {
    for (std::size_t k = 1; k < 3; ++k) {
        if (lcs[k] <= lcs[k - 1]) {
            problems.push_back({source, path + "/lcs",
                                fmt::format("LCS{} = {:.4g} Pa after LCS{} = {:.4g} Pa", k + 1, lcs[k], k, lcs[k - 1]),
                                "three ascending stresses", "the envelope has its corners in this order"});
        }
    }
}

} // namespace

std::vector<input::Choice> card_statuses() {
    return {{"measured", "each number was measured by itself"},
            {"published", "as a paper prints it"},
            {"calibrated", "fitted to measurements of whole specimens"},
            {"provisional", "fitted to estimates, or not finished"},
            {"user", "made by whoever uses it"}};
}

void declare(input::Visitor& v, Card& c) {
    v.text("name", c.name, "name of the parameter set");
    v.text("about", c.about, "what it stands for");
    v.text("source", c.source, "where its numbers come from");
    v.choice("status", c.status, card_statuses(), "what stands behind it");
    v.choice("law", c.law, law_choices(),
             "constitutive law of the bonds; with another law than the card's its parameters start from the law's defaults");
    use_law(c);
    v.choice("criterion", c.criterion,
             {{"bond", "each bond's own normal and shear force (5.20-5.26)"},
              {"mohr_coulomb",
               "averaged stress of its two spheres' vicinities: c = tau_f, tan phi = mu_s, cut off at sigma_f; at once, without softening"},
              {"rankine", "averaged stress of its two spheres' vicinities: largest tension sigma_f; at once, without softening"}},
             "what decides that a bond fails");
    v.choice("area_rule", c.area_rule,
             {{"virtual_polyhedron", "weighted areas that partition space, thesis 5.3"},
              {"truncated_cone", "pi R_i R_j, (5.33)"},
              {"minimum_radius", "pi min(R_i, R_j)^2, (5.4-5.6)"},
              {"laguerre", "exact facets of the radical tessellation; a bond without a facet is dropped"}},
             "rule for the effective area of a bond; the other numbers hold for this rule only");
    v.number_or_word("area_factor", c.area_factor,
                     {{"auto", "40 P / N_c of the specimen's porosity and mean coordination (5.6); only with minimum_radius"}}, Unit::none,
                     above(0), "global factor alpha on all areas (5.5)");
    v.number("density", c.density, Unit::density, input::between(1e-3, 1e9), "density of the spheres");
    v.choice("elasticity", c.elasticity,
             {{"calibrated",
               "the specimen's: factors a and b are found for each specimen so that it has this E and nu; where no k_t / k_n gives nu, the "
               "averaged part of the stress gives the rest"},
              {"calibrated-bonds", "the same without the averaged part: the nearest nu that bonds alone reach"},
              {"as-given", "the bonds': E and nu go into them with the factors given here, and the specimen has what follows"}},
             "whose Young's modulus and Poisson's ratio the card gives");
    v.number("young_modulus", c.young_modulus, Unit::pressure, above(0), "Young's modulus; as-given: E0 of the bonds (5.34)");
    v.number("poisson_ratio", c.poisson_ratio, Unit::none, {-1.0, 0.5, true, false},
             "Poisson's ratio; as-given: of the bonds, G = E0 / (2 (1 + nu))");
    v.number("normal_factor", c.normal_factor, Unit::none, above(0), "a in k_n = a E0 A / L (5.34); only as-given");
    v.number("shear_factor", c.shear_factor, Unit::none, at_least(0), "b in k_t = b G A / L (5.34); only as-given");
    v.number("averaged_factor", c.averaged_factor, Unit::none, at_least(0),
             "lambda / (a E0): averaged part of the stress, which raises nu beyond what bonds alone reach (Celigueta et al. 2017, from a "
             "potential); only as-given");
    v.number("strength_factor", c.strength_factor, Unit::none, above(0),
             "factor on the law's strengths: dempack sigma_f, tau_f and the LCS; facet tensile_strength, "
             "compressive_yield_strength and transitional_stress");
    declare_law(v, c);
    v.number("mu_d", c.mu_d, Unit::none, between(0, 10), "Coulomb friction after failure and of new contacts (5.2.5)");
    v.number("bending_factor", c.bending_factor, Unit::none, between(0, 100),
             "bending stiffness of a bond over E I / d0 of the round beam of its area; 0: none, as in the thesis");
    v.number("twisting_factor", c.twisting_factor, Unit::none, between(0, 100), "the same for twisting, over G J / d0");
    v.number("local_damping", c.local_damping, Unit::none, between(0, 1),
             "fraction of critical damping in each bond's normal direction (5.15)");
    v.number("contact_restitution", c.contact_restitution, Unit::none, {0.0, 1.0, true, false},
             "normal restitution of contacts between unbonded spheres (2.21)");
    v.choice("restitution_rule", c.restitution_rule,
             {{"corrected", "so that the contact, which never pulls, gives the restitution back"},
              {"nominal", "by (2.21), which holds for contacts that pull: 0.5 asked gives 0.550 (linear) or 0.523 (hertz)"}},
             "how contact_restitution becomes a dashpot");
    v.choice("contact_law", c.contact_law,
             {{"linear", "LS+D (2.5.1), with the stiffness that a bond of the two spheres would have"},
              {"hertz", "HM+D (2.5.2), from young_modulus and poisson_ratio; where both spheres ask for it"}},
             "law of contacts between unbonded spheres");
    v.number("rolling_friction", c.rolling_friction, Unit::none, between(0, 10),
             "eta_r of the rolling resistance in contacts between unbonded spheres (2.42)");
}

Material to_material(const Card& c) {
    Material m;
    m.name = c.name;
    m.density = c.density;
    m.young_modulus = c.young_modulus;
    m.poisson_ratio = c.poisson_ratio;
    m.normal_factor = c.normal_factor;
    m.shear_factor = c.shear_factor;
    m.averaged_factor = c.averaged_factor;
    m.local_damping = c.local_damping;
    m.contact_restitution = c.contact_restitution;
    m.restitution_rule = c.restitution_rule == "nominal" ? RestitutionRule::nominal : RestitutionRule::corrected;
    m.contact_law = c.contact_law == "hertz" ? ContactLaw::hertz : ContactLaw::linear;
    m.rolling_friction = c.rolling_friction;
    m.area_factor = c.area_factor.word.empty() ? c.area_factor.number : 1.0;
    m.area_rule = c.area_rule == "minimum_radius"   ? AreaRule::minimum_radius
                  : c.area_rule == "truncated_cone" ? AreaRule::truncated_cone
                  : c.area_rule == "laguerre"       ? AreaRule::laguerre
                                                    : AreaRule::virtual_polyhedron;
    m.bond = std::visit([&](const auto& p) -> BondParameters { return LawOf<decltype(p)>::scaled(p, c.strength_factor); }, c.bond);
    m.mu_d = c.mu_d;
    m.criterion = c.criterion == "mohr_coulomb" ? Criterion::mohr_coulomb : c.criterion == "rankine" ? Criterion::rankine : Criterion::bond;
    m.bending = c.bending_factor;
    m.twisting = c.twisting_factor;
    return m;
}

std::vector<input::DeclaredQuantity> strengths_of(const Card& card) {
    std::vector<input::DeclaredQuantity> out = input::quantities(card);
    std::erase_if(out, [](const auto& q) { return q.unit != Unit::pressure || q.key == "young_modulus" || q.value <= 0.0; });
    for (auto& q : out) {
        q.value *= card.strength_factor;
    }
    return out;
}

bool scatters_strength(const Card& card) {
    const auto* facet = std::get_if<Facet::Parameters>(&card.bond);
    return facet != nullptr && facet->weibull_modulus > 0.0;
}

void check_card(const Card& c, const std::string& source, const std::string& path, input::Problems& problems) {
    constexpr double softest = 1e3; // Pa
    for (const auto& q : c.young_modulus < softest ? strengths_of(c) : std::vector<input::DeclaredQuantity>{}) {
        if (q.value > c.young_modulus) {
            problems.push_back({source, path + "/young_modulus",
                                fmt::format("{}, far below {} = {}", input::format_quantity(c.young_modulus, Unit::pressure), q.key,
                                            input::format_quantity(q.value, Unit::pressure)),
                                "the modulus of a material with these strengths",
                                fmt::format("did you mean \"{} GPa\"?", input::format_number(c.young_modulus))});
            break;
        }
    }
    if (c.area_factor.word == "auto" && c.area_rule != "minimum_radius") {
        problems.push_back({source, path + "/area_factor", "\"auto\" with the area rule " + c.area_rule,
                            "a number, or the area rule minimum_radius", "40 P / N_c corrects that rule's areas (5.4-5.6) and no other's"});
    }
    for (const auto& [key, value, neutral] : {std::tuple{"normal_factor", c.normal_factor, 1.0},
                                              {"shear_factor", c.shear_factor, 1.0},
                                              {"averaged_factor", c.averaged_factor, 0.0}}) {
        if (c.elasticity != "as-given" && value != neutral) {
            problems.push_back({source, path + "/" + key, fmt::format("{:.4g} with elasticity \"{}\"", value, c.elasticity),
                                "left out, or \"elasticity\": \"as-given\"", "calibration finds the factors for each specimen"});
        }
    }
    if (c.elasticity != "as-given" && (c.poisson_ratio < -0.3 || c.poisson_ratio > 0.49)) {
        problems.push_back({source, path + "/poisson_ratio", fmt::format("{:.4g} with elasticity \"{}\"", c.poisson_ratio, c.elasticity),
                            "a specimen's ratio between -0.3 and 0.49", "or \"elasticity\": \"as-given\" for the bonds' own"});
    }
    std::visit(
        [&](const auto& p) {
            if constexpr (requires { p.lcs; }) {
                check_envelope(p.lcs, source, path, problems);
            }
        },
        c.bond);
    const auto only = [&](bool used, bool allowed, const char* key, const std::string& found, const char* why) {
        if (used && !allowed) {
            problems.push_back({source, path + "/" + key, found, "left out with law \"" + c.law + "\"", why});
        }
    };
    if (scatters_strength(c) && std::get<Facet::Parameters>(c.bond).weibull_modulus < 1.0) {
        problems.push_back({source, path + "/weibull_modulus", fmt::format("{:.4g}", std::get<Facet::Parameters>(c.bond).weibull_modulus),
                            "0, or a modulus of at least 1", "concrete has 5 to 20; below 1 most facets would have no strength at all"});
    }
    const auto* dempack = std::get_if<Dempack::Parameters>(&c.bond);
    only(c.criterion != "bond", dempack != nullptr, "criterion", "\"" + c.criterion + "\"",
         "an averaged criterion takes its strengths from the law dempack");
    const bool kratos = c.law == KratosDempack::name;
    constexpr const char* no_such = "the released code has no such thing";
    only(c.averaged_factor > 0.0, !kratos, "averaged_factor", fmt::format("{}", c.averaged_factor), no_such);
    only(c.elasticity == "calibrated", !kratos, "elasticity", "\"calibrated\"", no_such);
    only(c.bending_factor > 0.0, !kratos, "bending_factor", fmt::format("{}", c.bending_factor), no_such);
    only(c.twisting_factor > 0.0, !kratos, "twisting_factor", fmt::format("{}", c.twisting_factor), no_such);
    if (dempack != nullptr && c.criterion != "bond" && (dempack->fracture_energy_n > 0.0 || dempack->fracture_energy_t > 0.0)) {
        problems.push_back({source, path + "/criterion", "\"" + c.criterion + "\" together with a fracture energy", "one of the two",
                            "an averaged criterion fails bonds at once: set fracture_energy_tension and fracture_energy_shear to 0"});
    }
}

namespace {

// A card without what a calibration says of its making, which changes nothing.
input::Json without_evidence(input::Json card) {
    if (card.is_object()) {
        card.erase("evidence");
    }
    return card;
}

} // namespace

std::vector<std::string> card_names() {
    std::vector<std::string> names;
    for (const auto& [name, text] : builtin_cards()) {
        names.emplace_back(name);
    }
    return names;
}

Card load_card(const std::string& name_or_file, const std::string& folder, const std::string& deck, const std::string& path) {
    for (const auto& [name, text] : builtin_cards()) {
        if (name_or_file == name) {
            Card card;
            input::Problems problems;
            input::read(without_evidence(input::Json::parse(text)), card, std::string("card ") + name, "", problems);
            if (!problems.empty()) {
                throw input::InputError(problems);
            }
            return card;
        }
    }
    if (name_or_file == custom_card) {
        Card card;
        card.name = custom_card;
        return card;
    }
    namespace fs = std::filesystem;
    const fs::path file = fs::path(name_or_file).is_absolute() ? fs::path(name_or_file) : fs::path(folder) / name_or_file;
    std::error_code error;
    if (!fs::exists(file, error)) {
        const std::string best = input::nearest(name_or_file, card_names());
        throw input::InputError({{deck, path, fmt::format("\"{}\", which is neither a card of the program nor a file", name_or_file),
                                  fmt::format("one of {}, or a JSON file", fmt::join(card_names(), ", ")),
                                  best.empty() ? "" : fmt::format("did you mean \"{}\"?", best)}});
    }
    input::Problems problems;
    const auto json = without_evidence(input::load_json(file.string()));
    MaterialInput material;
    material.card = custom_card;
    const bool based = json.contains("card") && json["card"].is_string();
    if (based && !builtin_cards().contains(json["card"].get<std::string>())) {
        problems.push_back({file.string(), "/card", json["card"].dump().substr(0, 60),
                            fmt::format("one of the program's cards: {}", fmt::join(card_names(), ", ")), ""});
    } else {
        preload(json, material, "", file.string(), "", problems);
    }
    material.values.name = file.stem().string();
    material.values.status = "user";
    input::read(json, material, file.string(), "", problems);
    check_card(material.values, file.string(), "", problems);
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    return material.values;
}

void declare(input::Visitor& v, MaterialInput& material) {
    v.text("card", material.card,
           "material card: a name that `proveta describe` lists, a JSON file, or \"custom\" for none; the other keys override it");
    declare(v, material.values);
}

void preload(const input::Json& json, MaterialInput& material, const std::string& folder, const std::string& source,
             const std::string& path, input::Problems& problems) {
    if (json.is_object() && json.contains("card") && json["card"].is_string()) {
        material.card = json["card"].get<std::string>();
    }
    try {
        material.values = load_card(material.card, folder, source, path + "/card");
    } catch (const input::InputError& e) {
        problems.insert(problems.end(), e.problems.begin(), e.problems.end());
    }
}

} // namespace proveta
