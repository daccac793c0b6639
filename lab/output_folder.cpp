#include "lab/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <vector>

#include "core/input/json.hpp"
#include "reports/files.hpp"

namespace proveta {

namespace fs = std::filesystem;

namespace {

// What an earlier result has left in its folder, besides the members of a series and the manifest.
constexpr std::array result_files{"report.html",
                                  "summary.json",
                                  "curve.csv",
                                  "events.csv",
                                  "acoustic.csv",
                                  "energy.csv",
                                  "particles.csv",
                                  "checkpoint.h5",
                                  "checkpoint.earlier.h5",
                                  "rate_check.h5",
                                  "rate_check.earlier.h5",
                                  "series.pvd",
                                  "series.csv",
                                  "study.csv",
                                  "mean_curves",
                                  "fields",
                                  "pictures",
                                  "spheres.pvd",
                                  "bonds.pvd",
                                  "platens.pvd",
                                  "membrane.pvd",
                                  "views.py",
                                  "comparison.csv",
                                  "table.csv",
                                  "table.h5",
                                  "failures.csv",
                                  "sensitivity.csv",
                                  "curve_sensitivity.csv",
                                  "trials.csv",
                                  "card.json",
                                  "progress.json"};

bool is_own(const std::string& name) {
    return name == "manifest.json" || std::find(result_files.begin(), result_files.end(), name) != result_files.end();
}

bool is_half(const fs::path& file) { return file.extension() == ".partial" || file.extension() == ".next"; }

// Nothing, or what a process left that was killed while it wrote its very first file or made folders for members.
bool holds_nothing(const fs::path& folder) {
    std::error_code error;
    const fs::directory_iterator entries(folder, error);
    return std::all_of(begin(entries), end(entries), [](const auto& entry) {
        std::error_code unseen;
        return entry.is_directory(unseen) ? fs::is_empty(entry.path(), unseen)
                                          : is_half(entry.path()) && is_own(entry.path().stem().string());
    });
}

// The manifest of an earlier result; no object where there is none, or one of another program.
input::Json own_manifest(const fs::path& folder) {
    std::ifstream in(folder / "manifest.json");
    input::Json json = in ? input::Json::parse(in, nullptr, false) : input::Json();
    if (json.is_object()) {
        for (const auto& [key, value] : json.items()) {
            if (key.starts_with("proveta_") && key.ends_with("manifest")) {
                return json;
            }
        }
    }
    return {};
}

// A ledger of trials; one without any is ours where there is nothing but it and what trials need.
bool holds_ledger(const fs::path& folder) {
    const std::string start = "{\"trial\":";
    std::string found(start.size(), '\0');
    std::ifstream in(folder / "ledger.jsonl");
    if (!in || in.read(found.data(), static_cast<std::streamsize>(start.size()))) {
        return static_cast<bool>(in) && found == start;
    }
    std::error_code error;
    const fs::directory_iterator entries(folder, error);
    return in.gcount() == 0 && std::all_of(begin(entries), end(entries), [](const auto& entry) {
               const auto name = entry.path().filename();
               return name == "ledger.jsonl" || name == "trials" || name == "specimens";
           });
}

// Folders that an earlier series made for its members.
std::vector<fs::path> members_in(const fs::path& folder, const input::Json& manifest) {
    std::vector<fs::path> out;
    if (!manifest.is_object() || !manifest.contains("members")) {
        return out;
    }
    for (const auto& member : manifest["members"]) {
        const std::string name = input::text_at(member, "name");
        if (is_member_name(name) && own_manifest(folder / name).is_object()) {
            out.push_back(folder / name);
        }
    }
    return out;
}

void clear(const fs::path& path) {
    std::error_code error;
    fs::remove_all(path, error);
    if (error) {
        throw FileError(path.string() + " cannot be removed: " + error.message());
    }
}

// What is in a folder of results, its manifest last: until then it says whose the folder is.
void clear_member(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().filename() != "manifest.json") {
            clear(entry.path());
        }
    }
    clear(folder / "manifest.json");
}

