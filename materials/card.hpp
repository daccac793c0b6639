// Material cards: the parameter sets of the laboratory, as JSON files with their provenance.
#pragma once

#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "core/input/quantities.hpp"
#include "core/laws/material.hpp"

namespace proveta {

/// A parameter set with its paper. Keys and meanings: `declare` below.
struct Card {
    std::string name = "unnamed";
    std::string about;
    std::string source;
    std::string status = "user";
    std::string law = Dempack::name; ///< its parameters are `bond`
    std::string criterion = "bond";
    std::string area_rule = "virtual_polyhedron";
    input::NumberOrWord area_factor{1.0, ""};
    double density = 2500.0;
    std::string elasticity = "calibrated";
    double young_modulus = 28.0e9;
    double poisson_ratio = 0.2;
    double normal_factor = 1.0;
    double shear_factor = 1.0;
    double averaged_factor = 0.0;
    double strength_factor = 1.0;
    BondParameters bond = Dempack::Parameters{}; ///< of the law
    double mu_d = 0.25;
    double bending_factor = 0.0;
    double twisting_factor = 0.0;
    double local_damping = 0.0;
    double contact_restitution = 0.2;
    std::string restitution_rule = "corrected";
    std::string contact_law = "linear";
    double rolling_friction = 0.0;
};

void declare(input::Visitor& v, Card& card);

/// What a card may call itself.
std::vector<input::Choice> card_statuses();

/// The numbers of a card as the physics wants them; strength_factor multiplies the law's strengths. An area_factor "auto" is left at
/// 1: only a specimen tells it.
Material to_material(const Card& card);

/// Card name that stands for no card: the numbers of table 5.5, to be overridden.
constexpr const char* custom_card = "custom";

/// Names of the cards that come with the program.
std::vector<std::string> card_names();

/// Reads a card: one of the program's by name, or a JSON file (relative to `folder`). A card file may name one of
/// the program's in "card" and change parts of it. Throws InputError. `path` is where the deck names it, for messages.
Card load_card(const std::string& name_or_file, const std::string& folder, const std::string& deck, const std::string& path);

/// The "material" object of a deck: a card by name or file, and whatever it overrides.
struct MaterialInput {
    std::string card = "concrete_sfer";
    Card values;
};

void declare(input::Visitor& v, MaterialInput& material);

/// Puts the numbers of the card that a "material" object names (default: `material.card`) into `material`, before its other keys are read.
/// folder: where relative file names start; source and path: the object's place, for messages.
void preload(const input::Json& json, MaterialInput& material, const std::string& folder, const std::string& source,
             const std::string& path, input::Problems& problems);

/// Stresses of the card's law above 0 as its strength_factor leaves them, Pa.
std::vector<input::DeclaredQuantity> strengths_of(const Card& card);

/// Whether the strengths of its bonds are random.
bool scatters_strength(const Card& card);

/// What a card's numbers contradict, each as a problem.
void check_card(const Card& card, const std::string& source, const std::string& path, input::Problems& problems);

} // namespace proveta
