// The cases, one file each in this folder, in the order of the thesis.
#pragma once

#include "lab/verification/case.hpp"

namespace proveta::verification {

// Chapter 5
Case regular_lattice();
Case dempack_bond();
Case weak_equals_none();
Case released_law();
Case polygon_areas();
Case area_models();
Case area_partition();
Case elastic_study();

} // namespace proveta::verification
