// proveta describe, proveta schema
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/input/describe.hpp"
#include "core/input/suggest.hpp"
#include "lab/calibrate/input.hpp"
#include "lab/cli/commands.hpp"
#include "lab/deck.hpp"
#include "lab/protocols/registry.hpp"
#include "lab/scene/scene.hpp"
#include "lab/sweep/sweep.hpp"

namespace proveta {

namespace {

std::vector<input::ParameterInfo> parameters_of(const std::string& test) {
    Deck deck;
    deck.test = test;
    deck.protocol = make_protocol(test);
    deck.material.values = load_card(deck.material.card, "", "", "");
    input::Describer describer;
    declare(static_cast<input::Visitor&>(describer), deck);
    return describer.parameters();
}

// All keys of a scene but those of materials, which are a deck's.
std::vector<input::ParameterInfo> parameters_of_scene() {
    Scene scene;
    scene.materials.resize(1);
    input::Describer describer;
    declare(describer, scene);
    auto parameters = describer.parameters();
    std::erase_if(parameters, [](const auto& p) { return p.path.find(".material.") != std::string::npos; });
    return parameters;
}

void keep_prefix(std::vector<input::ParameterInfo>& parameters, const std::string& prefix) {
    std::erase_if(parameters, [&](const auto& p) { return p.path != prefix && !p.path.starts_with(prefix + "."); });
}

std::string about_test(const std::string& name, bool markdown) {
    const auto info = make_protocol(name)->about();
    std::string out = fmt::format("{}{}: {}\n\n{}\n\n", markdown ? "## Test " : "", info.name, info.title, info.about);
    for (const auto& s : info.standards) {
        out += markdown ? fmt::format("* **{}**: {}. Not mimicked: {}.\n", s.name, s.mimics, s.cannot)
                        : fmt::format("{}\n    mimicked: {}\n    not mimicked: {}\n", s.name, s.mimics, s.cannot);
    }
    auto parameters = parameters_of(name);
    keep_prefix(parameters, "loading");
    return out + "\n" + (markdown ? input::as_markdown(parameters) : input::as_text(parameters));
}

std::string about_card(const std::string& name) {
    Card card = load_card(name, "", "", "");
    input::Describer describer;
    declare(describer, card);
    return input::as_text(describer.parameters());
}

// The whole reference as Markdown; docs/reference.md is this text.
std::string reference() {
    std::string out = "# Reference\n\nWritten by `proveta describe --markdown` from the program's own declarations; do not edit.\n\n"
                      "Numbers are SI; a text may carry a unit: \"28 GPa\", \"150 mm\", \"0.02 m/s\", \"25 %\".\n\n";
    for (const auto& name : test_names()) {
        out += about_test(name, true) + "\n";
    }
    out += "## All keys of a deck\n\n";
    auto parameters = parameters_of(test_names().front());
    std::erase_if(parameters, [](const auto& p) { return p.path.starts_with("loading."); });
    out += input::as_markdown(parameters) +
           "\n## All keys of a scene\n\nKeys of a surface go with its `shape`, those of a motion with its `kind`, "
           "those of particles with their `form` and `place`. A material has the keys of a deck's.\n\n";
    out += input::as_markdown(parameters_of_scene()) + "\n## Material cards\n\n| card | about | source | status |\n|---|---|---|---|\n";
    for (const auto& name : card_names()) {
        const Card card = load_card(name, "", "", "");
        out += fmt::format("| `{}` | {} | {} | {} |\n", name, card.about, card.source, card.status);
    }
    return out;
}

std::string overview() {
    std::string out = "tests\n";
    for (const auto& t : test_choices()) {
        out += fmt::format("    {:<26} {}\n", t.name, t.meaning);
    }
    out += "\nmaterial cards\n";
    for (const auto& name : card_names()) {
        const Card card = load_card(name, "", "", "");
        out += fmt::format("    {:<26} {} ({})\n", name, card.about, card.status);
    }
    out += "\nsections of a deck\n";
    for (const auto& p : parameters_of(test_names().front())) {
        if (p.section && p.path.find('.') == std::string::npos) {
            out += fmt::format("    {:<26} {}\n", p.path, p.meaning);
        }
    }
    out += "\nscene                          particles that fall, pour and flow among surfaces: `proveta describe scene`\n";
    return out + "\nproveta describe NAME tells more of any of them, or of a key such as loading.rate\n";
}

int describe(const std::string& name) {
    const auto tests = test_names();
    const auto cards = card_names();
    if (name.empty()) {
        fmt::print("{}", overview());
        return 0;
    }
    if (std::find(tests.begin(), tests.end(), name) != tests.end()) {
        fmt::print("{}", about_test(name, false));
        return 0;
    }
    if (std::find(cards.begin(), cards.end(), name) != cards.end()) {
        fmt::print("{}", about_card(name));
        return 0;
    }
    if (name == "scene") {
        fmt::print("{}", input::as_text(parameters_of_scene()));
        return 0;
    }
    std::vector<std::string> known = tests;
    known.emplace_back("scene");
    known.insert(known.end(), cards.begin(), cards.end());
    for (const auto& test : tests) {
        auto parameters = parameters_of(test);
        std::vector<input::ParameterInfo> found = parameters;
        keep_prefix(found, name);
        if (found.empty()) { // the last part of a path is enough
            std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(found),
                         [&](const auto& p) { return p.path.ends_with("." + name); });
        }
        if (!found.empty()) {
            fmt::print("{}", input::as_text(found));
            return 0;
        }
        for (const auto& p : parameters) {
            known.push_back(p.path);
            known.push_back(p.path.substr(p.path.rfind('.') + 1));
        }
    }
    const std::string best = input::nearest(name, known);
    throw input::InputError({{"describe", "", "\"" + name + "\"", "a test, a material card, a section or a key of a deck",
                              best.empty() ? "" : fmt::format("did you mean \"{}\"?", best)}});
}

} // namespace

