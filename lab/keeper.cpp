#include "lab/keeper.hpp"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <mutex>

#include "core/input/json.hpp"
#include "lab/run.hpp"

namespace proveta {

Keeper::Keeper(const OutputFolder& out, const char* name, std::string owner, double every, VisitState extra)
    : out_(out), name_(name), owner_(std::move(owner)), every_(every), extra_(std::move(extra)) {}

bool checkpoint_there(const std::string& file) {
    return std::filesystem::exists(file) || std::filesystem::exists(earlier_checkpoint(file));
}

bool Keeper::there() const { return checkpoint_there(out_.file(name_)); }

void Keeper::save(const VisitState& state) {
    const std::lock_guard lock(file_libraries());
    save_checkpoint(out_.file(name_), owner_, all_of(state));
    saved_ = Clock::now();
}

void Keeper::restore(const VisitState& state) const {
    const std::lock_guard lock(file_libraries());
    std::vector<input::Problem> problems;
    const std::string last = out_.file(name_);
    for (const auto& file : {last, earlier_checkpoint(last)}) {
        if (!std::filesystem::exists(file)) {
            continue;
        }
        try {
            load_checkpoint(file, owner_, all_of(state));
            return;
        } catch (const CheckpointError& e) {
            const std::string what = e.what();
            problems.push_back({file, "", what.starts_with(file + ": ") ? what.substr(file.size() + 2) : what,
                                "a whole checkpoint of this calculation", "begin anew, with another folder: --out NEW_FOLDER"});
            spdlog::warn("{}; looking for the one before it", what);
        }
    }
    throw input::InputError(problems);
}

VisitState Keeper::all_of(const VisitState& state) const {
    return [this, &state](StateVisitor& visit) {
        extra_(visit);
        state(visit);
    };
}

} // namespace proveta
