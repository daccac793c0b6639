// What a figure shows, in words with numbers: for who cannot see it.
#pragma once

#include <string>

#include "reports/record/record.hpp"

namespace proveta::report {

std::string describe(const Plot& plot);
std::string describe(const Rose& rose);
std::string describe(const Picture& picture);

} // namespace proveta::report
