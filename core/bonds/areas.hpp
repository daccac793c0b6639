// Effective areas of bonds (thesis 5.1.3 and 5.3).
#pragma once

#include <cstdint>
#include <vector>

#include "core/bonds/material.hpp"
#include "core/contacts/cell_grid.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Surface of a regular polyhedron of `faces` faces over that of its inscribed sphere: 3.30797 (4), 1.90986 (6), 1.65399 (8),
/// 1.32503 (12), 1.20657 (20), linear between; held below 4; 1 + 0.20657 * 20 / faces above 20 (table 5.1).
double polyhedron_ratio(double faces);

/// Areas of pairs under one rule, and the per-sphere weights that make areas of later contacts consistent with them.
struct Areas {
    std::vector<double> pair;   ///< one a pair, m2
    std::vector<double> weight; ///< alpha_i of each sphere; 1 for the rules that have none
};

/// Areas of `pairs` by `rule`. skin[i] != 0 marks spheres at the specimen's surface, which are not surrounded by neighbours.
///
/// virtual_polyhedron: alpha_i = ratio(n_i) 4 pi Rh_i^2 / sum_j pi R_i R_j (5.36) with Rh_i the mean distance to the mid-gap planes;
/// a skin sphere takes the mean alpha of the interior, since the part of its polyhedron that looks outwards carries no bond. The two
/// sides of a pair are averaged, so that action equals reaction.
Areas effective_areas(AreaRule rule, const Spheres& spheres, const std::vector<Pair>& pairs, const std::vector<std::uint8_t>& skin);

/// Area of a contact that was not among the pairs, from the weights of its spheres, m2.
double contact_area(AreaRule rule, double r_i, double r_j, double weight_i, double weight_j);

} // namespace proveta
