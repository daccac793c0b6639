// Small work on text that readers of files have in common.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace proveta::input {

constexpr std::string_view blanks = " \t\r\n\v\f";

/// Letters of ASCII in lower case, all else as it is.
std::string lower_case(std::string_view text);

/// Text without what is in `around` at both its ends; it points into `text`.
std::string_view trimmed(std::string_view text, std::string_view around = blanks);

/// The line of a text that begins at `at`, which then is where the next one begins. Lines end in "\n", "\r\n" or "\r".
std::string_view take_line(std::string_view text, std::size_t& at);

/// All lines of a text; they point into it.
std::vector<std::string_view> lines_of(std::string_view text);

/// What stands between the blanks of a line; it points into it.
std::vector<std::string_view> words_of(std::string_view line);

/// "a, b, c, d, e, ...": the first five.
std::string first_few(const std::vector<std::string>& all, std::string_view between = ", ");

/// Text of a file, in quotes, as it can be shown in a message: 40 characters at most, and "?" for what is none of ASCII's.
std::string shown(std::string_view text);

} // namespace proveta::input
