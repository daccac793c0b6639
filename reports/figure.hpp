// Figures of a page: the drawing, its key, its caption, and the numbers for the script.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta::report {

/// A plot with its curves' values, which the script reads, as JSON in which no '<' stands.
std::string figure(const Plot& plot);
std::string figure(const Rose& rose);
std::string figure(const Picture& picture);

} // namespace proveta::report
