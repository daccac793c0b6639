#include "lab/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "core/input/json.hpp"

namespace proveta {

namespace fs = std::filesystem;

namespace {

bool is_half(const fs::path& file) { return file.extension() == ".partial" || file.extension() == ".next"; }

// Nothing, or what a process left that was killed while it wrote its very first file.
bool holds_halves_only(const fs::path& folder) {
    std::error_code error;
    const fs::directory_iterator entries(folder, error);
    return std::all_of(begin(entries), end(entries), [](const auto& entry) { return is_half(entry.path()); });
}

} // namespace

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
    const auto refuse = [&](const std::string& found, const std::string& expected) {
        throw input::InputError({{"--out", "", "\"" + path.string() + "\", " + found, expected, ""}});
    };
    std::error_code error;
    for (fs::path p = fs::absolute(path); !p.empty() && !fs::exists(p, error) && p != p.root_path(); p = p.parent_path()) {
        first_made_ = p;
    }
    if (fs::exists(path, error) && !fs::is_directory(path, error)) {
        refuse("which is a file", "a folder");
    }
    fs::create_directories(path, error);
    if (error) {
        const std::string why = error.message();
        if (!first_made_.empty()) {
            fs::remove_all(first_made_, error);
        }
        refuse("which cannot be made: " + why, "a folder that can be written");
    }
    if (access(path.c_str(), W_OK | X_OK) != 0) {
        refuse("which cannot be written", "a folder that can be written");
    }
    const bool earlier = fs::exists(path / "manifest.json", error) || fs::exists(path / "ledger.jsonl", error);
    if (!holds_halves_only(path) && !earlier) {
        refuse("which holds other files", "a new or empty folder, or one with an earlier result to replace");
    }
    lock_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // A file system without locks is no reason to refuse.
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(lock_);
        refuse("into which another run is writing now", "a folder of its own");
    }
}

namespace {

// Folders that an earlier series made for its members, by its manifest.
std::vector<fs::path> members_in(const fs::path& folder) {
    std::vector<fs::path> out;
    std::ifstream in(folder / "manifest.json");
    const auto manifest = input::Json::parse(in, nullptr, false);
    if (!manifest.is_object() || !manifest.contains("proveta_series_manifest") || !manifest.contains("members")) {
        return out;
    }
    for (const auto& member : manifest["members"]) {
        if (!member.is_object() || !member.contains("name") || !member["name"].is_string()) {
            continue;
        }
        const fs::path name = member["name"].get<std::string>();
        if (name.has_filename() && name == name.filename() && fs::exists(folder / name / "manifest.json")) {
            out.push_back(folder / name);
        }
    }
    return out;
}

// What a process that was killed did not finish writing.
void remove_halves(const fs::path& folder) {
    std::vector<fs::path> halves;
    for (const auto& part : {folder, folder / "fields", folder / "pictures"}) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(part, error)) {
            if (is_half(entry.path())) {
                halves.push_back(entry.path());
            }
        }
    }
    for (const auto& half : halves) {
        std::error_code gone;
        fs::remove(half, gone);
    }
}

} // namespace

OutputFolder::~OutputFolder() {
    if (lock_ >= 0) {
        close(lock_);
    }
    if (!begun_ && !first_made_.empty()) {
        std::error_code ignored;
        fs::remove_all(first_made_, ignored);
    }
}

void OutputFolder::begin() {
    begun_ = true;
    for (const auto& member : members_in(path_)) {
        fs::remove_all(member);
    }
    for (const char* name : {"report.html",     "summary.json",
                             "manifest.json",   "curve.csv",
                             "events.csv",      "acoustic.csv",
                             "energy.csv",      "particles.csv",
                             "checkpoint.h5",   "checkpoint.earlier.h5",
                             "rate_check.h5",   "rate_check.earlier.h5",
                             "series.pvd",      "series.csv",
                             "study.csv",       "mean_curves",
                             "fields",          "pictures",
                             "spheres.pvd",     "bonds.pvd",
                             "platens.pvd",     "membrane.pvd",
                             "views.py",        "table.csv",
                             "table.h5",        "failures.csv",
                             "sensitivity.csv", "curve_sensitivity.csv"}) {
        fs::remove_all(path_ / name);
    }
    fs::create_directories(path_); // a series that was cleared may have held it
    remove_halves(path_);
}

void OutputFolder::go_on() {
    begun_ = true;
    remove_halves(path_);
}

} // namespace proveta
