#include "specimens/bed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace proveta {

using input::above;
using input::at_least;
using input::between;
using input::Unit;

namespace {

constexpr double fullest = 0.72;     // share of a cylinder that no particles of sensible forms exceed
constexpr double filled = 0.68;      // share that "auto" puts in: more than comes to lie there, the rest is taken away
constexpr double most = 200000.0;    // particles, beyond which a specimen would take days
constexpr double least_across = 2.0; // longest particles that must go across the cylinder, and into its height

double volume_of(double size) { return std::numbers::pi / 6.0 * size * size * size; }

// Sizes of n particles in random order, m.
std::vector<double> sizes_of(const BedRecipe& r, std::size_t n, std::uint64_t seed) {
    const bool graded = !r.size.word.empty();
    auto sizes = graded ? graded_radii(n, sieve_curve(r.grading), seed) : normal_radii(n, r.deviation, r.smallest, r.largest, seed);
    for (double& d : sizes) {
        d *= graded ? 2.0 : r.size.number;
    }
    return sizes;
}

double mean_volume(const BedRecipe& r) {
    constexpr std::size_t sample = 10000;
    double sum = 0.0;
    for (const double d : sizes_of(r, sample, 0)) {
        sum += volume_of(d);
    }
    return sum / static_cast<double>(sample);
}

double largest_size(const BedRecipe& r) {
    return r.size.word.empty() ? r.size.number * (r.deviation > 0.0 ? r.largest : 1.0) : r.grading.back().diameter;
}

// Length of a stone of size 1, from the ellipsoid that it is cut around; its corners stand out a little.
double longest_axis(const BedRecipe& r) { return r.form == "stone" ? 1.1 / std::cbrt(r.elongation * r.elongation * r.flatness) : 1.0; }

// Particles whose own volume is a share of the cylinder's.
double count_at(const BedRecipe& r, const Shape& cylinder, double share) { return share * cylinder.volume() / mean_volume(r); }

std::vector<ClusterShape> forms_of(const BedRecipe& r, std::size_t particles, std::uint64_t seed) {
    if (r.form != "stone") {
        return {};
    }
    const StoneKind kind{r.elongation, r.flatness, static_cast<int>(r.facets)};
    std::vector<ClusterShape> forms(std::min(static_cast<std::size_t>(r.forms), particles));
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < forms.size(); ++k) {
        forms[k] = form_of(stone_surface(kind, 1000 * seed + k), static_cast<int>(r.spheres));
    }
    return forms;
}

// Whether the sizes can be made at all.
bool check_sizes(const BedRecipe& r, const std::string& source, const std::string& path, input::Problems& problems) {
    if (!r.size.word.empty()) {
        if (r.grading.empty()) {
            problems.push_back({source, path + "/grading", "an empty list", "a sieve curve, or a number for size", ""});
            return false;
        }
        return check_grading(r.grading, source, path + "/grading", problems);
    }
    try {
        normal_radii(2, r.deviation, r.smallest, r.largest, 0);
    } catch (const std::invalid_argument&) {
        problems.push_back({source, path + "/deviation", fmt::format("{:.4g}", r.deviation),
                            fmt::format("a deviation that sizes between {:.3g} and {:.3g} of the mean can have", r.smallest, r.largest),
                            "widen smallest and largest"});
        return false;
    }
    return true;
}

} // namespace

std::vector<GradingPoint> railway_ballast() {
    return {{0.019, 0.0}, {0.0265, 0.02}, {0.0315, 0.06}, {0.0375, 0.28}, {0.045, 0.63}, {0.053, 1.0}};
}

