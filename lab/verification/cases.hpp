// The cases, one file each in this folder, in the order of the thesis.
#pragma once

#include "lab/verification/case.hpp"

namespace proveta::verification {

// Chapter 5
Case polygon_areas();
Case dempack_bond();
Case two_body_energy();
Case weak_equals_none();
Case bonded_cantilever();
Case hydrostatic_criterion();
Case released_law();

} // namespace proveta::verification
