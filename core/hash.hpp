// A hash of numbers by their bits, for telling whether two states are the same.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace proveta {

/// FNV-1a, 64 bits, byte by byte from the lowest.
class Hash {
  public:
    void mix(const char* bytes, std::size_t size) {
        for (std::size_t k = 0; k < size; ++k) {
            value_ = (value_ ^ static_cast<unsigned char>(bytes[k])) * 1099511628211ull;
        }
    }

    void mix(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) {
            value_ = (value_ ^ ((word >> (8 * byte)) & 0xffu)) * 1099511628211ull;
        }
    }

    void mix(const std::vector<double>& values) {
        for (const double v : values) {
            mix(std::bit_cast<std::uint64_t>(v));
        }
    }

    /// A value of a state: a number, or how many there are and each of them.
    void mix_value(double value) { mix(std::bit_cast<std::uint64_t>(value)); }
    void mix_value(std::int64_t value) { mix(static_cast<std::uint64_t>(value)); }
    template <class T> void mix_value(const std::vector<T>& values) {
        mix(static_cast<std::uint64_t>(values.size()));
        if constexpr (std::is_same_v<T, double>) {
            mix(values);
        } else {
            for (const T v : values) {
                mix(static_cast<std::uint64_t>(v));
            }
        }
    }

    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 14695981039346656037ull;
};

} // namespace proveta
