// Random numbers that are the same on every machine.
#pragma once

#include <random>

namespace proveta {

/// Evenly from 0 to below 1, in steps of 2^-53: what std::uniform_real_distribution makes of an engine is not laid down.
inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

} // namespace proveta
