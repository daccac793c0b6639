// One pass over the bonds of a block of spheres: kinematics, law, forces, dissipation.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// A bond that failed in this step.
struct BondFailure {
    std::uint32_t bond;
    FailureMode mode;
};

/// Makes room for what a step with or without `measure` writes.
void prepare_bond_forces(Bonds& bonds, bool measure);

/// Advances the bonds of one block of spheres by one step of dt seconds from the spheres' positions and (half a step older) velocities, and
/// adds their forces to the rows of the loads. With `measure`, also the output arrays of Bonds. Failures are appended in bond order.
/// Nothing depends on the width of the processor's vectors, nor on which thread does what: blocks touch no common memory.
BondDissipation bond_forces(const SphereView& spheres, const Bonds& bonds, const BondView& view, std::size_t block, double* rows, double dt,
                            bool measure, std::vector<BondFailure>& failures);

} // namespace proveta
