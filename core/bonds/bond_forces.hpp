// One pass over all bonds: kinematics, law, forces, dissipation.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// A bond that failed in this step.
struct BondFailure {
    std::uint32_t bond;
    FailureMode mode;
};

/// Advances every bond by one step of dt seconds from the spheres' positions and (half a step older) velocities, and fills
/// `bonds.forces`. With `measure`, also the output arrays of Bonds. Failures are appended in bond order. Sums are formed block by block
/// in a fixed order, so nothing depends on the number of threads or on the width of the processor's vectors.
BondDissipation bond_forces(const Spheres& spheres, Bonds& bonds, double dt, bool measure, std::vector<BondFailure>& failures);

/// The vector width that `bond_forces` uses on this machine: "AVX-512", "AVX2" or "baseline".
std::string bond_kernel_name();

} // namespace proveta
