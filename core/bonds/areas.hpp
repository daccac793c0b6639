// Effective areas of bonds (thesis 5.1.3 and 5.3).
#pragma once

#include <cstdint>
#include <vector>

#include "core/contacts/cell_grid.hpp"
#include "core/laws/material.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Surface of a regular polyhedron of `faces` faces over that of its inscribed sphere: 3.30797 (4), 1.90986 (6), 1.65399 (8),
/// 1.32503 (12), 1.20657 (20), linear between; held below 4; 1 + 0.20657 * 20 / faces above 20 (table 5.1).
double polyhedron_ratio(double faces);

/// Perimeter of a regular polygon of `sides` sides over that of its inscribed circle, n tan(pi/n) / pi (table 5.2); held below 3.
double polygon_ratio(double sides);

/// Areas of pairs under one rule, and the per-sphere weights that make areas of later contacts consistent with them.
struct Areas {
    std::vector<double> pair;   ///< one a pair, m2; 0: the pair shares no face and is not bonded
    std::vector<double> weight; ///< alpha_i of each sphere; 1 for the rules that have none
};

/// Area of a pair before any weighting, m2. Spheres: pi min(R_i, R_j)^2 (5.4) by `minimum_radius`, else that of the truncated cone,
/// pi R_i R_j (5.33). Discs of 1 m thickness: 2 min(R_i, R_j), else that of the trapezium, 2 (R_j - R_i) / ln(R_j / R_i).
double raw_area(AreaRule rule, const Spheres& spheres, std::size_t i, std::size_t j);

/// Areas of `pairs` by `rule`. skin[i] != 0 marks spheres at the specimen's surface, which are not surrounded by neighbours.
///
/// virtual_polyhedron: alpha_i = S_i / sum_j of the raw areas (5.36), S_i = ratio(n_i) 4 pi Rh_i^2, of discs ratio(n_i) 2 pi Rh_i, with
/// Rh_i the mean distance to the mid-gap planes; a skin sphere takes the mean alpha of the interior, since the part of its polyhedron that
/// looks outwards carries no bond. The two sides of a pair are averaged, so that action equals reaction.
Areas effective_areas(AreaRule rule, const Spheres& spheres, const std::vector<Pair>& pairs, const std::vector<std::uint8_t>& skin);

/// Area of a contact that was not among the pairs, from the weights of its spheres, m2.
double contact_area(AreaRule rule, const Spheres& spheres, std::size_t i, std::size_t j, double weight_i, double weight_j);

} // namespace proveta
