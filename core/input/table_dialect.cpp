#include "core/input/table_dialect.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/input/words.hpp"

namespace proveta::input {

namespace {

std::string_view unquoted(std::string_view s) {
    return s.size() > 1 && (s.front() == '"' || s.front() == '\'') && s.back() == s.front() ? trimmed(s.substr(1, s.size() - 2)) : s;
}

bool is_missing(std::string_view s) {
    static constexpr std::array words{"",     "-",   "--",   "NaN",  "nan",  "NAN",     "NA",      "N/A", "n/a",
                                      "#N/A", "#NA", "null", "NULL", "None", "#VALUE!", "#DIV/0!", "?",   "*"};
    return std::find(words.begin(), words.end(), s) != words.end();
}

const char* name_of(char separator) {
    return separator == ';' ? "semicolons" : separator == ',' ? "commas" : separator == '\t' ? "tabs" : "blanks";
}

} // namespace

Cell TableDialect::kind(std::string_view cell, double& value) const {
    const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
    const char* end = cell.data() + cell.size();
    const fast_float::parse_options options(fast_float::chars_format::general, decimal);
    const auto found = fast_float::from_chars_advanced(begin, end, value, options);
    if (found.ec == std::errc() && found.ptr == end && std::isfinite(value)) {
        return Cell::number;
    }
    return is_missing(cell) ? Cell::missing : Cell::text;
}

bool TableDialect::read_row(std::string_view text, std::size_t& at, std::vector<double>& row) const {
    if (separator == decimal) { // what belongs together stands in quotes
        return false;
    }
    const char* here = text.data() + at;
    const char* const end = text.data() + text.size();
    const fast_float::parse_options options(fast_float::chars_format::general, decimal);
    const auto pass_blanks = [&] {
        while (here < end && (*here == ' ' || (*here == '\t' && separator != '\t'))) {
            ++here;
        }
    };
    for (double& value : row) {
        if (&value != &row.front()) {
            if (separator != ' ') {
                pass_blanks();
            }
            if (here == end || (*here != separator && !(separator == ' ' && *here == '\t'))) {
                return false;
            }
            ++here;
        }
        pass_blanks();
        const auto found = fast_float::from_chars_advanced(here, end, value, options);
        if (found.ec != std::errc() || !std::isfinite(value)) {
            return false;
        }
        here = found.ptr;
    }
    pass_blanks();
    if (here < end && *here != '\n' && *here != '\r') {
        return false;
    }
    at = static_cast<std::size_t>(here - text.data());
    at += text.substr(at, 2) == "\r\n" ? 2 : 1;
    return true;
}

bool TableDialect::split(std::string_view line, std::vector<std::string_view>& cells) const {
    cells.clear();
    const bool blanks = separator == ' ';
    const auto separates = [&](char c) { return blanks ? c == ' ' || c == '\t' : c == separator; };
    std::size_t at = 0;
    while (true) {
        if (blanks) {
            at = line.find_first_not_of(" \t", at);
            if (at == std::string_view::npos) {
                return true;
            }
        }
        const std::size_t start = at;
        std::size_t quote = line.find_first_not_of(" \t", at);
        if (quote != std::string_view::npos && line[quote] == '"' && !separates('"')) {
            // A doubled quote stands for one within the cell and does not end it.
            for (++quote;; quote += 2) {
                quote = line.find('"', quote);
                if (quote == std::string_view::npos) {
                    return false;
                }
                if (line.substr(quote, 2) != "\"\"") {
                    break;
                }
            }
            at = quote;
        }
        while (at < line.size() && !separates(line[at])) {
            ++at;
        }
        cells.push_back(unquoted(trimmed(line.substr(start, at - start))));
        if (at >= line.size()) {
            return true;
        }
        ++at;
    }
}

TableDialect dialect_of(const std::vector<std::string_view>& lines) {
    // Among equals the first.
    static constexpr std::array<TableDialect, 8> known{
        {{';', '.'}, {'\t', '.'}, {',', '.'}, {' ', '.'}, {';', ','}, {'\t', ','}, {' ', ','}, {',', ','}}}; // the last one: in quotes
    std::ptrdiff_t best = std::numeric_limits<std::ptrdiff_t>::min();
    TableDialect chosen;
    for (const TableDialect& candidate : known) {
        std::map<std::size_t, std::ptrdiff_t> numbers; // cells that are numbers less those that are text, by the number of cells in a line
        std::vector<std::string_view> cells;
        double value = 0.0;
        for (const auto line : lines) {
            if (candidate.split(line, cells) && cells.size() > 1) {
                for (const auto cell : cells) {
                    const Cell is = candidate.kind(cell, value);
                    numbers[cells.size()] += is == Cell::number ? 1 : is == Cell::text ? -1 : 0;
                }
            }
        }
        for (const auto& [count, found] : numbers) {
            if (found > best) {
                best = found;
                chosen = candidate;
            }
        }
    }
    return chosen;
}

std::string TableDialect::text() const {
    return fmt::format("{} separate, decimals have a {}", name_of(separator), decimal == ',' ? "comma" : "point");
}

} // namespace proveta::input
