// Wall time.
#pragma once

#include <chrono>

namespace proveta {

using Clock = std::chrono::steady_clock;

/// Seconds gone by since then.
inline double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

} // namespace proveta
