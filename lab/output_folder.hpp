// The folder that a run writes into.
#pragma once

#include <filesystem>
#include <string>

namespace proveta {

/// Claims a folder for a result, for this process alone. It must be new, empty, or hold an earlier result, which is cleared only by
/// `begin`. A folder made here and never begun is taken away again, so that a refused run leaves nothing behind.
class OutputFolder {
  public:
    /// Throws InputError when the folder cannot be used, saying why: another process that writes into it is one reason.
    explicit OutputFolder(const std::filesystem::path& path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Clears an earlier result, a series with its members, and keeps the folder. Trials and their ledger stay: they answer only the
    /// question that they were asked.
    void begin();
    /// Keeps the folder with all that an unfinished result has left there but halves of files.
    void go_on();

    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::filesystem::path first_made_; // topmost folder that did not exist before
    int lock_ = -1;                    // held on the folder itself: it leaves no file, and goes with the process
    bool begun_ = false;
};

} // namespace proveta
