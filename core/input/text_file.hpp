// Text files of users, which may be anything.
#pragma once

#include <cstdint>
#include <string>

namespace proveta::input {

constexpr std::uintmax_t longest_table = std::uintmax_t{64} << 20; ///< of measurements, bytes: some million rows

/// The whole of a file or a pipe. Throws std::runtime_error, naming it, when it cannot be read, is a folder, is compressed, or does not end
/// within `most` bytes, which is all that is read of it then.
std::string read_text(const std::string& file, std::uintmax_t most);

/// Throws std::runtime_error, naming it, for a folder and for a file of more than `most` bytes, of which nothing is read.
void require_size(const std::string& file, std::uintmax_t most);

/// Text without a byte-order mark; UTF-16, told by its mark, made UTF-8. Throws std::runtime_error, naming the file, where that is cut or
/// broken.
std::string as_utf8(std::string text, const std::string& file);

/// Text that is no UTF-8, as older measuring programs and spreadsheets write it, taken for Latin-1 (Windows-1252 where it has a sign of its
/// own for per mille) and made UTF-8; UTF-8 stays as it is.
std::string utf8_of_latin1(std::string text);

} // namespace proveta::input
