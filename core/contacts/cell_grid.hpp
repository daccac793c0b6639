// Cell search: spheres sorted into cubes so that near pairs are found in time linear in their number.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/vector_field.hpp"
#include "core/parallel/team.hpp"

namespace proveta {

/// A pair of spheres, i < j.
struct Pair {
    std::int32_t i;
    std::int32_t j;
    friend bool operator==(const Pair& a, const Pair& b) { return a.i == b.i && a.j == b.j; }
    friend bool operator<(const Pair& a, const Pair& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
};

/// Items sorted into cubic cells over the box of their centres. The number of cells is bounded by twice the number of items (plus a
/// constant), whatever the extent, by widening the cells; so a stray sphere far away costs no memory.
class CellGrid {
  public:
    /// positions: centres in m; width: wished edge of a cell in m, positive.
    CellGrid(const VectorField& positions, double width);

    /// Calls visit(begin, end) for the runs of `items` that the 27 cells around the cell of item i are, i itself included, in a fixed
    /// order.
    template <class Visit> void runs(std::size_t i, Visit&& visit) const {
        const auto c = cell_of_[i];
        const std::int64_t left = std::max<std::int64_t>(c[0] - 1, 0);
        const std::int64_t right = std::min<std::int64_t>(c[0] + 1, count_[0] - 1);
        for (std::int64_t z = std::max<std::int64_t>(c[2] - 1, 0); z <= std::min<std::int64_t>(c[2] + 1, count_[2] - 1); ++z) {
            for (std::int64_t y = std::max<std::int64_t>(c[1] - 1, 0); y <= std::min<std::int64_t>(c[1] + 1, count_[1] - 1); ++y) {
                const std::int64_t row = (z * count_[1] + y) * count_[0];
                visit(offset_[static_cast<std::size_t>(row + left)], offset_[static_cast<std::size_t>(row + right) + 1]);
            }
        }
    }
    [[nodiscard]] const std::vector<std::uint32_t>& items() const { return items_; } ///< cell after cell, along x first

  private:
    std::array<std::int64_t, 3> count_{1, 1, 1};
    std::vector<std::array<std::int32_t, 3>> cell_of_;
    std::vector<std::uint32_t> offset_;
    std::vector<std::uint32_t> items_;
};

/// All pairs i < j with centre distance at most factor (R_i + R_j) + gap, sorted by (i, j).
/// positions and radii in m; gap in m; team: who shares the work, nobody: OpenMP's threads.
std::vector<Pair> find_pairs(const VectorField& positions, const std::vector<double>& radii, double factor, double gap,
                             Team* team = nullptr);

} // namespace proveta
