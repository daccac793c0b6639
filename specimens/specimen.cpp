#include "specimens/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "specimens/grading.hpp"
#include "specimens/storage.hpp"

namespace proveta {

using input::above;
using input::between;
using input::Unit;

void declare(input::Visitor& v, GradingPoint& p) {
    v.number("diameter", p.diameter, Unit::length, above(0), "sieve opening");
    v.number("passing", p.passing, Unit::none, between(0, 1), "share of the mass that is finer");
}

void declare(input::Visitor& v, SpecimenRecipe& r) {
    v.text("file", r.file, "a stored specimen (.h5) to take instead of making one; the other keys are then not used");
    v.choice("shape", r.shape,
             {{"cylinder", "diameter and height"},
              {"disc", "a short cylinder: diameter and height"},
              {"prism", "width, depth and height"},
              {"plate", "discs in the plane y = 0, 1 m thick: width and height"}},
             "solid that the spheres fill");
    v.number("diameter", r.diameter, Unit::length, between(1e-4, 100), "diameter of a cylinder");
    v.number("width", r.width, Unit::length, between(1e-4, 100), "side of a prism or plate along x");
    v.number("depth", r.depth, Unit::length, between(1e-4, 100), "side of a prism along y");
    v.number("height", r.height, Unit::length, between(1e-4, 100), "height along z");
    v.integer("spheres", r.spheres, 2, 20000000, "number of spheres; with the porosity it gives the mean radius");
    v.number_or_word("porosity", r.porosity, {{"auto", "0.257; of a plate 0.10"}}, Unit::none, between(0.02, 0.9),
                     "1 - (volume of all spheres, overlaps counted twice) / (volume of the shape)");
    v.number("radius_deviation", r.radius_deviation, Unit::none, between(0, 0.5),
             "standard deviation of the radii over their mean, of a normal distribution cut at the two bounds below");
    v.number("smallest_radius", r.smallest_radius, Unit::none, {0.05, 1.0, false, false}, "lower cut, over the mean radius");
    v.number("largest_radius", r.largest_radius, Unit::none, {1.0, 10.0, false, false}, "upper cut, over the mean radius");
    v.list("grading", r.grading,
           "sieve curve instead of the normal distribution: ascending diameters from passing 0 to passing 1; scaled to meet porosity and "
           "number of spheres");
    v.number("relaxation", r.relaxation, Unit::none, between(1e-4, 0.5),
             "net force over contact force at which the packing counts as relaxed");
    v.integer("seed", r.seed, 0, INT64_MAX, "number that the packing's randomness starts from");
}

Shape shape_of(const SpecimenRecipe& r) {
    Shape s;
    s.kind = r.shape == "prism" ? ShapeKind::prism : (r.shape == "plate" ? ShapeKind::plate : ShapeKind::cylinder);
    s.diameter = r.diameter;
    s.width = r.width;
    s.depth = r.depth;
    s.height = r.height;
    return s;
}

namespace {

// Radii in m that fill the shape to the wished porosity.
std::vector<double> radii_of(const SpecimenRecipe& r) {
    const auto n = static_cast<std::size_t>(r.spheres);
    const auto seed = static_cast<std::uint64_t>(r.seed);
    std::vector<double> radii;
    if (r.grading.empty()) {
        radii = normal_radii(n, r.radius_deviation, r.smallest_radius, r.largest_radius, seed);
    } else {
        std::vector<SievePoint> curve;
        for (const auto& p : r.grading) {
            curve.push_back({p.diameter, p.passing});
        }
        radii = graded_radii(n, curve, seed);
    }
    const bool planar = shape_of(r).planar();
    double volume = 0.0;
    for (const double x : radii) {
        volume += planar ? std::numbers::pi * x * x : 4.0 / 3.0 * std::numbers::pi * x * x * x;
    }
    const double wanted = (1.0 - porosity_of(r)) * shape_of(r).volume() / volume;
    const double scale = planar ? std::sqrt(wanted) : std::cbrt(wanted);
    for (double& x : radii) {
        x *= scale;
    }
    return radii;
}

} // namespace

double porosity_of(const SpecimenRecipe& r) {
    if (r.porosity.word.empty()) {
        return r.porosity.number;
    }
    return r.shape == "plate" ? 0.10 : 0.257; // near the thesis's meshes 2D-1 to 2D-4 and 3D-2 (table 5.3)
}

void check_recipe(const SpecimenRecipe& r, const std::string& source, const std::string& path, input::Problems& problems) {
    if (!r.file.empty()) {
        return;
    }
    for (std::size_t k = 0; k < r.grading.size(); ++k) {
        const bool first = k == 0;
        const bool last = k + 1 == r.grading.size();
        const auto& p = r.grading[k];
        const bool ascends = first || (p.diameter > r.grading[k - 1].diameter && p.passing > r.grading[k - 1].passing);
        if (!ascends || (first && p.passing != 0.0) || (last && p.passing != 1.0) || r.grading.size() < 2) {
            problems.push_back({source, fmt::format("{}/grading/{}", path, k),
                                fmt::format("passing {:.4g} at {:.4g} m", p.passing, p.diameter),
                                "at least two points, ascending, from passing 0 to passing 1", ""});
            return;
        }
    }
    // A cheap look at the largest sphere before making any: n copies of the mean would do, but the bounds decide.
    const double volume = shape_of(r).volume() * (1.0 - porosity_of(r)) / static_cast<double>(r.spheres);
    const double typical = shape_of(r).planar() ? std::sqrt(volume / std::numbers::pi) : std::cbrt(0.75 * volume / std::numbers::pi);
    const double room = 0.5 * std::min(shape_of(r).lateral_size(), r.height);
    if (typical * (r.grading.empty() ? r.largest_radius : 1.0) >= room) {
        problems.push_back({source, path + "/spheres", fmt::format("{} spheres, of about {:.3g} m radius", r.spheres, typical),
                            fmt::format("spheres that fit into half of {:.3g} m", 2.0 * room), "ask for more spheres"});
        return;
    }
    try {
        if (r.grading.empty()) {
            normal_radii(2, r.radius_deviation, r.smallest_radius, r.largest_radius, 0);
        }
    } catch (const std::invalid_argument&) {
        problems.push_back(
            {source, path + "/radius_deviation", fmt::format("{:.4g}", r.radius_deviation),
             fmt::format("a deviation that radii between {:.3g} and {:.3g} of the mean can have", r.smallest_radius, r.largest_radius),
             "widen smallest_radius and largest_radius"});
    }
}

Specimen make_specimen(const SpecimenRecipe& recipe, const std::function<void(double)>& progress) {
    Specimen s;
    s.shape = shape_of(recipe);
    Relaxation relaxation;
    s.spheres = pack(s.shape, radii_of(recipe), static_cast<std::uint64_t>(recipe.seed), recipe.relaxation, relaxation, progress);
    s.group.assign(s.size(), 0);
    s.recipe = input::write(recipe);
    s.recipe["relaxation_reached"] = relaxation.residual;
    s.recipe["relaxation_iterations"] = relaxation.iterations;
    return s;
}

Specimen obtain_specimen(const SpecimenRecipe& recipe, const std::string& folder, const std::string& source,
                         const std::function<void(double)>& progress) {
    if (recipe.file.empty()) {
        return make_specimen(recipe, progress);
    }
    const std::filesystem::path given(recipe.file);
    const auto file = given.is_absolute() ? given : std::filesystem::path(folder) / given;
    try {
        return load_specimen(file.string());
    } catch (const std::runtime_error& e) {
        throw input::InputError({{source, "/specimen/file", fmt::format("\"{}\": {}", recipe.file, e.what()),
                                  "a specimen stored by this program (.h5)", "make one with: proveta specimen make or import"}});
    }
}

} // namespace proveta
