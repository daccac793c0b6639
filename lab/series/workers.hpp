// How many tests of a series run at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace proveta {

/// Memory that a test of so many spheres takes, bytes: an estimate to the safe side.
double memory_of_test(std::size_t spheres);

/// How many members run at once: no more than there are threads or members, and no more than fit into the memory, but at least one.
std::size_t members_at_once(std::size_t threads, std::size_t members, double bytes_a_member, std::optional<double> available);

/// Threads for worker k of n, of all that there are; every worker has at least one, and they add up when there are at least n.
int threads_of_worker(std::size_t k, std::size_t n, std::size_t threads);

} // namespace proveta
