#include "specimens/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "specimens/grading.hpp"
#include "specimens/memory.hpp"
#include "specimens/storage.hpp"

namespace proveta {

using input::between;
using input::Unit;

namespace {

constexpr const char* of_file = "a stored specimen (.h5) to take instead of making one; of the other keys only the seed goes with it";
constexpr const char* of_seed = "number that the specimen's randomness starts from, and that of strengths where a card scatters them";

// A cylinder full of loose particles.
void declare_granular(input::Visitor& v, SpecimenRecipe& r) {
    v.number("diameter", r.diameter, Unit::length, between(1e-4, 100), "diameter of the cylinder");
    v.number("height", r.height, Unit::length, between(1e-4, 100), "height to fill; the specimen's is what the particles come to, near it");
    v.section("particles", r.particles, "the particles and how they are filled in");
}

} // namespace

void declare(input::Visitor& v, SpecimenRecipe& r) {
    v.text("file", r.file, of_file);
    v.integer("seed", r.seed, 0, INT64_MAX, of_seed);
    if (!r.file.empty() && !v.wants_all()) {
        return; // all else is settled
    }
    if (r.granular()) {
        declare_granular(v, r);
        return;
    }
    v.choice("shape", r.shape,
             {{"cylinder", "diameter and height"},
              {"disc", "a short cylinder: diameter and height"},
              {"prism", "width, depth and height"},
              {"plate", "discs in the plane y = 0, 1 m thick: width and height"}},
             "solid that the spheres fill");
    const bool prism = r.shape == "prism";
    if (v.wants_all() || (!prism && r.shape != "plate")) {
        v.number("diameter", r.diameter, Unit::length, between(1e-4, 100), "diameter of a cylinder or disc");
    }
    if (v.wants_all() || prism || r.shape == "plate") {
        v.number("width", r.width, Unit::length, between(1e-4, 100), "side of a prism or plate along x");
    }
    if (v.wants_all() || prism) {
        v.number("depth", r.depth, Unit::length, between(1e-4, 100), "side of a prism along y");
    }
    v.number("height", r.height, Unit::length, between(1e-4, 100), "height along z");
    v.integer("spheres", r.spheres, 2, 20000000, "number of spheres; with the porosity it gives the mean radius");
    v.number_or_word("porosity", r.porosity, {{"auto", "0.257; of a plate 0.10"}}, Unit::none, between(0.02, 0.9),
                     "1 - (volume of all spheres, overlaps counted twice) / (volume of the shape)");
    v.number("radius_deviation", r.radius_deviation, Unit::none, between(0, 0.5),
             "standard deviation of the radii over their mean, of a normal distribution cut at the two bounds below");
    v.number("smallest_radius", r.smallest_radius, Unit::none, {0.05, 1.0, false, false}, "lower cut, over the mean radius");
    v.number("largest_radius", r.largest_radius, Unit::none, {1.0, 10.0, false, false}, "upper cut, over the mean radius");
    v.list("grading", r.grading,
           "sieve curve instead of the normal distribution: ascending diameters from passing 0 to passing 1, or the name of a table of "
           "them; scaled to meet porosity and number of spheres");
    v.number("relaxation", r.relaxation, Unit::none, between(1e-4, 0.5),
             "net force over contact force at which the packing counts as relaxed");
}

SpecimenRecipe granular_recipe() {
    SpecimenRecipe r;
    r.matter = "granular";
    r.diameter = 0.300;
    r.height = 0.600;
    return r;
}

SpheresInSpace spheres_in_space(const Specimen& s) {
    SpheresInSpace out;
    out.spheres = s.spheres;
    for (std::size_t k = 0; k < s.spheres.radius.size(); ++k) {
        out.particle.push_back(static_cast<std::int32_t>(k));
    }
    for (std::size_t k = 0; k < s.stones.size(); ++k) {
        const Stone& stone = s.stones[k];
        const ClusterShape& form = s.forms[static_cast<std::size_t>(stone.form)];
        for (std::size_t m = 0; m < form.radius.size(); ++m) {
            out.spheres.centre.push_back(stone.position + stone.attitude * Vec3(stone.size * form.centre[m]));
            out.spheres.radius.push_back(stone.size * form.radius[m]);
            out.particle.push_back(static_cast<std::int32_t>(k));
        }
    }
    return out;
}

Shape shape_of(const SpecimenRecipe& r) {
    Shape s;
    if (!r.granular()) {
        s.kind = r.shape == "prism" ? ShapeKind::prism : (r.shape == "plate" ? ShapeKind::plate : ShapeKind::cylinder);
    }
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
        radii = graded_radii(n, sieve_curve(r.grading), seed);
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
    if (r.granular()) {
        check_bed(r.particles, shape_of(r), source, path + "/particles", problems);
        return;
    }
    if (!check_grading(r.grading, source, path + "/grading", problems)) {
        return;
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

namespace {

Specimen make_granular(const SpecimenRecipe& recipe, const std::function<void(double)>& progress) {
    Specimen s;
    s.shape = shape_of(recipe);
    Filling filling = make_bed(recipe.particles, s.shape, static_cast<std::uint64_t>(recipe.seed), progress);
    s.shape.height = filling.height;
    s.spheres = std::move(filling.spheres);
    s.group.assign(s.spheres.radius.size(), 0);
    s.forms = std::move(filling.forms);
    s.stones = std::move(filling.stones);
    s.recipe = input::write(recipe);
    const FillingReport& report = filling.report;
    s.recipe["filling"] = {{"placed", report.placed}, {"taken_away", report.taken_away}, {"steps", report.steps},
                           {"time", report.time},     {"pressure", report.pressure},     {"rms_speed", report.rms_speed},
                           {"height", filling.height}};
    return s;
}

} // namespace

Specimen make_specimen(const SpecimenRecipe& recipe, const std::function<void(double)>& progress) {
    if (recipe.granular()) {
        return make_granular(recipe, progress);
    }
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
        require_memory(recipe, source, "/specimen");
        try {
            return make_specimen(recipe, progress);
        } catch (const std::invalid_argument& e) {
            throw input::InputError(
                {{source, recipe.granular() ? "/specimen/particles" : "/specimen", e.what(), "a recipe that can be carried out", ""}});
        }
    }
    const std::filesystem::path given(recipe.file);
    const auto file = given.is_absolute() ? given : std::filesystem::path(folder) / given;
    Specimen s;
    try {
        s = load_specimen(file.string());
    } catch (const std::runtime_error& e) {
        throw input::InputError({{source, "/specimen/file", fmt::format("\"{}\": {}", recipe.file, e.what()),
                                  "a specimen stored by this program (.h5)", "make one with: proveta specimen make or import"}});
    }
    const std::size_t spheres =
        std::accumulate(s.stones.begin(), s.stones.end(), s.spheres.radius.size(),
                        [&](std::size_t n, const Stone& k) { return n + s.forms[static_cast<std::size_t>(k.form)].radius.size(); });
    require_memory(spheres, source, "/specimen/file", fmt::format("\"{}\": {} spheres", recipe.file, spheres));
    if (!recipe.granular() && !s.stones.empty()) {
        throw input::InputError({{source, "/specimen/file", fmt::format("\"{}\": {} loose stones", recipe.file, s.stones.size()),
                                  "a specimen of spheres, which this test bonds", "a test on granular matter takes stones"}});
    }
    return s;
}

} // namespace proveta
