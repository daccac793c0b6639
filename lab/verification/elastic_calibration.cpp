// What goes in comes out: E and nu of the card against those that an explicit test shows.
#include <fmt/format.h>

#include "lab/verification/cases.hpp"
#include "lab/verification/elastic_run.hpp"

namespace proveta::verification {

namespace elastic_calibration_case {

// A specimen and what its card asks for.
struct Wish {
    const char* name;
    input::Json specimen;
    double young, poisson;
};

// radius_deviation: relative, of the grading.
input::Json cylinder(int spheres, int seed, double radius_deviation) {
    return {
        {"spheres", spheres}, {"seed", seed}, {"radius_deviation", radius_deviation}, {"smallest_radius", 0.25}, {"largest_radius", 2.0}};
}

std::vector<Wish> wishes(bool full) {
    const input::Json prism = {{"shape", "prism"},   {"width", "100 mm"}, {"depth", "100 mm"},
                               {"height", "200 mm"}, {"spheres", 4000},   {"seed", 5}};
    if (!full) {
        return {{"2,000 spheres, grading 26 %", cylinder(2000, 1, 0.2583), 28e9, 0.2},
                {"2,000 spheres, grading 10 %", cylinder(2000, 2, 0.1), 10e9, 0.05},
                {"2,000 spheres, averaged part", cylinder(2000, 3, 0.2583), 28e9, 0.35}};
    }
    return {{"13,500 spheres, seed 1", cylinder(13500, 1, 0.2583), 28e9, 0.2},
            {"13,500 spheres, seed 2", cylinder(13500, 2, 0.2583), 28e9, 0.05},
            {"13,500 spheres, grading 10 %", cylinder(13500, 3, 0.1), 28e9, 0.15},
            {"13,500 spheres, grading 35 %", cylinder(13500, 4, 0.35), 28e9, 0.1},
            {"8,000 spheres", cylinder(8000, 5, 0.2583), 60e9, 0.2},
            {"5,000 spheres, grading 10 %", cylinder(5000, 6, 0.1), 28e9, 0.2},
            {"5,000 spheres, grading 35 %", cylinder(5000, 7, 0.35), 5e9, 0.1},
            {"3,000 spheres", cylinder(3000, 8, 0.2583), 28e9, 0.05},
            {"2,000 spheres", cylinder(2000, 9, 0.2583), 28e9, 0.15},
            {"4,000 spheres, prism", prism, 28e9, 0.2},
            {"13,500 spheres, averaged part", cylinder(13500, 10, 0.2583), 28e9, 0.35},
            {"5,000 spheres, averaged part", cylinder(5000, 11, 0.2583), 28e9, 0.45},
            {"13,500 spheres, averaged part", cylinder(13500, 12, 0.1), 28e9, 0.45}};
}

Case calibration(const char* name, const char* about, bool full) {
    return {name, "5.4.2-3", about, full, [full] {
                Outcome out;
                for (const auto& wish : wishes(full)) {
                    const ElasticRun run("ucs", wish.specimen, {{"stop", {{"axial_strain", 0.0003}, {"post_peak_drop", 1}}}},
                                         {{"young_modulus", wish.young}, {"poisson_ratio", wish.poisson}});
                    out.checks.push_back({fmt::format("{}: E", wish.name), wish.young, run.young_modulus(), 0.01, Compare::relative, "Pa"});
                    // Within 0.01; of ratios that the averaged part makes, 3 %.
                    out.checks.push_back({fmt::format("{}: nu", wish.name), wish.poisson, run.poisson_ratio(),
                                          wish.poisson > 0.3 ? 0.03 * wish.poisson : 0.01, Compare::absolute, ""});
                    out.checks.push_back(
                        {fmt::format("{}: ledger's residual", wish.name), 0.001, run.ledger_residual(), 0.0, Compare::at_most, ""});
                }
                out.notes.emplace_back("E and nu by the gauges of an explicit uniaxial test between platens with friction 0.3, bonds "
                                       "unbreakable; the calibration solves a linear system between platens without friction.");
                return out;
            }};
}

} // namespace elastic_calibration_case

Case elastic_calibration() {
    using namespace elastic_calibration_case;
    return calibration("elastic-calibration",
                       "Young's modulus and Poisson's ratio of the card come out of an explicit test: specimens of different seeds, sizes, "
                       "gradings and shapes, ratios beyond the bonds' reach by the averaged stress.",
                       true);
}

Case elastic_calibration_small() {
    using namespace elastic_calibration_case;
    return calibration("elastic-calibration-small", "The same on three small specimens, for every commit.", false);
}

} // namespace proveta::verification
