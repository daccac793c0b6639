#include "core/input/text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace proveta::input {

std::string read_text(const std::string& file, std::uintmax_t most) {
    namespace fs = std::filesystem;
    const auto too_long = [&] { return std::runtime_error(fmt::format("{}: more than {} MiB", file, most >> 20)); };
    std::error_code error;
    if (fs::is_directory(file, error)) {
        throw std::runtime_error(file + ": a folder");
    }
    if (fs::is_regular_file(file, error) && fs::file_size(file, error) > most) {
        throw too_long(); // without reading any of it
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw std::runtime_error(file + ": cannot be read");
    }
    std::string text;
    std::array<char, 65536> piece;
    while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
        text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > most) {
            throw too_long();
        }
    }
    return text;
}

} // namespace proveta::input
