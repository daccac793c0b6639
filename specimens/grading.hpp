// Radii of a packing: a bounded normal distribution or a sieve curve.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/input/json.hpp"

namespace proveta {

/// A point of the grading curve in a recipe.
struct GradingPoint {
    double diameter = 0.0;
    double passing = 0.0;
};

void declare(input::Visitor& v, GradingPoint& point);

/// Whether a recipe's curve ascends from passing 0 to passing 1; if not, the first point that is wrong is told. path: of the list.
bool check_grading(const std::vector<GradingPoint>& curve, const std::string& source, const std::string& path, input::Problems& problems);

/// Wherever `json` has the name of a file under "grading", puts the points there that its table has: a column of sieve sizes with their
/// unit, and one of what passes, in per cent or as a share. Sieves that nothing passes but the widest of them, and those that all passes
/// but the narrowest, are left out. folder: where names start; source and path: the place of `json`, for problems.
void read_grading_files(input::Json& json, const std::string& folder, const std::string& source, const std::string& path,
                        input::Problems& problems);

/// Lets "grading" be the name of a file, too, wherever the schema has one.
void allow_grading_files(input::Json& schema);

/// A point of a sieve curve: the share of the mass that is finer than the diameter.
struct SievePoint {
    double diameter; ///< m
    double passing;  ///< 0 to 1
};

std::vector<SievePoint> sieve_curve(const std::vector<GradingPoint>& curve);

/// n radii in random order that follow a normal distribution cut at lowest and highest (over the mean) and scaled so that the mean is
/// 1 and the relative standard deviation is `deviation`. The radii are quantiles, one from each of n equal strata, so even small
/// samples have the right moments. Throws std::invalid_argument when the bounds leave no room for the deviation.
std::vector<double> normal_radii(std::size_t n, double deviation, double lowest, double highest, std::uint64_t seed);

/// n radii (m) in random order whose mass follows the sieve curve, linear in the diameter between its points. The curve must ascend
/// strictly in diameter from passing 0 to passing 1.
std::vector<double> graded_radii(std::size_t n, const std::vector<SievePoint>& curve, std::uint64_t seed);

} // namespace proveta
