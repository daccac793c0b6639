// A scene played from its start, or from where it was kept, to its end, and what is seen of it.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/clock.hpp"
#include "lab/keeper.hpp"
#include "lab/output_folder.hpp"
#include "lab/progress.hpp"
#include "lab/scene/scene_play.hpp"
#include "lab/scene/scene_report.hpp"

namespace proveta {

/// Plays a scene; writes its fields and its checkpoints.
class Performance {
  public:
    /// play: as it was set up. watch_only: no step is taken but the one that measures the end.
    Performance(const Scene& scene, ScenePlay& play, const OutputFolder& out, Progress& progress, Keeper& keeper, bool watch_only);

    /// Takes over the state that the keeper has: what is played from there ends the same to the bit as if it had never been stopped.
    /// Throws InputError when the keeper's files cannot be read.
    void restore();
    /// Once. Throws FileError.
    SceneSeen go();

  private:
    bool play_on();
    void picture(const std::string& when);
    void look();
    void write_fields();
    void visit_state(StateVisitor& visit);
    [[nodiscard]] double seconds() const { return before_ + since(begin_); }

    const Scene& scene_;
    ScenePlay& play_;
    const OutputFolder& out_;
    Progress& progress_;
    Keeper& keeper_;
    bool watch_only_;
    SceneSeen seen_;
    Clock::time_point begin_ = Clock::now();
    double before_ = 0.0;        // seconds of playing in earlier processes
    Eigen::AlignedBox3d stage_;  // that pictures show
    std::int64_t samples_ = 0;   // so far
    std::vector<double> fields_; // times of the files so far, s
};

} // namespace proveta