// What a process that was killed did not finish writing.
void remove_halves(const fs::path& folder) {
    std::vector<fs::path> halves;
    for (const auto& part : {folder, folder / "fields", folder / "pictures"}) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(part, error)) {
            if (is_half(entry.path()) && (part != folder || is_own(entry.path().stem().string()))) {
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

bool is_member_name(const std::string& name) {
    constexpr std::size_t longest = 200; // bytes; file systems take 255, and endings come to it
    return !name.empty() && name.size() <= longest && name.front() != '.' && name.find_first_of("/\\") == std::string::npos &&
           !is_own(name) && name != "ledger.jsonl" && name != "trials" && name != "specimens";
}

std::string result_name(const fs::path& file, const std::string& otherwise) {
    const std::string stem = file.stem().string();
    return stem != "manifest" && is_member_name(stem) ? stem : otherwise;
}

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
    const auto refuse = [&](const std::string& found, const std::string& expected) {
        take_away();
        throw input::InputError({{"--out", "", "\"" + path.string() + "\", " + found, expected, ""}});
    };
    std::error_code error;
    for (fs::path p = fs::absolute(path); p != p.root_path() && !fs::exists(fs::symlink_status(p, error)); p = p.parent_path()) {
        if (const auto name = p.filename(); !name.empty() && name != "." && name != "..") { // else it ends in a slash, or comes back
            made_.push_back(p);
        }
    }
    if (fs::exists(path, error) && !fs::is_directory(path, error)) {
        refuse("which is a file", "a folder");
    }
    fs::create_directories(path, error);
    if (error) {
        refuse("which cannot be made: " + error.message(), "a folder that can be written");
    }
    if (access(path.c_str(), W_OK | X_OK) != 0) {
        refuse("which cannot be written", "a folder that can be written");
    }
    if (!holds_nothing(path) && !own_manifest(path).is_object() && !holds_ledger(path)) {
        refuse("which holds other files", "a new or empty folder, or one with an earlier result to replace");
    }
    lock_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0 && (errno == ENOENT || errno == ENOTDIR)) {
        throw FolderGone(path.string() + " has been moved or removed");
    }
    // A file system without locks is no reason to refuse.
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(lock_);
        refuse("into which another run is writing now", "a folder of its own");
    }
}

// Whether the path still leads to the folder claimed, as far as can be seen.
bool OutputFolder::still_there() const {
    struct stat claimed = {};
    struct stat found = {};
    return lock_ < 0 || fstat(lock_, &claimed) != 0 ||
           (stat(path_.c_str(), &found) == 0 && found.st_dev == claimed.st_dev && found.st_ino == claimed.st_ino);
}

// What was made here goes, as long as nobody has put anything into it.
void OutputFolder::take_away() const {
    for (const auto& folder : made_) {
        std::error_code ignored;
        fs::remove(folder, ignored);
    }
}

OutputFolder::~OutputFolder() {
    if (!begun_ && still_there()) {
        take_away();
    }
    if (lock_ >= 0) {
        close(lock_);
    }
}

void OutputFolder::begin(const std::vector<std::string>& members) {
    look(); // it must be there still: what is cleared is the folder that was claimed
    begun_ = true;
    auto manifest = own_manifest(path_);
    if (manifest.is_object()) { // who finds it now finds no whole result
        manifest["status"] = "cleared";
        write_manifest(manifest);
    }
    for (const auto& member : members_in(path_, manifest)) {
        clear_member(member);
        if (std::find(members.begin(), members.end(), member.filename()) == members.end()) {
            clear(member);
        }
    }
    for (const char* name : result_files) {
        clear(path_ / name);
    }
    remove_halves(path_);
}

void OutputFolder::write_manifest(const input::Json& manifest) const { report::write_json(file("manifest.json"), manifest); }

void OutputFolder::look() const {
    if (!still_there()) {
        throw FolderGone(path_.string() + " is not the folder any more that this began in: it has been moved or removed; where it is now, "
                                          "go on with: proveta resume");
    }
}

std::string OutputFolder::file(const std::string& name) const {
    look();
    return (path_ / name).string();
}

void OutputFolder::go_on() {
    look();
    begun_ = true;
    remove_halves(path_);
}

} // namespace proveta
