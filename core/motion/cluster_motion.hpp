// Motion of clusters: loads gathered at the centre, velocity Verlet for that, RK4 on quaternions for the attitude.
#pragma once

#include "core/motion/motion.hpp"
#include "core/particles/clusters.hpp"

namespace proveta {

/// Moves clusters `begin` to `end` by dt seconds: gathers the loads of their spheres (2.72), which it empties, applies gravity and damping,
/// advances the bodies and puts their spheres where they are. first: as in `move_spheres`. `fastest` of the result is squared. Only
/// velocity Verlet.
MotionSums move_clusters(Clusters& clusters, Spheres& spheres, Loads& loads, std::size_t begin, std::size_t end, const MotionRule& rule,
                         double dt, bool first, bool measure);

} // namespace proveta
