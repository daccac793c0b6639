// Rows: eight numbers of one sphere in one cache line, and the passage between them and lanes. A kernel that works on a vector of bonds has
// one quantity of many bonds in a register; a sphere's sums lie together in memory. The matrix between the two is turned in registers.
#pragma once

#include <bit>
#include <utility>

#include "core/geometry/lanes.hpp"

namespace proveta {

constexpr std::size_t row_length = 8;

namespace rows {

/// A register of W numbers that may stand for any piece of an array.
template <std::size_t W> struct Register { using Type [[gnu::vector_size(W * sizeof(double)), gnu::may_alias]] = double; };
template <std::size_t W> using RegisterOf = typename Register<W>::Type;

// Exchanges blocks of `stride` numbers between a and b: of each pair of blocks a keeps its first and gets b's first, b the seconds.
template <std::size_t stride, class V, std::size_t... k> PROVETA_INLINE void exchange(V& a, V& b, std::index_sequence<k...>) {
    constexpr std::size_t w = sizeof...(k);
    const V low = __builtin_shufflevector(a, b, ((k & stride) == 0 ? k : k - stride + w)...);
    b = __builtin_shufflevector(a, b, ((k & stride) == 0 ? k + stride : k + w)...);
    a = low;
}

template <std::size_t stride, std::size_t W, class V> PROVETA_INLINE void transpose_from(V (&m)[W]) {
    if constexpr (stride < W) {
        for (std::size_t k = 0; k < W; ++k) {
            if ((k & stride) == 0) {
                exchange<stride>(m[k], m[k | stride], std::make_index_sequence<W>());
            }
        }
        transpose_from<2 * stride>(m);
    }
}

/// Turns a W by W matrix.
template <std::size_t W, class V> PROVETA_INLINE void transpose(V (&m)[W]) { transpose_from<1>(m); }

} // namespace rows

/// Adds to two rows a pair: for each lane k, to row[first[k]] the six numbers a[0..5] of the lane and to row[second[k]] the six of b. Lanes
/// one after the other, so that the order of sums is that of the pairs at every width. rows: row_length numbers each, aligned to their
/// size.
template <class T>
PROVETA_INLINE void add_rows(double* rows, const std::int32_t* first, const std::int32_t* second, const T (&a)[6], const T (&b)[6]) {
    if constexpr (std::is_same_v<T, double>) {
        for (std::size_t c = 0; c < 6; ++c) {
            rows[row_length * static_cast<std::size_t>(*first) + c] += a[c];
        }
        for (std::size_t c = 0; c < 6; ++c) {
            rows[row_length * static_cast<std::size_t>(*second) + c] += b[c];
        }
    } else {
        constexpr std::size_t W = T::size();
        static_assert(row_length % W == 0, "a row is a whole number of registers");
        using V = rows::RegisterOf<W>;
        for (std::size_t chunk = 0; chunk < 6; chunk += W) {
            V in_a[W];
            V in_b[W];
            for (std::size_t c = 0; c < W; ++c) {
                in_a[c] = chunk + c < 6 ? std::bit_cast<V>(a[chunk + c]) : V{};
                in_b[c] = chunk + c < 6 ? std::bit_cast<V>(b[chunk + c]) : V{};
            }
            rows::transpose(in_a);
            rows::transpose(in_b);
            for (std::size_t k = 0; k < W; ++k) {
                *reinterpret_cast<V*>(rows + row_length * static_cast<std::size_t>(first[k]) + chunk) += in_a[k];
                *reinterpret_cast<V*>(rows + row_length * static_cast<std::size_t>(second[k]) + chunk) += in_b[k];
            }
        }
    }
}

/// The first six numbers of consecutive rows, one row a lane.
template <class T> PROVETA_INLINE void load_rows(const double* rows, T (&out)[6]) {
    if constexpr (std::is_same_v<T, double>) {
        for (std::size_t c = 0; c < 6; ++c) {
            out[c] = rows[c];
        }
    } else {
        constexpr std::size_t W = T::size();
        using V = rows::RegisterOf<W>;
        for (std::size_t chunk = 0; chunk < 6; chunk += W) {
            V m[W];
            for (std::size_t k = 0; k < W; ++k) {
                m[k] = *reinterpret_cast<const V*>(rows + row_length * k + chunk);
            }
            rows::transpose(m);
            for (std::size_t c = 0; c < W && chunk + c < 6; ++c) {
                out[chunk + c] = std::bit_cast<T>(m[c]);
            }
        }
    }
}

} // namespace proveta
