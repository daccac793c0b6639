#include "lab/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/input/suggest.hpp"
#include "lab/protocols/registry.hpp"
#include "lab/series/expand.hpp"

namespace proveta {

using input::above;
using input::at_least;
using input::between;
using input::Json;
using input::Unit;

void declare(input::Visitor& v, MaterialRegion& r) {
    v.numbers("from", r.from, 3, Unit::length, input::any_number(), "corner of a box, x y z; the axis is z, the base z = 0");
    v.numbers("to", r.to, 3, Unit::length, input::any_number(), "opposite corner");
    v.integer("group", r.group, 0, 1000000, "cohesive group of the spheres inside; only spheres of one group are bonded");
    v.section("material", r.material,
              "material of the spheres inside; what it does not say, nor its card, is as the deck's material has it");
}

void declare(input::Visitor& v, BondingInput& b) {
    v.number_or_word("interaction_range", b.interaction_range, {{"auto", "found so that the mean coordination is met"}}, Unit::none,
                     between(0, 1), "beta: spheres are bonded when their distance is at most (1 + beta)(R_i + R_j)");
    v.number_or_word("coordination", b.coordination, {{"auto", "10; in a plate 5.1"}}, Unit::none, {0.0, 30.0, true, false},
                     "mean number of bonds a sphere, when interaction_range is \"auto\"");
    v.choice("nearest", b.nearest,
             {{"relative", "gap over the sum of radii"}, {"absolute", "gap itself, as the released DEMpack code does"}},
             "which pairs are the nearest, when interaction_range is \"auto\"");
}

double coordination_of(const BondingInput& b, const Shape& shape) {
    if (b.coordination.word.empty()) {
        return b.coordination.number;
    }
    return shape.planar() ? 5.1 : 10.0; // meshes 2D-1 to 2D-3 of the thesis have 5.08 to 5.24 (table 5.3)
}

void declare(input::Visitor& v, NumericsInput& n) {
    v.number_or_word("time_step", n.time_step, {{"auto", "safety times the bound on the stable step"}}, Unit::time, above(0),
                     "time step; one above the stable step is refused");
    v.number("safety", n.safety, Unit::none, {0.0, 1.0, true, false}, "fraction of the bound on the stable step");
    v.choice("scheme", n.scheme,
             {{"velocity_verlet", "second order, stable up to the stable step"},
              {"symplectic_euler", "the same path with velocities of whole steps; first order where forces act from the start"},
              {"forward_euler", "unstable without damping whatever the step; for comparison"},
              {"taylor", "unstable without damping whatever the step; for comparison"}},
             "integration scheme (2.6.1)");
    v.choice("damping", n.damping,
             {{"nonviscous", "a share of the unbalanced force against the velocity (5.18-5.19)"},
              {"viscous", "a force against the velocity in proportion to velocity and mass"}},
             "background damping");
    v.number("damping_translation", n.damping_translation, Unit::none, at_least(0),
             "alpha_t of the background damping, below 1; viscous: rate in 1/s");
    v.number("damping_rotation", n.damping_rotation, Unit::none, at_least(0),
             "alpha_r of the background damping, below 1; viscous: rate in 1/s");
    v.number("skin", n.skin, Unit::none, between(0.01, 2), "skin of the neighbour lists over the mean radius; changes speed, not results");
    v.number(
        "mass_scaling", n.mass_scaling, Unit::none, between(0, 1),
        "mass that may be added to the small spheres that limit the time step, over the specimen's; their inertia grows with it, weight, "
        "stiffness and strength do not; 0: none");
}

void declare(input::Visitor& v, OutputInput& o) {
    v.integer("samples", o.samples, 10, 1000000, "rows of curve.csv over the whole strain range");
    v.integer("fields", o.fields, 0, 10000, "VTK field files over the whole strain range; 0: none");
    v.integer(
        "pictures", o.pictures, 0, 4000,
        "height in pixels of the PNG pictures: the specimen intact, at the peak, past it and at the end, and a still at every field file; "
        "0: none");
    v.number("checkpoint_every", o.checkpoint_every, Unit::time, at_least(0),
             "wall time between checkpoints; 0: only where a stage ends, and at the end");
}

void declare(input::Visitor& v, Deck& d) {
    v.choice("test", d.test, test_choices(), "the laboratory test");
    v.text("title", d.title, "title of the report");
    v.section("specimen", d.specimen, "the specimen: made by a recipe, or taken from a file");
    const bool bonded = !d.protocol->granular();
    if (bonded) {
        v.section("bonding", d.bonding, "which spheres are bonded");
    }
    v.section("material", d.material, "the material: a card and what to change in it");
    if (bonded) {
        v.list("regions", d.regions, "boxes of the specimen with another material or cohesive group; later ones win");
    } else {
        v.refused("bonding", "a loose specimen has no bonds");
        v.refused("regions", "a loose specimen is of one material");
    }
    v.section("loading", *d.protocol, "the loading, as the test has it");
    v.section("numerics", d.numerics, "how the calculation is carried out");
    v.section("output", d.output, "what is written");
}

namespace {

// What lies outside the specimen, or is beyond any bound that its own making could find.
void check_reach(const Deck& deck, input::Problems& problems) {
    if (!deck.specimen.file.empty() || deck.specimen.granular()) {
        return; // as large as what is in there
    }
    const Shape shape = shape_of(deck.specimen);
    const bool round = shape.kind == ShapeKind::cylinder;
    const double half_x = 0.5 * (round ? shape.diameter : shape.width);
    const double half_y = shape.planar() ? 0.0 : 0.5 * (round ? shape.diameter : shape.depth);
    const double low[3] = {-half_x, -half_y, 0.0};
    const double high[3] = {half_x, half_y, shape.height};
    for (std::size_t k = 0; k < deck.regions.size(); ++k) {
        const auto& r = deck.regions[k];
        for (std::size_t c = 0; c < 3; ++c) {
            if (std::min(r.from[c], r.to[c]) > high[c] || std::max(r.from[c], r.to[c]) < low[c]) {
                problems.push_back({deck.source, fmt::format("/regions/{}", k),
                                    fmt::format("{} from {:.6g} to {:.6g} m", std::string(1, "xyz"[c]), r.from[c], r.to[c]),
                                    fmt::format("a box that reaches into the {}, {} from {:.6g} to {:.6g} m", shape.text(),
                                                std::string(1, "xyz"[c]), low[c], high[c]),
                                    ""});
                break;
            }
        }
    }
    // A stable step is about the time in which a wave crosses a sphere; mass scaling makes it some times longer.
    const Card& card = deck.material.values;
    const double radius = std::cbrt(3.0 * shape.volume() / (4.0 * std::numbers::pi * static_cast<double>(deck.specimen.spheres)));
    const double crossing = radius * std::sqrt(card.density / card.young_modulus);
    const double beyond = 30.0 * crossing;
    constexpr double endless = 1e-5;
    if (deck.numerics.time_step.word.empty() && deck.numerics.time_step.number < endless * crossing) {
        problems.push_back({deck.source, "/numerics/time_step", input::format_quantity(deck.numerics.time_step.number, Unit::time),
                            fmt::format("a step near the stable one, some {:.1g} s here: no end is in sight of a test in shorter ones than "
                                        "a {:.0e}th of it",
                                        crossing, 1.0 / endless),
                            "\"auto\""});
    }
    if (deck.numerics.time_step.word.empty() && deck.numerics.time_step.number > beyond && !shape.planar()) {
        problems.push_back({deck.source, "/numerics/time_step", input::format_quantity(deck.numerics.time_step.number, Unit::time),
                            fmt::format("a stable step, which is far below {:.2g} s here", beyond), "\"auto\""});
    }
}

// The card of a region's material; without one it begins as the deck's own material.
void preload_region(const Json& json, std::size_t k, Deck& deck, input::Problems& problems) {
    const Json& region = json["regions"][k];
    const std::string at = fmt::format("/regions/{}", k);
    const bool has_material = region.is_object() && region.contains("material") && region["material"].is_object();
    MaterialInput& material = deck.regions[k].material;
    if (has_material && region["material"].contains("card")) {
        preload(region["material"], material, deck.folder, deck.source, at + "/material", problems);
        return;
    }
    if (region.is_object() && (!has_material || region["material"].empty()) && !region.contains("group")) {
        problems.push_back({deck.source, at, "a box in which nothing is different", "a \"material\" or a \"group\" of its own", ""});
    }
    material = deck.material;
    if (json.contains("material") && json["material"].is_object()) {
        input::Problems said_there;
        input::read(json["material"], material, deck.source, "/material", said_there);
    }
}

} // namespace

Deck read_deck(const Json& given, const std::string& file) {
    Json json = given;
    input::Problems problems;
    Deck deck;
    deck.source = file;
    deck.folder = std::filesystem::absolute(file).parent_path().string();
    if (!json.is_object() || !json.contains("test")) {
        problems.push_back({file, "/test", "no test", fmt::format("one of {}", fmt::join(test_names(), ", ")),
                            "the smallest complete deck is { \"test\": \"ucs\" }"});
    }
    const std::string test = input::text_at(json, "test");
    deck.protocol = make_protocol(test);
    if (!deck.protocol) {
        deck.protocol = make_protocol(test_names().front()); // to read the rest; the name itself is complained about below
    }
    deck.protocol->suggest(deck.specimen);
    deck.material.card = deck.protocol->card();
    // The cards come first: the deck's other keys override them.
    if (json.is_object()) {
        preload(json.contains("material") ? json["material"] : Json::object(), deck.material, deck.folder, file, "/material", problems);
        if (json.contains("regions") && json["regions"].is_array() && json["regions"].size() <= 10000) {
            deck.regions.resize(json["regions"].size());
            for (std::size_t k = 0; k < deck.regions.size(); ++k) {
                preload_region(json, k, deck, problems);
            }
        }
    }
    if (json.is_object() && json.contains("specimen")) {
        read_grading_files(json["specimen"], deck.folder, file, "/specimen", problems);
    }
    const bool has_card = std::none_of(problems.begin(), problems.end(), [](const auto& p) { return p.path == "/material/card"; });
    input::read(json, deck, file, "", problems);
    if (!has_card) { // whose law nobody knows
        std::erase_if(problems, [](const auto& p) {
            return p.path.starts_with("/material/") && p.suggestion.find("belongs to law") != p.suggestion.npos;
        });
    }
    check_recipe(deck.specimen, file, "/specimen", problems);
    check_card(deck.material.values, file, "/material", problems);
    for (std::size_t k = 0; k < deck.regions.size(); ++k) {
        check_card(deck.regions[k].material.values, file, fmt::format("/regions/{}/material", k), problems);
    }
    if (deck.numerics.damping != "viscous") {
        for (const auto& [key, value] : {std::pair{"damping_translation", deck.numerics.damping_translation},
                                         std::pair{"damping_rotation", deck.numerics.damping_rotation}}) {
            if (value >= 1.0) {
                problems.push_back({file, fmt::format("/numerics/{}", key), fmt::format("{:.6g}", value), "a share of the force below 1",
                                    "a rate in 1/s goes with \"damping\": \"viscous\""});
            }
        }
    }
    if (problems.empty()) {
        check_reach(deck, problems);
        deck.protocol->check(deck, problems);
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
    if (deck.title.empty()) {
        deck.title = deck.protocol->about().title;
    }
    return deck;
}

void apply_settings(Json& json, const std::vector<std::string>& settings) {
    input::Problems problems;
    for (const auto& setting : settings) {
        try {
            (void)Json(setting).dump();
        } catch (const Json::type_error&) {
            problems.push_back({"--set", "", "text that is not UTF-8", "key=value in UTF-8", ""});
            continue;
        }
        const auto equals = setting.find('=');
        if (equals == std::string::npos || equals == 0) {
            problems.push_back({"--set", "", "\"" + setting + "\"", "key=value, such as loading.rate=0.02", ""});
            continue;
        }
        std::string path = setting.substr(0, equals);
        const std::string text = setting.substr(equals + 1);
        const Json value = Json::accept(text) ? input::parse_json(text, "--set " + path) : Json(text);
        Json* at = &json;
        std::size_t start = 0;
        while (at != nullptr) {
            const auto dot = path.find('.', start);
            const std::string key = path.substr(start, dot - start);
            if (!at->is_object() && !at->is_null()) {
                problems.push_back({"--set", "", "\"" + setting + "\"", "a key inside an object", ""});
                break;
            }
            if (dot == std::string::npos) {
                (*at)[key] = value;
                break;
            }
            at = &(*at)[key];
            start = dot + 1;
        }
    }
    if (!problems.empty()) {
        throw input::InputError(problems);
    }
}

Json resolved(const Deck& deck) {
    input::JsonWriter writer;
    // Visitors take what they visit by reference; writing changes nothing.
    declare(static_cast<input::Visitor&>(writer), const_cast<Deck&>(deck));
    Json json = writer.take();
    json["material"]["card"] = custom_card;
    if (json.contains("regions")) {
        for (auto& region : json["regions"]) {
            region["material"]["card"] = custom_card;
        }
    }
    if (!deck.specimen.file.empty()) {
        json["specimen"] = {
            {"file", std::filesystem::absolute(std::filesystem::path(deck.folder) / deck.specimen.file).lexically_normal().string()}};
        const auto& regions = deck.regions;
        if (scatters_strength(deck.material.values) ||
            std::any_of(regions.begin(), regions.end(), [](const MaterialRegion& r) { return scatters_strength(r.material.values); })) {
            json["specimen"]["seed"] = deck.specimen.seed; // nothing else is random in a stored specimen
        }
    }
    return json;
}

Json deck_schema() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Proveta deck"}, {"oneOf", Json::array()}};
    for (const auto& name : test_names()) {
        Deck deck;
        deck.test = name;
        deck.protocol = make_protocol(name);
        deck.protocol->suggest(deck.specimen);
        deck.material.card = deck.protocol->card();
        input::Problems ignored;
        preload(Json::object(), deck.material, "", "", "", ignored);
        input::SchemaWriter writer;
        declare(static_cast<input::Visitor&>(writer), deck);
        Json one = writer.take();
        one["properties"]["test"] = {{"const", name}};
        one["required"] = {"test"};
        allow_lists(one);
        allow_grading_files(one);
        schema["oneOf"].push_back(one);
    }
    return schema;
}

} // namespace proveta
