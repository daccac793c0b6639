// Figures of a page: the drawing, its key, its caption, and the numbers for the script.
#pragma once

#include <string>
#include <string_view>

#include "reports/record/record.hpp"

namespace proveta::report {

/// A plot with its curves' values, which the script reads, as JSON in which no '<' stands.
std::string figure(const Plot& plot);
std::string figure(const Rose& rose);
std::string figure(const Picture& picture);
std::string figure(const Portrait& portrait);

/// Bytes in base 64.
std::string base64(std::string_view bytes);

} // namespace proveta::report
