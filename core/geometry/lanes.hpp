// Lanes: a handful of numbers treated as one, so that a law written once serves a single bond and a vector of bonds.
//
// A law is a template on its number type T and uses only +, -, *, /, comparisons and the functions below. With T = double it is
// ordinary scalar code; with T = Lanes the same text runs on every lane of the processor's vector registers. No operation here mixes
// lanes, and the build forbids contraction to fused multiply-adds, so every width gives the same bits.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

#if defined(__AVX512F__) || defined(__FMA__)
#include <immintrin.h>
#endif

/// For every function that a kernel calls: values in vector registers must not pass through memory, and no copy of the function compiled
/// for one instruction set may be linked in the place of another's.
#define PROVETA_INLINE [[gnu::always_inline]] inline

namespace proveta {

using Lanes = std::experimental::native_simd<double>;

PROVETA_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
PROVETA_INLINE bool any_of(bool condition) { return condition; }

template <class Abi>
PROVETA_INLINE std::experimental::simd<double, Abi> select(const std::experimental::simd_mask<double, Abi>& condition,
                                                           const std::experimental::simd<double, Abi>& yes,
                                                           const std::experimental::simd<double, Abi>& no) {
#ifdef __clang__
    // `where` of GCC 12's library takes the wrong side with AVX-512 when Clang compiles it.
    return std::experimental::simd<double, Abi>([&](auto k) { return condition[k] ? yes[k] : no[k]; });
#else
    auto out = no;
    std::experimental::where(condition, out) = yes;
    return out;
#endif
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
template <class T> PROVETA_INLINE T load(const double* p) {
    if constexpr (std::is_same_v<T, double>) {
        return *p;
    } else {
        return T(p, std::experimental::element_aligned);
    }
}

template <class T> PROVETA_INLINE void store(double* p, const T& value) {
    if constexpr (std::is_same_v<T, double>) {
        *p = value;
    } else {
        value.copy_to(p, std::experimental::element_aligned);
    }
}

/// Scattered numbers p[index[0]], p[index[1]], ... as one T.
template <class T> PROVETA_INLINE T gather(const double* p, const std::int32_t* index) {
    if constexpr (std::is_same_v<T, double>) {
        return p[*index];
    } else {
#ifdef __AVX512F__
        if constexpr (T::size() == 8) {
            return T(_mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(index)), p, sizeof(double)));
        }
#endif
        return T([&](auto k) { return p[index[k]]; });
    }
}

/// Gathers by ascending indices that mostly lie close together, such as the first spheres of consecutive bonds: one load and a permutation
/// where they all fall within one register, at a third of the price. count: length of the arrays that will be read.
template <class T> struct NearGather {
    const std::int32_t* index;
#ifdef __AVX512F__
    bool near = false;
    __m512i order{};
#endif

    PROVETA_INLINE NearGather(const std::int32_t* ascending, [[maybe_unused]] std::int32_t count) : index(ascending) {
#ifdef __AVX512F__
        if constexpr (lane_count<T>() == 8) {
            near = index[7] - index[0] < 8 && index[0] + 8 <= count;
            const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
            order = _mm512_cvtepi32_epi64(_mm256_sub_epi32(all, _mm256_set1_epi32(index[0])));
        }
#endif
    }

    PROVETA_INLINE T operator()(const double* p) const {
#ifdef __AVX512F__
        if constexpr (lane_count<T>() == 8) {
            if (near) {
                return T(_mm512_permutexvar_pd(order, _mm512_loadu_pd(p + index[0])));
            }
        }
#endif
        return gather<T>(p, index);
    }
};

/// a b + c and c - a b, rounded once. Written out where speed asks for it and never left to the compiler, so that every instruction set
/// gives the same bits.
template <class T> PROVETA_INLINE T mul_add(const T& a, const T& b, const T& c) {
    if constexpr (std::is_same_v<T, double>) {
        return std::fma(a, b, c);
    } else {
#ifdef __AVX512F__
        if constexpr (T::size() == 8) {
            return T(_mm512_fmadd_pd(static_cast<__m512d>(a), static_cast<__m512d>(b), static_cast<__m512d>(c)));
        }
#endif
#ifdef __FMA__
        if constexpr (T::size() == 4) {
            return T(_mm256_fmadd_pd(static_cast<__m256d>(a), static_cast<__m256d>(b), static_cast<__m256d>(c)));
        }
#endif
        return T([&](auto k) { return std::fma(a[k], b[k], c[k]); });
    }
}
template <class T> PROVETA_INLINE T sub_mul(const T& c, const T& a, const T& b) {
    if constexpr (std::is_same_v<T, double>) {
        return std::fma(-a, b, c);
    } else {
#ifdef __AVX512F__
        if constexpr (T::size() == 8) {
            return T(_mm512_fnmadd_pd(static_cast<__m512d>(a), static_cast<__m512d>(b), static_cast<__m512d>(c)));
        }
#endif
#ifdef __FMA__
        if constexpr (T::size() == 4) {
            return T(_mm256_fnmadd_pd(static_cast<__m256d>(a), static_cast<__m256d>(b), static_cast<__m256d>(c)));
        }
#endif
        return T([&](auto k) { return std::fma(-a[k], b[k], c[k]); });
    }
}

template <class T> PROVETA_INLINE T dot(const T (&a)[3], const T (&b)[3]) {
    return mul_add(a[2], b[2], mul_add(a[1], b[1], T(a[0] * b[0])));
}

/// Component c of a x b.
template <class T> PROVETA_INLINE T cross(const T (&a)[3], const T (&b)[3], int c) {
    const int p = (c + 1) % 3;
    const int q = (c + 2) % 3;
    return sub_mul(T(a[p] * b[q]), a[q], b[p]);
}

/// 1 / sqrt(x) to the last bit or two, for x between 1e-37 and 1e37: the same bits at every width, and in half the time of a square root
/// and a division. Both of these are exact in single precision, whence two of Newton's steps lead to full precision.
template <class T> PROVETA_INLINE T inverse_sqrt(const T& x) {
    T y;
    if constexpr (std::is_same_v<T, double>) {
        y = static_cast<double>(1.0f / std::sqrt(static_cast<float>(x)));
    } else {
        namespace stdx = std::experimental;
        using Single = stdx::simd<float, stdx::simd_abi::deduce_t<float, T::size()>>;
        const Single root = sqrt(stdx::static_simd_cast<Single>(x));
        y = stdx::static_simd_cast<T>(Single(1.0f) / root);
    }
    const T half = 0.5 * x;
    y = y * sub_mul(T(1.5), T(half * y), y);
    return y * sub_mul(T(1.5), T(half * y), y);
}

/// One lane of a number.
template <class T> PROVETA_INLINE double in_lane(const T& value, std::size_t k) {
    if constexpr (std::is_same_v<T, double>) {
        (void)k;
        return value;
    } else {
        return value[k];
    }
}

template <class M> PROVETA_INLINE bool mask_lane(const M& mask, std::size_t k) {
    if constexpr (std::is_same_v<M, bool>) {
        (void)k;
        return mask;
    } else {
        return mask[k];
    }
}

} // namespace proveta
