// Beds: cylinders full of loose particles, dense and at rest, for tests on ballast and other granular matter.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/input/declare.hpp"
#include "core/input/json.hpp"
#include "specimens/filling.hpp"
#include "specimens/grading.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Railway ballast between 19 and 53 mm. Some 900 stones fill 300 mm x 600 mm; as everywhere here a stone's size is the diameter of the
/// sphere of its volume, not the sieve that it passes.
std::vector<GradingPoint> railway_ballast();

/// What the particles of a bed are and how they are filled in.
struct BedRecipe {
    std::string form = "stone";
    input::NumberOrWord size{0.0, "graded"};
    double deviation = 0.0;
    double smallest = 0.5;
    double largest = 1.5;
    std::vector<GradingPoint> grading = railway_ballast();
    double elongation = 0.75;
    double flatness = 0.75;
    std::int64_t facets = 14;
    std::int64_t forms = 20;
    std::int64_t spheres = 12;
    input::NumberOrWord count{0.0, "auto"};
    double filling_friction = 0.1;
    double filling_modulus = 100e6;
    double seating_pressure = 10e3;
};

void declare(input::Visitor& v, BedRecipe& recipe);

/// What a recipe contradicts for a cylinder. path: of the recipe.
void check_bed(const BedRecipe& recipe, const Shape& cylinder, const std::string& source, const std::string& path,
               input::Problems& problems);

/// Number of particles that are put in.
double particles_of(const BedRecipe& recipe, const Shape& cylinder);

/// Fills a cylinder. Same recipe and seed, same bed, bit for bit, whatever the number of threads. progress (0 to 1) may be empty. Throws
/// std::invalid_argument for particles that do not fit in, NumericalFailure when they come to no rest.
Filling make_bed(const BedRecipe& recipe, const Shape& cylinder, std::uint64_t seed, const std::function<void(double)>& progress = {});

} // namespace proveta
