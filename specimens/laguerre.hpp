// Exact bond areas: the facets of the radical (Laguerre) tessellation of the spheres, clipped by the specimen's surface.
#pragma once

#include "core/bonds/areas.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// Facets of a tessellation, for the rule `laguerre`.
struct LaguerreAreas {
    /// Area of each given pair's facet (0: the two cells do not meet), and alpha_i = (sum of the sphere's facet areas) / (sum over its
    /// pairs of the raw areas), so that later contacts of the sphere are as wide as its facets are on average. A sphere without pairs
    /// takes the mean alpha of the others.
    Areas areas;
    std::size_t facetless = 0;    ///< pairs whose facet is missing or below a millionth of pi R_i R_j: bonds that are dropped
    double unbonded_share = 0.0;  ///< area of facets that are no pair's over that of all facets between spheres
    double volume_ratio = 0.0;    ///< volume of all cells over the shape's; differs from 1 where the round wall is cut by planes
    std::size_t without_cell = 0; ///< spheres left out: outside the shape's box, on top of another, or swallowed by their neighbours
    std::vector<double> cell;     ///< volume of each sphere's cell, m3
};

/// Tessellates the shape by the spheres (C. H. Rycroft, Voro++, Chaos 19, 041111, 2009) and measures the facets of `pairs`. A cylinder's
/// wall cuts each cell by one plane; a plate is tessellated in its plane, with facets of 1 m depth. The cost is linear in the number of
/// spheres.
LaguerreAreas laguerre_areas(const Shape& shape, const Spheres& spheres, const std::vector<Pair>& pairs);

} // namespace proveta
