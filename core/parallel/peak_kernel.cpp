// Compiled once per instruction set; PROVETA_VARIANT names the variant's entry point.
#include "core/parallel/peak_kernel.hpp"

#include "core/geometry/lanes.hpp"
#include "core/parallel/variant.hpp"

namespace proveta {

std::size_t PROVETA_VARIANT(peak_kernel)(std::size_t rounds, double* sink) {
    Lanes value[peak_operations];
    for (auto& v : value) {
        v = Lanes(1.0);
    }
    const Lanes grow(1.0 + 1e-9);
    const Lanes rise(1e-9);
    for (std::size_t r = 0; r < rounds; ++r) {
        for (std::size_t k = 0; k < peak_operations; k += 2) {
            value[k] = value[k] * grow;
            value[k + 1] = value[k + 1] + rise;
        }
    }
    *sink = 0.0;
    for (const auto& v : value) {
        *sink += in_lane(v, 0);
    }
    return lane_count<Lanes>();
}

} // namespace proveta
