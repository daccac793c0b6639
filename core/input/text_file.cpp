#include "core/input/text_file.hpp"

#include <algorithm>
#include <fmt/format.h>

#include <boost/locale/encoding_errors.hpp>
#include <boost/locale/encoding_utf.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/input/large_pages.hpp"

namespace proveta::input {

namespace {

std::runtime_error too_long(const std::string& file, std::uintmax_t most) {
    return std::runtime_error(fmt::format("{}: more than {} MiB", file, most >> 20));
}

} // namespace

void require_size(const std::string& file, std::uintmax_t most) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::is_directory(file, error)) {
        throw std::runtime_error(file + ": a folder");
    }
    if (fs::is_regular_file(file, error) && fs::file_size(file, error) > most) {
        throw too_long(file, most);
    }
}

std::string read_text(const std::string& file, std::uintmax_t most) {
    require_size(file, most);
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw std::runtime_error(file + ": cannot be read");
    }
    std::string text;
    std::error_code unknown; // as of a pipe
    if (const auto size = std::filesystem::file_size(file, unknown); !unknown) {
        text.reserve(size + 1); // of no more than `most`, or of a few bytes where the file is none
        wish_large_pages(text);
    }
    std::array<char, 65536> piece;
    while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
        text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > most) {
            throw too_long(file, most);
        }
    }
    if (text.starts_with("\x1f\x8b")) {
        throw std::runtime_error(file + ": compressed by gzip; unpack it first");
    }
    if (text.starts_with("PK\x03\x04")) {
        throw std::runtime_error(file + ": a zip archive, such as a spreadsheet; unpack it, or save the table as CSV");
    }
    return text;
}

std::string as_utf8(std::string text, const std::string& file) {
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.erase(0, 3);
        return text;
    }
    const bool little = text.starts_with("\xFF\xFE");
    if (!little && !text.starts_with("\xFE\xFF")) {
        return text;
    }
    std::u16string wide;
    for (std::size_t k = 2; k + 1 < text.size(); k += 2) {
        const auto low = static_cast<unsigned char>(text[little ? k : k + 1]);
        const auto high = static_cast<unsigned char>(text[little ? k + 1 : k]);
        wide += static_cast<char16_t>(low + 256 * high);
    }
    try {
        if (text.size() % 2 != 0) {
            throw boost::locale::conv::conversion_error();
        }
        return boost::locale::conv::utf_to_utf<char>(wide, boost::locale::conv::stop);
    } catch (const boost::locale::conv::conversion_error&) {
        throw std::runtime_error(file + ": begins as UTF-16 and is cut short or broken");
    }
}

std::string utf8_of_latin1(std::string text) {
    const auto beyond = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
    if (std::none_of(text.begin(), text.end(), beyond)) {
        return text;
    }
    try {
        (void)boost::locale::conv::utf_to_utf<char32_t>(text, boost::locale::conv::stop);
        return text;
    } catch (const boost::locale::conv::conversion_error&) {
        std::u32string wide;
        for (const char c : text) {
            const auto byte = static_cast<unsigned char>(c);
            wide += byte == 0x89 ? U'\u2030' : static_cast<char32_t>(byte);
        }
        return boost::locale::conv::utf_to_utf<char>(wide);
    }
}

} // namespace proveta::input
