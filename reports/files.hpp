// Files that are either whole or absent.
#pragma once

#include <string>

#include "core/input/json.hpp"
#include "reports/record/record.hpp"

namespace proveta::report {

/// Writes text to a file, see `write_whole`. Throws FileError.
void write_file(const std::string& file, const std::string& text);

/// A table as CSV: '#' lines with the notes and the meaning of the columns, a heading row, numbers with 17 significant digits.
std::string to_csv(const Table& table);

/// A table of texts as CSV: its title as a '#' line, then its rows; cells with a comma, a quote or a line's end are quoted (RFC 4180).
std::string to_csv(const TextTable& table);

void write_json(const std::string& file, const input::Json& json);

} // namespace proveta::report
