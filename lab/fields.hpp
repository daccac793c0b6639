// Pictures and fields of a specimen in the press.
#pragma once

#include <string>
#include <vector>

#include "lab/bench.hpp"
#include "reports/record/record.hpp"
#include "reports/vtk.hpp"

namespace proveta {

/// Spheres with radius, displacement, velocity, Love-Weber stress (compression positive: xx, yy, zz, xy, yz, zx), damage (share of its
/// bonds that failed), fragment, group and material. The model's last step must have measured.
report::Geometry sphere_fields(const Bench& bench);
/// Of each sphere the share of its bonds that have failed. mode: of the bonds, as `Bonds::mode` is or was.
std::vector<double> damage_of(const Model& model, const std::vector<std::uint8_t>& mode);
/// Value below which a share of the values lies, 0 of none: colours go by it, so that single splinters do not decide them.
double quantile(std::vector<double> values, double share);
/// Bonds as lines with mode (0 intact, 1 tension, 2 shear), damage, failure criterion state, normal (compression positive) and shear force.
report::Geometry bond_fields(const Bench& bench);
/// The deformable bodies' skins as polygons, with displacement and velocity of the nodes and, of membranes, the largest true stress.
report::Geometry body_fields(const Model& model);
/// The platens as polygons.
report::Geometry platen_fields(const Bench& bench);

/// A vertical slice of one sphere diameter through the axis: spheres shaded by how far they moved sideways, failed bonds as strokes.
report::Picture slice(const Bench& bench, const std::string& title);

/// The membrane seen from its side: shaded by how far it has moved outwards, its bulges and dents lit from the left. Only with a membrane.
report::Picture membrane_view(const Bench& bench, const std::string& title);

} // namespace proveta
