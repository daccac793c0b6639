// Cracks and fragments as a part of the report.
#pragma once

#include <vector>

#include "lab/bench.hpp"
#include "lab/failure_event.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// A bond as a piece of a crack that is there or may come.
struct CrackFacet {
    Vec3 normal; ///< along the bond at the start, of length 1
    double area; ///< m2
    FailureMode mode;
};

/// All bonds of the specimen, failed or not.
std::vector<CrackFacet> crack_facets(const Model& model);

/// Failures by strain: bars of their number in tension and in shear. scale: from strain to per cent in the sense of the test.
report::Plot failure_histogram(const std::vector<FailureEvent>& events, double scale);

/// Angle between cracks and the loading axis, 0 to 90 degrees, by area. The outline is that of all bonds.
report::Rose crack_dips(const std::vector<CrackFacet>& facets, const Vec3& axis);

/// Strike of the cracks about the loading axis, 0 to 180 degrees from `across`, by their area as seen along the axis's plane.
report::Rose crack_strikes(const std::vector<CrackFacet>& facets, const Vec3& axis, const Vec3& across);

/// What bonds still hold together: number of pieces, their masses, the largest ones.
report::TextTable fragment_table(const Model& model);

/// All of this for a test on bonded matter.
report::Section crack_section(const Bench& bench, const std::vector<FailureEvent>& events);

} // namespace proveta
