// Was the loading slow enough? A verdict with its figures.
#pragma once

#include <optional>

#include "lab/rate_check.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// Judges the samples between a fifth of the peak stress (of what the loading added, if it began under stress) and the peak: forces of both
/// platens within 2 % of their mean, kinetic energy below 1 % of the elastic, unbalanced force ratio below 1 %; and, where the rate was
/// checked, the peak within 3 % of that at half the rate.
report::Badge quasi_static_verdict(const report::Table& curve, double sense, const report::Table& energy,
                                   const std::optional<RateCheck>& check = std::nullopt);

/// Lowest, mean and highest rate on the way to the peak.
std::vector<report::Scalar> rate_results(const report::Table& curve, double sense);

/// Judges the ledger: residual below 1 % of the work put in, at every sample after a hundredth of the final work.
report::Badge energy_verdict(const report::Table& energy);

/// That loose particles sank into each other so far that it falsifies the results; empty where they did not. overlap: the largest, over the
/// smaller radius.
std::string overlap_warning(double overlap);

/// What to say when sharing contact forces out over deformable bodies made or took more than a fiftieth of the energy that went through the
/// ledger, at the end; empty otherwise.
std::string coupling_warning(const report::Table& energy);

} // namespace proveta
