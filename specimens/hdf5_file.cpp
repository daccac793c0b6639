#include "specimens/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "core/files/whole_file.hpp"
#include "core/hash.hpp"
#include "specimens/memory.hpp"

namespace proveta {

namespace {

constexpr hsize_t largest_chunk = 65536;

// Closes an HDF5 handle at the end of its scope.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    [[nodiscard]] hid_t id() const { return id_; }
    [[nodiscard]] bool good() const { return id_ >= 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

// A file of this program ends, behind what HDF5 reads of it, with a mark that holds a hash of all before: what a disk or a cable did to it
// is found before the library, which trusts its own records, looks at any.
constexpr std::string_view mark_begins = "\nproveta hash ";
constexpr std::size_t mark_size = mark_begins.size() + 16;

std::string mark_of(const Hash& hash) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash.value()));
    return std::string(mark_begins) + digits;
}

// Throws when a file's mark does not agree with the rest. Other programs' files have none.
void check_mark(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
    const std::streamoff body = size - static_cast<std::streamoff>(mark_size);
    if (body <= 0) {
        return;
    }
    char mark[mark_size];
    in.seekg(body);
    if (!in.read(mark, mark_size) || !std::string_view(mark, mark_size).starts_with(mark_begins)) {
        return;
    }
    Hash hash;
    char buffer[65536];
    in.seekg(0);
    for (std::streamoff left = body; left > 0 && in.read(buffer, std::min<std::streamoff>(left, sizeof buffer)); left -= in.gcount()) {
        hash.mix(buffer, static_cast<std::size_t>(in.gcount()));
    }
    if (mark_of(hash) != std::string_view(mark, mark_size)) {
        throw std::runtime_error(path + ": damaged: its content does not agree with its hash");
    }
}

// Whether an array is stored as this program stores them: numbers, in the file itself, in pieces of moderate size, of no filters but the
// two that it uses. What else HDF5 can do takes its library to other files, and to sizes that a file only claims.
bool plain(const Handle& set) {
    const Handle type(H5Dget_type(set.id()), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type.id());
    const Handle layout(H5Dget_create_plist(set.id()), H5Pclose);
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || H5Tget_size(type.id()) > sizeof(double) || H5Pget_external_count(layout.id()) != 0) {
        return false;
    }
    hsize_t chunk = 0;
    if (H5Pget_layout(layout.id()) == H5D_CHUNKED && (H5Pget_chunk(layout.id(), 1, &chunk) != 1 || chunk > largest_chunk)) {
        return false;
    }
    const int filters = H5Pget_nfilters(layout.id());
    for (int k = 0; k < filters; ++k) {
        unsigned flags = 0;
        std::size_t values = 0;
        const H5Z_filter_t filter = H5Pget_filter2(layout.id(), static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr, nullptr);
        if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE) {
            return false;
        }
    }
    return filters >= 0 && H5Pget_layout(layout.id()) != H5D_VIRTUAL;
}

} // namespace

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // failures are reported by exceptions, not on stderr
    if (std::error_code error; mode == Mode::read && !std::filesystem::is_regular_file(path, error)) {
        throw std::runtime_error(path + ": no such file"); // HDF5 would wait for a pipe
    }
    if (mode == Mode::read && ::access(path.c_str(), R_OK) != 0) {
        throw std::runtime_error(fmt::format("{}: {}", path, std::strerror(errno)));
    }
    if (mode == Mode::create) {
        // The library does not stand a disk that fills up under it: it never sees one.
        const Handle memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        constexpr std::size_t growth = 1u << 20;
        H5Pset_fapl_core(memory.id(), growth, false);
        file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, memory.id());
    } else {
        check_mark(path);
        // Files are written elsewhere and renamed: one that is there is whole, whoever holds a lock on it.
        const Handle unlocked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
        H5Pset_file_locking(unlocked.id(), false, true);
        file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, unlocked.id());
    }
    if (file_ < 0) {
        throw std::runtime_error(path + (mode == Mode::create ? ": cannot be made" : ": cut short, or not an HDF5 file"));
    }
}

Hdf5File::~Hdf5File() {
    if (file_ >= 0) {
        H5Fclose(file_);
    }
}

void Hdf5File::close() {
    H5Fflush(file_, H5F_SCOPE_GLOBAL);
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    std::vector<char> bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    if (size <= 0 || H5Fget_file_image(file_, bytes.data(), bytes.size()) != size) {
        throw std::runtime_error(path_ + ": cannot be made");
    }
    Hash hash;
    hash.mix(bytes.data(), bytes.size());
    const std::string mark = mark_of(hash);
    bytes.insert(bytes.end(), mark.begin(), mark.end());
    write_whole(path_, bytes.data(), bytes.size());
}

