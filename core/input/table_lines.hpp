// The first lines of a text table, split into cells: what they say about the rest.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/input/table_dialect.hpp"

namespace proveta::input {

using TableLine = std::vector<std::string_view>;

/// "x [mm] y [mm]" in a file where blanks separate: a unit belongs to the word before it. Where that does not give as many cells as there
/// are columns, they stay as they were.
void rejoin(TableLine& cells, std::size_t width);

/// Whether a cell is a number.
bool has_number(const TableLine& cells, const TableDialect& dialect);

/// How many columns most lines with a number have, among equals the first; 0 where there is none.
std::size_t width_of(const std::vector<TableLine>& rows, const TableDialect& dialect);

/// Which columns hold numbers, or nothing, in at least half of the lines of that width.
std::vector<bool> columns_of_numbers(const std::vector<TableLine>& rows, std::size_t width, const TableDialect& dialect);

/// The first word of the last of the lines where numbers are looked for in vain, as the end of a sentence; lines: their numbers.
std::string first_words(const std::vector<TableLine>& rows, const std::vector<std::size_t>& lines, const TableDialect& dialect);

} // namespace proveta::input
