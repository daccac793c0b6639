// What is looked at while a scene runs: the table over time, the energy ledger, fields, pictures, and boxes at the end.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "lab/scene/feed.hpp"
#include "reports/record/record.hpp"
#include "reports/vtk.hpp"

namespace proveta {

/// How the particles move and touch at one time.
struct SceneState {
    std::size_t particles = 0;
    double mass = 0.0;      ///< kg
    double rms_speed = 0.0; ///< of their centres, m/s
    double fastest = 0.0;   ///< m/s
    double touching = 0.0;  ///< mean number of others and surfaces that one touches, counted by spheres
    double overlap = 0.0;   ///< largest of two spheres or a sphere and a surface, over the smaller radius
};
SceneState state_of(const Model& model);

/// curve.csv and energy.csv without rows. The forces are those of the particles on each surface.
report::Table empty_scene_curve(const Model& model);
report::Table empty_scene_energy();
/// Appends a row to both.
void sample_scene(const Model& model, const Feed& feed, report::Table& curve, report::Table& energy);

/// What a box holds.
struct BoxContent {
    std::string name;
    double solid_fraction = 0.0; ///< share of the box inside spheres, overlaps counted once
    double bulk_density = 0.0;   ///< mass of the particles whose centre is inside over the box's volume, kg/m3
    double touching = 0.0;       ///< mean number of contacts of these
    std::size_t particles = 0;   ///< these
};
BoxContent content_of(const OutletInput& box, const Model& model);

/// Particles (one point a sphere) and surfaces for ParaView.
report::Geometry particle_fields(const Model& model);
report::Geometry surface_fields(const Model& model);

/// What pictures of a scene show: the boxes that its particles come into and go out of, the deformable bodies, and the surfaces about
/// there.
Eigen::AlignedBox3d stage_of(const Scene& scene, const Walls& walls);

/// Upright slices through the middle of the stage, two mean radii thick, with the surfaces cut there.
std::vector<report::Picture> scene_slices(const Model& model, const Vec3& gravity, const Eigen::AlignedBox3d& stage,
                                          const std::string& when);

} // namespace proveta
