// Particles come into a scene and leave it.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "lab/scene/particle_kinds.hpp"
#include "lab/scene/room.hpp"
#include "specimens/random.hpp"

namespace proveta {

/// Spheres and clusters on their way into a model, and where each sphere was in it before; see `Model::repopulate`.
struct Population {
    Spheres spheres;
    Clusters clusters;
    std::vector<std::int32_t> origin;
};

/// How a kind of particles fares.
struct FeedCount {
    std::string name;
    std::size_t planned = 0;
    std::size_t placed = 0;
    std::size_t left_out = 0; ///< would have reached into a surface when they were grown
};

/// What the particles of a scene are made of, who is in and who is out. All that is random follows from the scene's seed.
class Feed {
  public:
    /// Works out sizes and forms. Throws InputError for forms that cannot be made.
    explicit Feed(const Scene& scene);

    /// What stands there at the start: everything that is grown, and what is poured as far as there is room.
    Population first(const Walls& walls);

    /// Looks at a model between two steps: takes out who has reached an outlet or left the domain, lets in who is due and has room, and
    /// now and then puts those that are near in space near in memory. Cheap unless something is due.
    void look_after(Model& model);

    [[nodiscard]] const std::vector<FeedCount>& counts() const { return counts_; }
    [[nodiscard]] const std::vector<std::size_t>& taken() const { return taken_; } ///< by each outlet
    [[nodiscard]] std::size_t lost() const { return lost_; }                       ///< out of the domain
    [[nodiscard]] bool finished() const;                                           ///< all have come
    [[nodiscard]] const std::vector<ParticleKind>& kinds() const { return kinds_; }

    /// Names all that changes on the way.
    void visit_state(StateVisitor& visit);

  private:
    void place(const ParticleKind& kind, std::size_t number, const PlannedParticle& p, const Vec3& at, const rotation::Quaternion& attitude,
               Population& bodies, Population& alone);
    void grow(std::size_t number, Room& room, Population& bodies, Population& alone);
    void pour(std::size_t number, double time, Room& room, Population& bodies, Population& alone);
    [[nodiscard]] bool anyone_due(double time) const;
    void put_in(double time, const Walls& walls, const Spheres& there, Population& bodies, Population& alone);
    [[nodiscard]] std::vector<char> who_stays(const Spheres& spheres, const Clusters& clusters);
    [[nodiscard]] bool stays(const Vec3& at);

    const Scene& scene_;
    Random random_;
    std::vector<ParticleKind> kinds_;
    std::vector<double> next_look_; // at each kind, s
    std::vector<FeedCount> counts_;
    std::vector<std::size_t> taken_;
    std::size_t lost_ = 0;
    std::int64_t next_id_ = 0;
    Eigen::AlignedBox3d domain_;
    std::int64_t looked_at_ = 0; // step of the last look at who has left
    std::int64_t sorted_at_ = 0;
};

} // namespace proveta
