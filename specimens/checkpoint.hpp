// The state of a calculation on disk.
#pragma once

#include <string>

#include "core/model.hpp"

namespace proveta {

/// Stores everything that later steps depend on, with the resolved deck; the file appears whole or not at all. Throws
/// std::runtime_error.
void save_checkpoint(Model& model, const std::string& deck, const std::string& file);

/// Brings a model that was set up from the same deck to the stored state; it then goes on bit for bit. Throws std::runtime_error when
/// the file is missing, foreign or belongs to another specimen.
void load_checkpoint(Model& model, const std::string& file);

} // namespace proveta
