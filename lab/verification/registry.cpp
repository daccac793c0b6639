#include "lab/verification/case.hpp"
#include "lab/verification/cases.hpp"

namespace proveta::verification {

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        restitution(),           rolling_resistance(),   parabolic_flight(),    lsd_impact(),    hertz_impact(),
        sphere_between_plates(), damped_critical_step(), cylinder_precession(), polygon_areas(),
    };
    return all;
}

} // namespace proveta::verification
