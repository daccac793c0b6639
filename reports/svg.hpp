// Plots and pictures as SVG text.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta::report {

/// A text with the characters that mean something in HTML and SVG replaced.
std::string escape(const std::string& text);

std::string to_svg(const Plot& plot);
std::string to_svg(const Picture& picture);

} // namespace proveta::report
