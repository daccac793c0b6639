#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        regular_lattice(), polygon_areas(), area_models(), area_partition(), elastic_study(),
    };
    return all;
}

} // namespace proveta::verification
