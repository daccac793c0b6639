// The state of a calculation on disk.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "core/state.hpp"

namespace proveta {

/// Names all that later steps depend on.
using VisitState = std::function<void(StateVisitor&)>;

/// A checkpoint is missing, damaged, foreign, or of another calculation; the message begins with the file's name.
struct CheckpointError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Stores a state; the file appears whole or not at all, and the one that had its name before is kept under `earlier_checkpoint`. owner: a
/// text that tells which calculation it is of. Throws FileError.
void save_checkpoint(const std::string& file, const std::string& owner, const VisitState& state);

/// Restores a state: what goes on from it goes on bit for bit. Throws CheckpointError; what was visited is then in no state to go on from,
/// until another checkpoint is loaded.
void load_checkpoint(const std::string& file, const std::string& owner, const VisitState& state);

/// Name of the checkpoint before the last: "checkpoint.h5" was "checkpoint.earlier.h5".
std::string earlier_checkpoint(const std::string& file);

} // namespace proveta
