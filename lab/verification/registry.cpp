#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        polygon_areas(),
    };
    return all;
}

} // namespace proveta::verification
