#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        polygon_areas(),
        dempack_bond(),
        weak_equals_none(),
        released_law(),
    };
    return all;
}

} // namespace proveta::verification
