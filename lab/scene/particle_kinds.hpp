// What the particles of a scene are: sizes and forms, before any is put in.
#pragma once

#include <vector>

#include "core/laws/material.hpp"
#include "core/particles/clusters.hpp"
#include "lab/scene/scene.hpp"

namespace proveta {

/// One particle to come.
struct PlannedParticle {
    double size;   ///< diameter, of a cluster that of the sphere of its volume, m
    int form = -1; ///< of the kind's forms; -1: a sphere
};

/// A kind of particles: all that are to come, in their order.
struct ParticleKind {
    int material = 0;
    double density = 0.0; ///< kg/m3
    std::vector<PlannedParticle> plan;
    std::vector<ClusterShape> forms; ///< of size 1; none: spheres
    std::vector<double> reach;       ///< of each form from its centre

    /// Radius of the sphere around a particle, m.
    [[nodiscard]] double reach_of(const PlannedParticle& p) const {
        return p.form < 0 ? 0.5 * p.size : p.size * reach[static_cast<std::size_t>(p.form)];
    }
};

/// The kinds of a scene, in its order. All that is random follows from its seed. Throws InputError for forms and sizes that cannot be made.
std::vector<ParticleKind> make_kinds(const Scene& scene);

/// Of all spheres to come, also those of clusters, m.
double mean_radius(const std::vector<ParticleKind>& kinds);

/// Largest step that is stable, by a bound, for each of the particles with twelve neighbours of its kind, overlapping by a share of the
/// radius, s.
double stable_step(const std::vector<ParticleKind>& kinds, const std::vector<Material>& materials, double largest_overlap);

} // namespace proveta
