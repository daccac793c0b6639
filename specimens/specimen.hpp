// A specimen: spheres or stones in a shape, and where they came from.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/input/json.hpp"
#include "specimens/bed.hpp"
#include "specimens/grading.hpp"
#include "specimens/packing.hpp"
#include "specimens/shape.hpp"
#include "specimens/stones.hpp"

namespace proveta {

/// Spheres or stones that fill a shape. Lengths in m; base on z = 0, axis z.
struct Specimen {
    Shape shape;
    Packing spheres;                 ///< none where there are stones
    std::vector<int> group;          ///< cohesive group of each sphere
    std::vector<ClusterShape> forms; ///< of size 1, that the stones have
    std::vector<Stone> stones;
    input::Json recipe; ///< what it was made by: the recipe as resolved, or the file it came from

    /// Number of stones, or of spheres.
    [[nodiscard]] std::size_t size() const { return stones.empty() ? spheres.radius.size() : stones.size(); }
};

/// All spheres of a specimen, those of its stones too, in space.
struct SpheresInSpace {
    Packing spheres;
    std::vector<std::int32_t> particle; ///< stone that each belongs to, or its own number
};
SpheresInSpace spheres_in_space(const Specimen& specimen);

/// How a specimen is made, or which stored one is taken.
struct SpecimenRecipe {
    std::string matter = "bonded"; ///< "bonded" or "granular": no key, the test says it, and it decides which keys there are
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
    BedRecipe particles; ///< of granular matter

    [[nodiscard]] bool granular() const { return matter == "granular"; }
    std::int64_t seed = 1;
};

void declare(input::Visitor& v, SpecimenRecipe& recipe);

/// The recipe that tests on granular matter begin with: railway ballast, 300 mm x 600 mm.
SpecimenRecipe granular_recipe();

/// The solid that a recipe fills; not that of a stored specimen.
Shape shape_of(const SpecimenRecipe& recipe);

/// Porosity that a recipe asks for: the number, or what "auto" stands for in its shape.
double porosity_of(const SpecimenRecipe& recipe);

/// What a recipe contradicts.
void check_recipe(const SpecimenRecipe& recipe, const std::string& source, const std::string& path, input::Problems& problems);

/// Makes the specimen of a recipe. Same recipe, same specimen, whatever the number of threads. progress (0 to 1) may be empty.
Specimen make_specimen(const SpecimenRecipe& recipe, const std::function<void(double)>& progress = {});

/// Loads the recipe's file, or makes the specimen. Throws InputError when that fails, when its test needs more memory than there is, or
/// when the file has stones where the test bonds spheres. folder: where a relative file name starts.
Specimen obtain_specimen(const SpecimenRecipe& recipe, const std::string& folder, const std::string& source,
                         const std::function<void(double)>& progress = {});

} // namespace proveta
