// Which pairs each sphere belongs to: forces are kept per pair and then summed per sphere in this order, so that no sum depends on threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace proveta {

/// For each sphere the pairs it belongs to, in ascending pair order. Entry: 2 * pair + side, side 0 for the first sphere of the pair.
struct Incidence {
    std::vector<std::uint32_t> offset; ///< n + 1 entries
    std::vector<std::uint32_t> entry;

    [[nodiscard]] std::uint32_t degree(std::size_t sphere) const { return offset[sphere + 1] - offset[sphere]; }
};

/// Builds the incidence of `first[k]`, `second[k]` over n spheres.
Incidence make_incidence(std::size_t n, const std::vector<std::int32_t>& first, const std::vector<std::int32_t>& second);

} // namespace proveta
