// Tables that the program itself wrote, read back.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta {

/// All columns of a table of numbers, named by their whole headings, or "1", "2" and so on. Throws std::runtime_error naming file, line and
/// what is wrong.
report::Table read_csv(const std::string& file);

} // namespace proveta