void add_describe(CLI::App& app, Command& chosen) {
    struct DescribeArguments {
        std::string name;
        bool markdown = false;
    };
    auto a = std::make_shared<DescribeArguments>();
    auto* command = app.add_subcommand("describe", "what a test, a material, a section or a key is: meaning, unit, default, bounds");
    command->add_option("name", a->name, "its name; without one, a list");
    command->add_flag("--markdown", a->markdown, "the whole reference as Markdown");
    command->callback([a, &chosen] {
        chosen = [a] {
            if (a->markdown) {
                fmt::print("{}", reference());
                return 0;
            }
            return describe(a->name);
        };
    });
}

void add_schema(CLI::App& app, Command& chosen) {
    auto kind = std::make_shared<std::string>("deck");
    auto* command = app.add_subcommand("schema", "JSON schema (draft 2020-12) of decks, scenes, material cards, sweeps or calibrations");
    command->add_option("kind", *kind, "deck, scene, card, sweep or calibration")
        ->check(CLI::IsMember({"deck", "scene", "card", "sweep", "calibration"}));
    command->callback([kind, &chosen] {
        chosen = [kind] {
            input::Json schema;
            if (*kind == "deck") {
                schema = deck_schema();
            } else if (*kind == "scene") {
                schema = scene_schema();
            } else if (*kind == "calibration") {
                schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Proveta calibration"}};
                schema.update(calibration_schema());
            } else if (*kind == "sweep") {
                schema = sweep_schema();
            } else {
                schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Proveta material card"}};
                MaterialInput material;
                material.card = custom_card;
                schema.update(input::schema(material));
                schema["properties"]["evidence"] = {{"description", "what a calibration says of the card's making; changes nothing"},
                                                    {"type", "object"}};
            }
            fmt::print("{}\n", schema.dump(2));
            return 0;
        };
    });
}

} // namespace proveta
