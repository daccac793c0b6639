// The arithmetic that a processor can do at most, for judging the kernels: independent additions and multiplications in registers.
#pragma once

#include <cstddef>

namespace proveta {

/// Does `rounds` times twelve vector operations and returns how many lanes a vector has; the results go to `sink`.
using PeakKernel = std::size_t (*)(std::size_t rounds, double* sink);

constexpr std::size_t peak_operations = 12; ///< vector operations a round

std::size_t peak_kernel_baseline(std::size_t rounds, double* sink);
std::size_t peak_kernel_avx2(std::size_t rounds, double* sink);
std::size_t peak_kernel_avx512(std::size_t rounds, double* sink);

} // namespace proveta
