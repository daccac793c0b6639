// The folder that a run writes into.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/whole_file.hpp"
#include "core/input/json.hpp"

namespace proveta {

/// Whether a member of a series may be called so: a folder beside the files of the series, which is none of them.
bool is_member_name(const std::string& name);

/// The stem of a file as the name of a folder; `otherwise` where it is none, or that of a manifest.
std::string result_name(const std::filesystem::path& file, const std::string& otherwise);

/// The folder of a result leads elsewhere now, or nowhere.
struct FolderGone : FileError {
    using FileError::FileError;
};

/// Claims a folder for a result, for this process alone. It must be new, empty, or hold an earlier result, which is cleared only by
/// `begin`. A folder made here and never begun is taken away again, unless somebody has put something into it, so that a
/// refused run leaves nothing behind.
class OutputFolder {
  public:
    /// Throws InputError when the folder cannot be used, saying why: another process that writes into it is one reason.
    explicit OutputFolder(const std::filesystem::path& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Clears an earlier result, a series with its members, and keeps the folder. Trials and their ledger stay: they answer only the
    /// question that they were asked. An earlier manifest stays with the status "cleared", until another one is written. Folders of these
    /// members stay, empty. Throws FolderGone.
    void begin(const std::vector<std::string>& members = {});
    /// Keeps the folder with all that an unfinished result has left there but halves of files.
    void go_on();

    /// Throws FolderGone where the folder's path leads to another one now than that claimed, or to none: it was moved or removed, and what
    /// was written into it went with it.
    void look() const;
    /// Writes manifest.json. Throws FileError.
    void write_manifest(const input::Json& manifest) const;

    /// The path of a file in it, which is about to be used: looks. Throws FolderGone.
    [[nodiscard]] std::string file(const std::string& name) const;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    [[nodiscard]] bool still_there() const;
    void take_away() const;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_; // folders that did not exist before, the innermost first
    int lock_ = -1;                           // held on the folder itself: it leaves no file, and goes with the process
    bool begun_ = false;
};

/// Carries work out in a folder. What the machine does not let it write is a FileError that also says how to go on; whatever fails because
/// the folder has gone is a FolderGone.
template <class Work> auto with_way_on(const OutputFolder& folder, const Work& work) {
    const auto way_on = [&](const std::string& what) {
        return FileError(what + "; once that is mended, go on with: proveta resume " + folder.path().string());
    };
    try {
        return work();
    } catch (const FileError& e) {
        folder.look();
        throw way_on(e.what());
    } catch (const std::filesystem::filesystem_error& e) {
        folder.look();
        throw way_on(e.path1().string() + ": " + e.code().message());
    } catch (...) {
        folder.look();
        throw;
    }
}

} // namespace proveta
