#include "tests/fuzz/scratch.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace proveta::fuzz {

namespace {

namespace fs = std::filesystem;

class Folder {
  public:
    Folder() {
        const fs::path memory = "/dev/shm";
        path_ = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) / ("proveta-fuzz-" + std::to_string(getpid()));
        fs::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

} // namespace

std::string scratch_file(const std::string& name, std::string_view bytes) {
    static const Folder folder;
    const std::string file = (folder.path() / name).string();
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
        std::abort(); // no room: nothing that the readers could be blamed for
    }
    return file;
}

} // namespace proveta::fuzz
