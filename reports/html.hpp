// The report of a run as one self-contained page.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta::report {

/// HTML text without any outside reference; all texts of the record are escaped.
std::string to_html(const Record& record);

} // namespace proveta::report
