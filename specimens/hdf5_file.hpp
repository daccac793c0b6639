// A thin, safe layer over the HDF5 C library: files, arrays and texts by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace proveta {

/// An HDF5 file that is made anew, in memory until `close` puts all of it on disk at once, or one open for reading. All failures throw
/// std::runtime_error with the file's name, those of the disk FileError. Arrays are one-dimensional; types are those overloaded below.
class Hdf5File {
  public:
    enum class Mode { create, read };

    Hdf5File(const std::string& path, Mode mode);
    ~Hdf5File();
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;

    void put(const std::string& name, const std::vector<double>& values);
    void put(const std::string& name, const std::vector<std::int32_t>& values);
    void put(const std::string& name, const std::vector<std::uint8_t>& values);
    void put(const std::string& name, double value) { put(name, std::vector<double>{value}); }
    void put(const std::string& name, std::int64_t value);
    void put(const std::string& name, const std::string& text) { put_text(name, text); }
    void put_text(const std::string& name, const std::string& text);

    [[nodiscard]] bool has(const std::string& name) const;
    void get(const std::string& name, std::vector<double>& values) const;
    void get(const std::string& name, std::vector<std::int32_t>& values) const;
    void get(const std::string& name, std::vector<std::uint8_t>& values) const;
    void get(const std::string& name, double& value) const;
    void get(const std::string& name, std::int64_t& value) const;
    void get(const std::string& name, std::string& text) const { text = get_text(name); }
    [[nodiscard]] std::string get_text(const std::string& name) const;

    /// Writes the file that was made, whole or not at all. Without it nothing is written.
    void close();

  private:
    void put_raw(const std::string& name, const void* data, std::size_t n, std::int64_t type, bool compress);
    [[nodiscard]] std::size_t length(const std::string& name) const;
    void get_raw(const std::string& name, void* data, std::size_t n, std::int64_t type) const;

    std::string path_;
    std::int64_t file_ = -1;
};

} // namespace proveta
