// From what was seen of a scene to what is reported.
#pragma once

#include <string>
#include <vector>

#include "lab/scene/scene_play.hpp"
#include "lab/scene/scene_samples.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// All that was seen while a scene ran.
struct SceneSeen {
    report::Table curve, energy;
    std::vector<report::Picture> pictures;
    std::vector<BoxContent> measures;
    std::string status = "complete"; ///< or interrupted, or failed
    std::string stopped_by;
    double seconds = 0.0; ///< wall time of the steps, over all processes that took some
};

/// particles.csv: where every sphere is at the end.
report::Table particle_table(const Model& model);

/// Everything that the page shows.
report::Record scene_record(const Scene& scene, const ScenePlay& play, const SceneSeen& seen);

/// summary.json.
input::Json scene_summary(const report::Record& record, const ScenePlay& play);

} // namespace proveta
