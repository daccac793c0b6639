#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    // clang-format off
    static const std::vector<Case> all{
        polygon_areas(),
        dempack_bond(),
        two_body_energy(),
        weak_equals_none(),
        bonded_cantilever(),
        released_law(),
        hydrostatic_criterion(),
    };
    // clang-format on
    return all;
}

} // namespace proveta::verification
