#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        // chapter 5
        regular_lattice(), dempack_bond(), weak_equals_none(), released_law(),
        polygon_areas(),   area_models(),  area_partition(),   elastic_study(),
    };
    return all;
}

} // namespace proveta::verification
