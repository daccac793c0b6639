// How to cite what a page shows.
#pragma once

#include <string>

#include "core/input/json.hpp"

namespace proveta {

/// A sentence with program, version, title, date and a hash of the input. input: as resolved, with every value filled in, so that the hash
/// is equal if and only if the same is asked.
std::string citation(const std::string& what, const std::string& title, const input::Json& input);

} // namespace proveta
