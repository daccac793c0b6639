// The cases, one file each in this folder, in the order of the thesis.
#pragma once

#include "lab/verification/case.hpp"

namespace proveta::verification {

// Chapter 5
Case polygon_areas();

} // namespace proveta::verification
