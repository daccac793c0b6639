#include "core/geometry/hilbert.hpp"

#include <algorithm>
#include <numeric>

namespace proveta {

namespace {

// Skilling's transform from axes to the transposed Hilbert index, in place.
void axes_to_transpose(std::array<std::uint32_t, 3>& axes, int bits) {
    const std::uint32_t top = 1u << (bits - 1);
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        const std::uint32_t p = q - 1;
        for (auto& axis : axes) {
            if (axis & q) {
                axes[0] ^= p;
            } else {
                const std::uint32_t t = (axes[0] ^ axis) & p;
                axes[0] ^= t;
                axis ^= t;
            }
        }
    }
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    std::uint32_t t = 0;
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        if (axes[2] & q) {
            t ^= q - 1;
        }
    }
    for (auto& axis : axes) {
        axis ^= t;
    }
}

} // namespace

std::uint64_t hilbert_key(std::array<std::uint32_t, 3> cell, int bits) {
    axes_to_transpose(cell, bits);
    std::uint64_t key = 0;
    for (int b = bits - 1; b >= 0; --b) {
        for (const auto axis : cell) {
            key = (key << 1) | ((axis >> b) & 1u);
        }
    }
    return key;
}

std::vector<std::uint32_t> hilbert_order(const VectorField& positions) {
    const std::size_t n = positions.size();
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    if (n < 2) {
        return order;
    }
    Vec3 low = positions.at(0);
    Vec3 high = low;
    for (std::size_t k = 1; k < n; ++k) {
        low = low.cwiseMin(positions.at(k));
        high = high.cwiseMax(positions.at(k));
    }
    const int bits = 16;
    const double cells = (1u << bits) - 1;
    const double extent = std::max((high - low).maxCoeff(), 1e-300);
    std::vector<std::uint64_t> keys(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 at = (positions.at(k) - low) / extent * cells;
        keys[k] =
            hilbert_key({static_cast<std::uint32_t>(at.x()), static_cast<std::uint32_t>(at.y()), static_cast<std::uint32_t>(at.z())}, bits);
    }
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
    return order;
}

} // namespace proveta