void Hdf5File::put_raw(const std::string& name, const void* data, std::size_t n, std::int64_t type, bool compress) {
    const hsize_t size = n;
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (compress && n > 64) {
        const hsize_t chunk = n < largest_chunk ? n : largest_chunk;
        H5Pset_chunk(layout.id(), 1, &chunk);
        H5Pset_shuffle(layout.id());
        H5Pset_deflate(layout.id(), 1);
    }
    const Handle set(H5Dcreate2(file_, name.c_str(), type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT), H5Dclose);
    if (!set.good() || (n > 0 && H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)) {
        throw std::runtime_error(path_ + ": " + name + " cannot be written");
    }
}

void Hdf5File::put(const std::string& name, const std::vector<double>& v) { put_raw(name, v.data(), v.size(), H5T_NATIVE_DOUBLE, true); }
void Hdf5File::put(const std::string& name, const std::vector<std::int32_t>& v) {
    put_raw(name, v.data(), v.size(), H5T_NATIVE_INT32, true);
}
void Hdf5File::put(const std::string& name, const std::vector<std::uint8_t>& v) {
    put_raw(name, v.data(), v.size(), H5T_NATIVE_UINT8, true);
}
void Hdf5File::put(const std::string& name, std::int64_t value) { put_raw(name, &value, 1, H5T_NATIVE_INT64, false); }
void Hdf5File::put_text(const std::string& name, const std::string& text) {
    put(name, std::vector<std::uint8_t>(text.begin(), text.end()));
}

bool Hdf5File::has(const std::string& name) const {
    H5L_info_t link;
    return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0 && H5Lget_info(file_, name.c_str(), &link, H5P_DEFAULT) >= 0 &&
           link.type == H5L_TYPE_HARD; // others lead to other files
}

std::size_t Hdf5File::length(const std::string& name) const {
    const Handle set(has(name) ? H5Dopen2(file_, name.c_str(), H5P_DEFAULT) : -1, H5Dclose);
    if (!set.good()) {
        throw std::runtime_error(path_ + ": has no \"" + name + "\"");
    }
    const Handle space(H5Dget_space(set.id()), H5Sclose);
    const hssize_t n = H5Sget_simple_extent_npoints(space.id());
    if (H5Sget_simple_extent_ndims(space.id()) != 1 || n < 0 || n > (hssize_t{1} << 31) || !plain(set)) {
        throw std::runtime_error(path_ + ": \"" + name + "\" has an unexpected shape");
    }
    constexpr double densest = 1100.0; // bytes that deflate can make of one
    const double bytes = static_cast<double>(n) * sizeof(double);
    if (bytes > densest * static_cast<double>(std::filesystem::file_size(path_)) || bytes > static_cast<double>(available_memory())) {
        throw std::runtime_error(fmt::format("{}: \"{}\" announces {} numbers, more than the file or the memory can hold", path_, name, n));
    }
    return static_cast<std::size_t>(n);
}

void Hdf5File::get_raw(const std::string& name, void* data, std::size_t n, std::int64_t type) const {
    const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set.good() || (n > 0 && H5Dread(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)) {
        throw std::runtime_error(path_ + ": \"" + name + "\" cannot be read");
    }
}

void Hdf5File::get(const std::string& name, std::vector<double>& v) const {
    v.resize(length(name));
    get_raw(name, v.data(), v.size(), H5T_NATIVE_DOUBLE);
}

void Hdf5File::get(const std::string& name, std::vector<std::int32_t>& v) const {
    v.resize(length(name));
    get_raw(name, v.data(), v.size(), H5T_NATIVE_INT32);
}

void Hdf5File::get(const std::string& name, std::vector<std::uint8_t>& v) const {
    v.resize(length(name));
    get_raw(name, v.data(), v.size(), H5T_NATIVE_UINT8);
}

void Hdf5File::get(const std::string& name, double& value) const {
    std::vector<double> v;
    get(name, v);
    if (v.size() != 1) {
        throw std::runtime_error(path_ + ": \"" + name + "\" is not a single number");
    }
    value = v.front();
}

void Hdf5File::get(const std::string& name, std::int64_t& value) const {
    if (length(name) != 1) {
        throw std::runtime_error(path_ + ": \"" + name + "\" is not a single number");
    }
    get_raw(name, &value, 1, H5T_NATIVE_INT64);
}

std::string Hdf5File::get_text(const std::string& name) const {
    std::vector<std::uint8_t> v;
    get(name, v);
    return {v.begin(), v.end()};
}

} // namespace proveta
