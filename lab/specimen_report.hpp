// Of what quality the specimen is, as a part of the report.
#pragma once

#include "lab/bench.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// Share of the mass, in per cent, that is finer than a diameter in mm: of the specimen, and of what its recipe asked for if that is known.
report::Plot grading_plot(const Specimen& specimen);

/// Bars: share of the spheres, in per cent, that have so many bonds.
report::Plot coordination_plot(const Model& model);

/// Directions of the bonds against the axis z, by number, with those that no direction is preferred by as the outline.
report::Rose fabric_rose(const Model& model);

/// All of this; of loose matter the grading alone.
report::Section specimen_section(const Bench& bench);

} // namespace proveta
