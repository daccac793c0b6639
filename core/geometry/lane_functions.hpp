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

/// c[0] + c[1] x + c[2] x^2 + ..., odd and even powers by themselves, which halves the chain of operations.
template <class T, std::size_t n> PROVETA_INLINE T polynomial(const T& x, const double (&c)[n]) {
    static_assert(n >= 4);
    const T x2 = x * x;
    T sums[2] = {T(c[n - 1]), T(c[n - 2])};
    for (std::size_t k = n - 2; k-- > 0;) {
        T& sum = sums[(n - 1 - k) % 2];
        sum = mul_add(sum, x2, T(c[k]));
    }
    constexpr std::size_t even = (n - 1) % 2;
    return mul_add(sums[1 - even], x, sums[even]);
}

// The coefficients below interpolate at Chebyshev's nodes.

/// e^x to 3e-9 relative; x is held between -700 and 700.
template <class T> PROVETA_INLINE T exp_of(const T& x) {
    using std::max;
    using std::min;
    const T bounded = max(min(x, T(700.0)), T(-700.0));
    // x = k ln 2 + r; adding 1.5 * 2^52 leaves k in the last bits.
    const T shift = T(6755399441055744.0);
    const T shifted = mul_add(bounded, T(1.0 / std::numbers::ln2), shift);
    const T r = sub_mul(bounded, T(shifted - shift), T(std::numbers::ln2));
    constexpr double c[] = {1.0,
                            1.0000000377162135,
                            0.50000000471177841,
                            0.16666415514653618,
                            4.1666352896696873e-2,
                            8.3751263981322530e-3,
                            1.3941108438804987e-3};
    return polynomial(r, c) * lanes_bits::back<T>((lanes_bits::of(shifted) + 1023u) << 52u);
}

/// ln x to 1e-9 absolute, for x from 1e-300 on.
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
    constexpr double c[] = {1.9999999986313182, 0.66666815338150365, 0.39974850517846378, 0.29924390469444673};
    return mul_add(exponent, T(std::numbers::ln2), T(f * polynomial(T(f * f), c)));
}

/// (2 / pi) atan(y / x) to 1e-9, for y and x of at least 0 and not both 0: 0 along x, 1 along y.
template <class T> PROVETA_INLINE T quarter_turn(const T& y, const T& x) {
    using std::max;
    using std::min;
    const T least = min(x, y);
    const T most = max(max(x, y), T(1e-300));
    const auto steep = least > (std::numbers::sqrt2 - 1.0) * most; // half of the quarter is added then
    const T u = select(steep, T(least - most), least) / select(steep, T(least + most), most);
    constexpr double c[] = {0.63661977196729280,    -0.21220642246511986,  0.12731238735407435,
                            -9.0651680471964563e-2, 6.7289620113732712e-2, -3.8364650680761607e-2};
    const T angle = mul_add(u, polynomial(T(u * u), c), select(steep, T(0.5), T(0.0)));
    return select(y > x, T(1.0 - angle), angle);
}

} // namespace proveta
