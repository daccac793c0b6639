// Transcendental functions of lanes: the same bits on one number and on every width of vector, which the C library does not promise.
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

#include "core/geometry/lanes.hpp"

namespace proveta {

namespace lanes_bits {

/// The bits of T as whole numbers, one a lane.
template <class T> struct Whole { using Type [[gnu::vector_size(sizeof(T)), gnu::may_alias]] = std::uint64_t; };
template <> struct Whole<double> { using Type = std::uint64_t; };
template <class T> using WholeOf = typename Whole<T>::Type;

template <class T> PROVETA_INLINE WholeOf<T> of(const T& x) { return std::bit_cast<WholeOf<T>>(x); }
template <class T> PROVETA_INLINE T back(const WholeOf<T>& x) { return std::bit_cast<T>(x); }

} // namespace lanes_bits

/// e^x to 1e-13 relative; x is held between -700 and 700.
template <class T> PROVETA_INLINE T exp_of(const T& x) {
    using std::max;
    using std::min;
    const T bounded = max(min(x, T(700.0)), T(-700.0));
    // x = k ln 2 + r; adding 1.5 * 2^52 leaves k in the last bits.
    const T shift = T(6755399441055744.0);
    const T shifted = bounded * (1.0 / std::numbers::ln2) + shift;
    const T k = shifted - shift;
    const T r = sub_mul(sub_mul(bounded, k, T(6.93147180369123816490e-01)), k, T(1.90821492927058770002e-10));
    T sum = T(1.0 / 39916800.0);
    for (const double c : {3628800.0, 362880.0, 40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0, 2.0, 1.0, 1.0}) {
        sum = mul_add(sum, r, T(1.0 / c));
    }
    return sum * lanes_bits::back<T>((lanes_bits::of(shifted) + 1023u) << 52u);
}

/// ln x to 1e-13 absolute, for x from 1e-300 on.
template <class T> PROVETA_INLINE T log_of(const T& x) {
    using std::max;
    const auto bits = lanes_bits::of(T(max(x, T(1e-300))));
    const T two52 = T(4503599627370496.0);
    T exponent = lanes_bits::back<T>((bits >> 52u) | 0x4330000000000000u) - two52 - 1023.0;
    T mantissa = lanes_bits::back<T>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
    const auto upper = mantissa > T(std::numbers::sqrt2);
    mantissa = select(upper, T(0.5 * mantissa), mantissa);
    exponent = select(upper, T(exponent + 1.0), exponent);
    const T f = (mantissa - 1.0) / (mantissa + 1.0);
    const T f2 = f * f;
    T sum = T(1.0 / 17.0);
    for (const double c : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) {
        sum = mul_add(sum, f2, T(1.0 / c));
    }
    return exponent * std::numbers::ln2 + 2.0 * f * sum;
}

/// (2 / pi) atan(y / x) to 1e-11, for y and x of at least 0 and not both 0: 0 along x, 1 along y.
template <class T> PROVETA_INLINE T quarter_turn(const T& y, const T& x) {
    using std::max;
    using std::min;
    const T t = min(x, y) / max(max(x, y), T(1e-300));
    const auto steep = t > T(std::numbers::sqrt2 - 1.0);
    const T u = select(steep, T((t - 1.0) / (t + 1.0)), t);
    const T u2 = u * u;
    T sum = T(1.0 / 25.0);
    for (const double c : {-23.0, 21.0, -19.0, 17.0, -15.0, 13.0, -11.0, 9.0, -7.0, 5.0, -3.0, 1.0}) {
        sum = mul_add(sum, u2, T(1.0 / c));
    }
    const T angle = u * sum * (2.0 / std::numbers::pi) + select(steep, T(0.5), T(0.0));
    return select(y > x, T(1.0 - angle), angle);
}

} // namespace proveta
