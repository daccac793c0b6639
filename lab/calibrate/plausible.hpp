// What results and measured curves can be, so that units, signs and columns that were mistaken show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/calibrate/input.hpp"
#include "lab/series/mean_curve.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// What a quantity of a solid or of ballast can be, without its sign; beyond it, a unit is likely to be missing.
struct Plausible {
    double low, high;
    std::vector<double> factors; ///< that make it so, the likeliest first

    [[nodiscard]] bool holds(double size) const { return size >= low && size <= high; }
    /// The first factor that makes a size one that can be; none does: nothing.
    [[nodiscard]] std::optional<double> factor_for(double size) const;
};

/// Of a result of a test ("ucs"): strains, Poisson's ratio, moduli and other stresses; none of others.
std::optional<Plausible> plausible_result(const report::Scalar& result, const std::string& test);

/// Throws std::runtime_error for a curve of a test ("ucs") that none of a material can be, in sign, size, order of its columns or modulus,
/// with the factor that would make it one. Returns a doubt, or nothing: a modulus far from `young`, E of the deck's card in Pa; 0: unknown.
std::string check_plausible(const SampledCurve& curve, const TargetInput& target, const std::string& test, double young);

/// A quantity as people write it, "axial strain".
std::string plain(const std::string& quantity);

/// Whether a quantity is a stress.
bool is_stress(const std::string& quantity);

} // namespace proveta
