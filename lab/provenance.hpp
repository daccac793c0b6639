// Where a result comes from: enough to repeat it.
#pragma once

#include <string>

#include "core/input/json.hpp"
#include "lab/bench.hpp"

namespace proveta {

/// Program version, e.g. "0.1.0".
std::string version();

/// Version, compiler, build type, vector width: a few lines for --version.
std::string version_text();

/// UTC time as "2026-01-31T12:00:00Z".
std::string now_utc();

/// A 64-bit hash as 16 hexadecimal digits.
std::string hex(std::uint64_t hash);

/// manifest.json: the resolved deck, versions, threads, seed, hashes and the command that runs it again. status: running, complete,
/// interrupted or failed.
input::Json manifest(const Deck& deck, const Bench& bench, const std::string& command, const std::string& status,
                     const std::string& started, const std::string& folder);

} // namespace proveta
