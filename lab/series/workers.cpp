#include "lab/series/workers.hpp"

#include <algorithm>

namespace proveta {

namespace {

// Maximum resident set of a ucs run, packing and report included: 59 MB with 13,500 spheres, 35 MB with 800, so 1.9 kB a sphere, of which
// the model takes 1.3. Twice that, because a half-rate check has a second model, and for events, pictures and tessellations. What the
// process has whatever it does, some 30 MB, is there already when the members begin; the fixed part is for a member's stacks and buffers.
constexpr double bytes_a_sphere = 4e3;
constexpr double bytes_a_test = 16e6;
constexpr double share_of_available = 0.8; // the rest is for other programs

} // namespace

double memory_of_test(std::size_t spheres) { return bytes_a_test + bytes_a_sphere * static_cast<double>(spheres); }

std::size_t members_at_once(std::size_t threads, std::size_t members, double bytes_a_member, std::optional<double> available) {
    std::size_t most = std::min(threads, members);
    if (available) {
        const double fit = share_of_available * *available / bytes_a_member;
        most = fit < static_cast<double>(most) ? static_cast<std::size_t>(fit) : most;
    }
    return std::max<std::size_t>(most, 1);
}

int threads_of_worker(std::size_t k, std::size_t n, std::size_t threads) {
    return std::max(1, static_cast<int>(threads / n + (k < threads % n ? 1 : 0)));
}

} // namespace proveta
