// Regular plates of equal discs, whose elasticity is known in closed form.
#pragma once

#include "specimens/specimen.hpp"

namespace proveta {

/// columns x rows touching discs of radius r (m) on a square lattice; the plate is 2 r columns wide and 2 r rows high.
Specimen square_lattice(std::size_t columns, std::size_t rows, double r);

/// Rows of touching discs of radius r (m), sqrt(3) r apart, every other row shifted by r and one disc shorter, so that each disc inside has
/// six neighbours. The plate is as wide as the long rows; it reaches r beyond the first and last row.
Specimen hexagonal_lattice(std::size_t columns, std::size_t rows, double r);

} // namespace proveta
