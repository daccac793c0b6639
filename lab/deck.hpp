// The deck: a test as its user describes it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "core/model.hpp"
#include "lab/protocols/protocol.hpp"
#include "materials/card.hpp"
#include "specimens/specimen.hpp"

namespace proveta {

/// A box of the specimen with a material, and perhaps a cohesive group, of its own.
struct MaterialRegion {
    std::vector<double> from{0.0, 0.0, 0.0}; ///< corner, m
    std::vector<double> to{0.0, 0.0, 0.0};   ///< opposite corner, m
    std::int64_t group = 0;
    MaterialInput material;
};

struct BondingInput {
    std::string nearest = "relative";
    input::NumberOrWord interaction_range{0.0, "auto"};
    input::NumberOrWord coordination{0.0, "auto"};
};

struct NumericsInput {
    input::NumberOrWord time_step{0.0, "auto"};
    double safety = 0.9;
    std::string scheme = "velocity_verlet";
    std::string damping = "nonviscous";
    double damping_translation = 0.2;
    double damping_rotation = 0.2;
    double skin = 0.1;
    double mass_scaling = 0.02;
};

struct OutputInput {
    std::int64_t samples = 400;
    std::int64_t fields = 10;
    std::int64_t pictures = 1000;
    double checkpoint_every = 30.0;
};

void declare(input::Visitor& v, MaterialRegion& region);
void declare(input::Visitor& v, BondingInput& bonding);
void declare(input::Visitor& v, NumericsInput& numerics);
void declare(input::Visitor& v, OutputInput& output);

/// Mean coordination that bonding asks for: the number, or what "auto" stands for in the specimen's shape.
double coordination_of(const BondingInput& bonding, const Shape& shape);

/// A deck as read, every default filled in.
struct Deck {
    std::string test = "ucs";
    std::string title;
    SpecimenRecipe specimen;
    BondingInput bonding;
    MaterialInput material;
    std::vector<MaterialRegion> regions;
    std::unique_ptr<Protocol> protocol; ///< holds the "loading" section
    NumericsInput numerics;
    OutputInput output;

    std::string source;            ///< the deck's file
    std::string folder;            ///< where its relative file names start
    std::string expected_specimen; ///< hash of the specimen that a manifest was written for, or empty
};

void declare(input::Visitor& v, Deck& deck);

/// Reads a deck. Throws InputError with every problem. json has been loaded from `file`.
Deck read_deck(const input::Json& json, const std::string& file);

/// Applies "a.b=v" settings of the command line to a deck's JSON: v is JSON if it parses, else text. Throws InputError.
void apply_settings(input::Json& json, const std::vector<std::string>& settings);

/// The deck with every value filled in, SI units, independent of files but for a stored specimen; reading it gives the same run.
input::Json resolved(const Deck& deck);

/// JSON schema of decks and series of one deck: one alternative a test.
input::Json deck_schema();

} // namespace proveta
