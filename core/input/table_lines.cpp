#include "core/input/table_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace proveta::input {

void rejoin(TableLine& cells, std::size_t width) {
    TableLine joined;
    for (const auto cell : cells) {
        if (!joined.empty() && (cell.starts_with('[') || cell.starts_with('('))) {
            joined.back() = {joined.back().data(), static_cast<std::size_t>(cell.data() + cell.size() - joined.back().data())};
        } else {
            joined.push_back(cell);
        }
    }
    if (joined.size() == width) {
        cells = std::move(joined);
    }
}

bool has_number(const TableLine& cells, const TableDialect& dialect) {
    double value = 0.0;
    return std::any_of(cells.begin(), cells.end(), [&](auto cell) { return dialect.kind(cell, value) == Cell::number; });
}

std::size_t width_of(const std::vector<TableLine>& rows, const TableDialect& dialect) {
    std::map<std::size_t, std::size_t> lines_with;
    for (const auto& cells : rows) {
        lines_with[cells.size()] += has_number(cells, dialect) ? 1 : 0;
    }
    std::size_t width = 0;
    for (const auto& cells : rows) {
        width = lines_with[cells.size()] > (width > 0 ? lines_with[width] : 0) ? cells.size() : width;
    }
    return width;
}

std::string first_words(const std::vector<TableLine>& rows, const std::vector<std::size_t>& lines, const TableDialect& dialect) {
    double value = 0.0;
    for (std::size_t k = rows.size(); k-- > 0;) {
        for (const auto cell : rows[k]) {
            if (dialect.kind(cell, value) == Cell::text) {
                return fmt::format("; in line {}, \"{}\" is no number ({})", lines[k], cell.substr(0, 40), dialect.text());
            }
        }
    }
    return "";
}

std::vector<bool> columns_of_numbers(const std::vector<TableLine>& rows, std::size_t width, const TableDialect& dialect) {
    std::vector<std::size_t> numbers(width, 0);
    std::size_t alike = 0;
    double value = 0.0;
    for (const auto& cells : rows) {
        alike += cells.size() == width ? 1 : 0;
        for (std::size_t c = 0; c < width && cells.size() == width; ++c) {
            numbers[c] += dialect.kind(cells[c], value) != Cell::text ? 1 : 0;
        }
    }
    std::vector<bool> out;
    for (const auto n : numbers) {
        out.push_back(2 * n >= alike);
    }
    return out;
}

} // namespace proveta::input
