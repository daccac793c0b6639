// A specimen: spheres in a shape, and where they came from.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "specimens/packing.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Spheres that fill a shape. Lengths in m; base on z = 0, axis z.
struct Specimen {
    Shape shape;
    Packing spheres;
    std::vector<int> group; ///< cohesive group of each sphere
    input::Json recipe;     ///< what it was made by: the recipe as resolved, or the file it came from

    [[nodiscard]] std::size_t size() const { return spheres.radius.size(); }
};

/// A point of the grading curve in a recipe.
struct GradingPoint {
    double diameter = 0.0;
    double passing = 0.0;
};

/// How a specimen is made, or which stored one is taken.
struct SpecimenRecipe {
    std::string file;
    std::string shape = "cylinder";
    double diameter = 0.150;
    double width = 0.150;
    double depth = 0.150;
    double height = 0.300;
    std::int64_t spheres = 13500;
    input::NumberOrWord porosity{0.0, "auto"};
    double radius_deviation = 0.258;
    double smallest_radius = 0.4;
    double largest_radius = 1.6;
    std::vector<GradingPoint> grading;
    double relaxation = 0.02;
    std::int64_t seed = 1;
};

void declare(input::Visitor& v, GradingPoint& point);
void declare(input::Visitor& v, SpecimenRecipe& recipe);

/// The solid that a recipe fills; not that of a stored specimen.
Shape shape_of(const SpecimenRecipe& recipe);

/// Porosity that a recipe asks for: the number, or what "auto" stands for in its shape.
double porosity_of(const SpecimenRecipe& recipe);

/// What a recipe contradicts.
void check_recipe(const SpecimenRecipe& recipe, const std::string& source, const std::string& path, input::Problems& problems);

/// Makes the specimen of a recipe. Same recipe, same specimen, whatever the number of threads. progress (0 to 1) may be empty.
Specimen make_specimen(const SpecimenRecipe& recipe, const std::function<void(double)>& progress = {});

/// Loads the recipe's file, or makes the specimen. folder: where a relative file name starts.
Specimen obtain_specimen(const SpecimenRecipe& recipe, const std::string& folder, const std::string& source,
                         const std::function<void(double)>& progress = {});

} // namespace proveta
