// What a triaxial test on loose matter tells: friction, dilation, stiffness.
#pragma once

#include <vector>

#include "lab/membrane.hpp"
#include "lab/protocols/protocol.hpp"

namespace proveta {

/// Results of an axial loading at a constant pressure in Pa on a membrane.
std::vector<report::Scalar> granular_results(const Measured& measured, double pressure, const MembraneInput& membrane);

} // namespace proveta
