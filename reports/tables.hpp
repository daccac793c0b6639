// Tables of a page.
#pragma once

#include <string>
#include <vector>

#include "reports/record/record.hpp"

namespace proveta::report {

/// A table under its caption; the first column heads the rows.
std::string table(const TextTable& table);

/// Results with unit and formula.
std::string table(const std::vector<Scalar>& results);

} // namespace proveta::report
