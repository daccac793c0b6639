// Forces and torques on the spheres, summed in an order that does not depend on threads.
//
// The spheres are cut, in their space-filling order, into blocks. All pairs of a block's spheres with later ones are one part of the work:
// it adds the force on i to i's own row, and that on j to j's row if j belongs to the block, otherwise to a row that the block keeps for j
// alone. The motion of j later adds those rows to its own, block after block.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/rows.hpp"
#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Sum of forces (N) and torques (N m) on a sphere: one cache line.
struct alignas(64) Load {
    double force[3] = {0.0, 0.0, 0.0};
    double torque[3] = {0.0, 0.0, 0.0};
    double unused[2] = {0.0, 0.0};
};
static_assert(sizeof(Load) == row_length * sizeof(double));

/// A run of spheres whose pairs are one part of the work, and the rows it keeps for spheres of other blocks.
struct SphereBlock {
    std::uint32_t begin, end;           ///< spheres
    std::uint32_t kept_begin, kept_end; ///< rows
};

constexpr std::uint32_t spheres_per_block = 256; ///< whatever the number of threads: it fixes the order of the sums

/// Number of blocks that spheres are cut into.
constexpr std::size_t blocks_of(std::size_t spheres) { return (spheres + spheres_per_block - 1) / spheres_per_block; }

/// Positions in an ascending list of spheres that belong to a block.
struct ListedRange {
    std::size_t begin, end;
};
ListedRange listed_in(const std::vector<std::int32_t>& spheres, const SphereBlock& block);

/// Pairs i < j and the row that j's share goes to; sorted by the block of i.
struct PairRows {
    const std::vector<std::int32_t>& i;
    const std::vector<std::int32_t>& j;
    std::vector<std::int32_t>& row_j;
};

class Loads {
  public:
    Loads() = default;
    explicit Loads(std::size_t spheres);

    /// Gives every pair its row. The rows of the spheres stay as they are.
    void arrange(const std::vector<PairRows>& lists);

    /// Adds a force (N) and a torque (N m) on a sphere, for the next motion.
    void add(std::size_t sphere, const Vec3& force, const Vec3& torque);

    [[nodiscard]] std::size_t spheres() const { return spheres_; }
    [[nodiscard]] const std::vector<SphereBlock>& blocks() const { return blocks_; }
    [[nodiscard]] double* rows() { return rows_.data()->force; }
    [[nodiscard]] Load& row(std::size_t k) { return rows_[k]; }
    [[nodiscard]] std::size_t kept() const { return rows_.size() - spheres_; }

    /// Empties the rows that a block keeps for others, before its pairs add to them.
    void clear_kept(const SphereBlock& block);
    /// Adds to the rows of a block's spheres what other blocks keep for them, in the order of those blocks.
    void collect(const SphereBlock& block);

  private:
    std::size_t spheres_ = 0;
    std::vector<SphereBlock> blocks_;
    std::vector<Load> rows_;            // one a sphere, then the kept ones
    std::vector<std::uint32_t> offset_; // of each sphere into from_
    std::vector<std::uint32_t> from_;   // kept rows of a sphere, ascending
};

} // namespace proveta
