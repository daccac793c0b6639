#include "lab/verification/case.hpp"

#include <cmath>

namespace proveta::verification {

bool Check::holds() const {
    switch (how) {
    case Compare::relative: return std::fabs(found - expected) <= tolerance * std::fabs(expected);
    case Compare::absolute: return std::fabs(found - expected) <= tolerance;
    case Compare::at_most: return found <= expected;
    case Compare::at_least: return found >= expected;
    case Compare::reported: return std::isfinite(found);
    }
    return false;
}

double Check::error() const {
    const double difference = found - expected;
    return how == Compare::absolute || expected == 0.0 ? difference : difference / std::fabs(expected);
}

} // namespace proveta::verification
