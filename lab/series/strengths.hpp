// Strengths of a series' members seen together.
#pragma once

#include <optional>
#include <vector>

#include "lab/series/member_result.hpp"
#include "lab/series/strength_envelope.hpp"

namespace proveta {

/// The envelope through the strengths of the complete members that report a "strength": at their "confining_pressure", or unconfined where
/// they report none. A "tensile_strength" t is the point (sigma_3, sigma_1) = (-t, 0), a "splitting_strength" t the point (-t, 3 t): the
/// stresses in the middle of an elastic disc (G. Hondros, Aust. J. Appl. Sci. 10 (1959) 243). The line of (5.22) is drawn when all these
/// members have the same bonds, Attard and Setunge's estimate when there is an unconfined member. None with fewer than two pressures.
std::optional<StrengthEnvelope> envelope_of(const std::vector<MemberResult>& members);

/// Ratios of mean strengths: unconfined over splitting, unconfined over direct tensile, splitting over direct tensile; those of which the
/// series has both.
std::vector<report::Scalar> strength_ratios(const std::vector<MemberResult>& members);

} // namespace proveta