void declare(input::Visitor& v, BedRecipe& r) {
    v.choice("form", r.form, {{"stone", "clusters of spheres: convex stones with plane facets, no two forms alike"}, {"sphere", "spheres"}},
             "what a particle is");
    v.number_or_word("size", r.size, {{"graded", "sizes follow the sieve curve of grading"}}, Unit::length, above(0),
                     "mean diameter of particles of similar size, of a stone that of the sphere of its volume");
    if (v.wants_all() || r.size.word.empty()) {
        v.number("deviation", r.deviation, Unit::none, between(0, 1), "relative standard deviation of the size");
        v.number("smallest", r.smallest, Unit::none, between(0.01, 1), "smallest size over the mean");
        v.number("largest", r.largest, Unit::none, between(1, 100), "largest size over the mean");
    }
    if (v.wants_all() || !r.size.word.empty()) {
        v.list("grading", r.grading,
               "sieve curve by mass: ascending diameters from passing 0 to passing 1, at first that of a railway ballast; diameters are "
               "sizes as above");
    }
    if (v.wants_all() || r.form == "stone") {
        v.number("elongation", r.elongation, Unit::none, between(0.1, 1), "intermediate over longest axis (Zingg)");
        v.number("flatness", r.flatness, Unit::none, between(0.1, 1), "shortest over intermediate axis (Zingg)");
        v.integer("facets", r.facets, 6, 200, "plane facets that a stone is cut by; the fewer, the more angular");
        v.integer("forms", r.forms, 1, 1000, "different stones, which the particles take in turn");
        v.integer("spheres", r.spheres, 1, 1000, "of a stone at most");
    }
    v.number_or_word("count", r.count,
                     {{"auto", "more than fill the cylinder; those that come to lie above its height are taken away before it is pressed"}},
                     Unit::none, at_least(1), "particles that are put in; the height is then what they reach");
    v.number("filling_friction", r.filling_friction, Unit::none, between(0, 10),
             "Coulomb friction between particles while they are filled in and pressed: low for a dense bed, high for a loose one");
    v.number("filling_modulus", r.filling_modulus, Unit::pressure, between(1e5, 1e11),
             "Young's modulus of the particles meanwhile, far below the rock's to save steps; overlaps go with the pressure over it");
    v.number("seating_pressure", r.seating_pressure, Unit::pressure, above(0),
             "pressure of the top platen, under which the bed comes to rest");
}

void check_bed(const BedRecipe& r, const Shape& cylinder, const std::string& source, const std::string& path, input::Problems& problems) {
    if (!check_sizes(r, source, path, problems)) {
        return;
    }
    const bool graded = !r.size.word.empty();
    const double room = std::min(cylinder.diameter, cylinder.height);
    const double length = largest_size(r) * longest_axis(r);
    if (length * least_across > room) {
        problems.push_back(
            {source, graded ? fmt::format("{}/grading/{}/diameter", path, r.grading.size() - 1) : path + "/size",
             fmt::format("particles up to {:.4g} m long", length),
             fmt::format("at most {:.4g} m, 1/{:.0f} of the cylinder's diameter and height", room / least_across, least_across),
             "smaller particles or a larger cylinder; tests on ballast take a diameter of some six particles"});
        return;
    }
    const double full = count_at(r, cylinder, fullest);
    if (r.count.word.empty()) {
        const double n = r.count.number;
        if (n != std::floor(n) || n > std::min(full, most)) {
            problems.push_back({source, path + "/count", fmt::format("{:.10g}", n),
                                fmt::format("a whole number up to about {:.0f}", std::floor(std::min(full, most))),
                                n > full ? "more would not go into the cylinder" : ""});
        }
    } else if (full > most) {
        problems.push_back({source, path + (graded ? "/grading" : "/size"),
                            fmt::format("particles of which {:.3g} fill the cylinder", full), fmt::format("at most {:.0f}", most),
                            "larger particles, or a smaller cylinder"});
    }
    if (r.seating_pressure > 0.005 * r.filling_modulus) {
        problems.push_back({source, path + "/seating_pressure", fmt::format("{:.4g} Pa", r.seating_pressure),
                            fmt::format("at most 1/200 of filling_modulus: {:.4g} Pa", 0.005 * r.filling_modulus),
                            "a higher filling_modulus, at the cost of more steps"});
    }
}

double particles_of(const BedRecipe& r, const Shape& cylinder) {
    return r.count.word.empty() ? r.count.number : std::ceil(count_at(r, cylinder, filled));
}

Filling make_bed(const BedRecipe& r, const Shape& cylinder, std::uint64_t seed, const std::function<void(double)>& progress) {
    FillingPlan plan;
    plan.diameter = cylinder.diameter;
    plan.height = cylinder.height;
    plan.friction = r.filling_friction;
    plan.modulus = r.filling_modulus;
    plan.pressure = r.seating_pressure;
    plan.level = !r.count.word.empty();
    const auto n = static_cast<std::size_t>(particles_of(r, cylinder));
    plan.forms = forms_of(r, n, seed);
    const std::vector<double> sizes = sizes_of(r, n, seed);
    for (std::size_t k = 0; k < n; ++k) {
        plan.grains.push_back({sizes[k], plan.forms.empty() ? -1 : static_cast<int>(k % plan.forms.size())});
    }
    return fill(plan, seed, progress);
}

} // namespace proveta
