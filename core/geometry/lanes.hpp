// Lanes: a handful of numbers treated as one, so that a law written once serves a single bond and a vector of bonds.
//
// A law is a template on its number type T and uses only +, -, *, /, comparisons and the functions below. With T = double it is
// ordinary scalar code; with T = Lanes the same text runs on every lane of the processor's vector registers. No operation here mixes
// lanes, and the build forbids contraction to fused multiply-adds, so every width gives the same bits.
#pragma once

#include <cmath>
#include <cstddef>
#include <experimental/simd>
#include <type_traits>

namespace proveta {

using Lanes = std::experimental::native_simd<double>;

inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline bool any_of(bool condition) { return condition; }

template <class Abi>
inline std::experimental::simd<double, Abi> select(const std::experimental::simd_mask<double, Abi>& condition,
                                                   const std::experimental::simd<double, Abi>& yes,
                                                   const std::experimental::simd<double, Abi>& no) {
    auto out = no;
    std::experimental::where(condition, out) = yes;
    return out;
}

/// Number of lanes in T: 1 for double.
template <class T> constexpr std::size_t lane_count() {
    if constexpr (std::is_same_v<T, double>) {
        return 1;
    } else {
        return T::size();
    }
}

/// Consecutive numbers p[0], p[1], ... as one T.
template <class T> inline T load(const double* p) {
    if constexpr (std::is_same_v<T, double>) {
        return *p;
    } else {
        return T(p, std::experimental::element_aligned);
    }
}

template <class T> inline void store(double* p, const T& value) {
    if constexpr (std::is_same_v<T, double>) {
        *p = value;
    } else {
        value.copy_to(p, std::experimental::element_aligned);
    }
}

/// Scattered numbers p[index[0]], p[index[1]], ... as one T.
template <class T, class Index> inline T gather(const double* p, const Index* index) {
    if constexpr (std::is_same_v<T, double>) {
        return p[*index];
    } else {
        return T([&](auto k) { return p[index[k]]; });
    }
}

/// Lane k to p[k stride].
template <std::size_t stride, class T> inline void scatter(double* p, const T& value) {
    if constexpr (std::is_same_v<T, double>) {
        *p = value;
    } else {
        alignas(64) double lanes[T::size()];
        value.copy_to(lanes, std::experimental::vector_aligned);
        for (std::size_t k = 0; k < T::size(); ++k) {
            p[k * stride] = lanes[k];
        }
    }
}

/// One lane of a number.
template <class T> inline double in_lane(const T& value, std::size_t k) {
    if constexpr (std::is_same_v<T, double>) {
        (void)k;
        return value;
    } else {
        return value[k];
    }
}

template <class M> inline bool mask_lane(const M& mask, std::size_t k) {
    if constexpr (std::is_same_v<M, bool>) {
        (void)k;
        return mask;
    } else {
        return mask[k];
    }
}

} // namespace proveta
