// Numbers from CSV files: the program's own, and measured curves of others.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta {

/// Reads numbers separated by commas, semicolons, tabs or spaces. '#' lines are comments; a first row that is not numbers names the
/// columns, which are otherwise called "1", "2" and so on. Columns have their whole heading as name. Throws std::runtime_error naming file,
/// line and what is wrong.
report::Table read_csv(const std::string& file);

} // namespace proveta
