#include "core/files/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace proveta {

namespace {

// An open file, closed at the end of its scope.
class Descriptor {
  public:
    Descriptor(const std::string& file, int flags) : id_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int id() const { return id_; }
    [[nodiscard]] bool good() const { return id_ >= 0; }
    bool close() {
        const int closed = id_ >= 0 ? ::close(id_) : 0;
        id_ = -1;
        return closed == 0;
    }

  private:
    int id_;
};

// What a file is called until it is whole.
std::string partial_name(const std::string& file) { return file + ".partial"; }

[[noreturn]] void fail(const std::string& file, const std::string& partial) {
    const std::string why = std::strerror(errno);
    std::remove(partial.c_str());
    throw FileError(file + " cannot be written: " + why);
}

bool write_all(int to, const char* data, std::size_t size) {
    while (size > 0) {
        const ssize_t n = ::write(to, data, size);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return false;
        }
        data += n;
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

} // namespace

void move_into_place(const std::string& from, const std::string& file) {
    if (std::rename(from.c_str(), file.c_str()) != 0) {
        fail(file, from);
    }
    const auto folder = std::filesystem::path(file).parent_path();
    const Descriptor at(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
    if (at.good()) { // a file system that cannot do it is no reason to fail
        ::fsync(at.id());
    }
}

void write_whole(const std::string& file, const void* data, std::size_t size) {
    Descriptor out(partial_name(file), O_WRONLY | O_CREAT | O_TRUNC);
    if (!out.good() || !write_all(out.id(), static_cast<const char*>(data), size) || ::fsync(out.id()) != 0 || !out.close()) {
        fail(file, partial_name(file));
    }
    move_into_place(partial_name(file), file);
}

void require_writable(const std::string& file) {
    const std::string partial = partial_name(file);
    if (std::error_code unseen; std::filesystem::is_directory(file, unseen)) {
        errno = EISDIR;
        fail(file, partial);
    }
    if (const Descriptor out(partial, O_WRONLY | O_CREAT); !out.good()) {
        fail(file, partial);
    }
    std::remove(partial.c_str());
}

void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directory(folder, error);
    if (error) {
        throw FileError(folder + " cannot be made: " + error.message());
    }
}

} // namespace proveta
