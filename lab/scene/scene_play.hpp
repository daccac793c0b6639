// A scene at work: its model, its surfaces' motions, its feed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "lab/scene/feed.hpp"
#include "lab/scene/scene.hpp"

namespace proveta {

/// A scene set up, stepped through time.
class ScenePlay {
  public:
    /// Makes surfaces, forms and the first particles. Throws InputError, UnstableStep.
    explicit ScenePlay(const Scene& scene);

    /// One step: particles come and go, surfaces are driven, the model steps.
    void step(bool measure);
    /// Whether it has come to its end; empty: not yet. Looks at the particles: to be asked at samples.
    [[nodiscard]] std::string over() const;

    /// Names all that steps to come depend on besides the scene and its files.
    void visit_state(StateVisitor& visit);
    /// Rebuilds what follows from that, once it has been restored.
    void restored() { model_->restored(); }

    [[nodiscard]] const Model& model() const { return *model_; }
    [[nodiscard]] const Feed& feed() const { return feed_; }
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; } ///< on values and on surfaces from files

  private:
    void choose_skin();
    void refuse_fast() const;

    const Scene& scene_;
    Feed feed_;
    double mean_radius_; // of all spheres to come, m
    std::vector<std::string> notes_;
    std::vector<std::unique_ptr<SurfaceMotion>> motions_;
    std::unique_ptr<Model> model_;
    std::int64_t chosen_at_ = 0; // step of the last choice of the skin
    std::int64_t searches_ = 0;  // until then
};

} // namespace proveta
