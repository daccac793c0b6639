// Keeps the state of a calculation in its folder, now and then.
#pragma once

#include <string>

#include "lab/clock.hpp"
#include "lab/output_folder.hpp"
#include "specimens/checkpoint.hpp"

namespace proveta {

/// Whether there is a checkpoint of that name, or the one before it.
bool checkpoint_there(const std::string& file);

/// The checkpoints of one calculation in its folder: the last and the one before.
class Keeper {
  public:
    /// name: of the file, e.g. "checkpoint.h5"; owner: a text that tells which calculation it is, to the bit; every: seconds of wall time
    /// from one to the next, 0: only where one must be; extra: what is kept, and restored, besides the states given to `save`: no two
    /// values may have the same name.
    Keeper(const OutputFolder& out, const char* name, std::string owner, double every, VisitState extra);

    /// Whether the folder has one.
    [[nodiscard]] bool there() const;
    /// Whether it is time for one.
    [[nodiscard]] bool due() const { return every_ > 0.0 && since(saved_) > every_; }
    /// Throws FileError.
    void save(const VisitState& state);
    /// Restores the last one, or the one before when that is damaged. Throws InputError when none can be read.
    void restore(const VisitState& state) const;

  private:
    [[nodiscard]] VisitState all_of(const VisitState& state) const;

    const OutputFolder& out_;
    std::string name_;
    std::string owner_;
    double every_;
    VisitState extra_;
    Clock::time_point saved_ = Clock::now();
};

} // namespace proveta
