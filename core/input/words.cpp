#include "core/input/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace proveta::input {

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return out;
}

std::string_view trimmed(std::string_view text, std::string_view around) {
    const auto first = text.find_first_not_of(around);
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(around) - first + 1);
}

std::string_view take_line(std::string_view text, std::size_t& at) {
    const std::size_t begin = at;
    std::size_t end = at; // find_first_of() looks each character up, which takes as long as all else that is done to a line
    while (end < text.size() && text[end] != '\n' && text[end] != '\r') {
        ++end;
    }
    at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    return text.substr(begin, end - begin);
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0; at < text.size();) {
        out.push_back(take_line(text, at));
    }
    return out;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t from = line.find_first_not_of(blanks); from < line.size();) {
        const std::size_t to = std::min(line.find_first_of(blanks, from), line.size());
        words.push_back(line.substr(from, to - from));
        from = line.find_first_not_of(blanks, to);
    }
    return words;
}

std::string first_few(const std::vector<std::string>& all, std::string_view between) {
    const std::size_t n = std::min<std::size_t>(all.size(), 5);
    std::string out = fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n), between));
    return n < all.size() ? fmt::format("{}{}...", out, between) : out;
}

std::string shown(std::string_view text) {
    std::string out;
    for (const char c : text.substr(0, 40)) {
        out += c >= ' ' && c <= '~' ? c : '?';
    }
    return '"' + out + (text.size() > 40 ? "...\"" : "\"");
}

} // namespace proveta::input
