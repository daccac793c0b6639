// A material for cases and tests about everything but strength.
#pragma once

#include "core/laws/material.hpp"

namespace proveta::verification {

/// A material whose bonds never break or yield. young: E0, Pa.
inline Material unbreakable(double young = 28.0e9) {
    Material m;
    m.young_modulus = young;
    auto& law = m.as<Dempack>();
    law.sigma_f = 1e30;
    law.tau_f = 1e30;
    law.lcs[0] = 1e30;
    law.lcs[1] = 2e30;
    law.lcs[2] = 3e30;
    return m;
}

} // namespace proveta::verification
