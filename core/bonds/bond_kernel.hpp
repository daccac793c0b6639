// What the compiled variants of the bond kernel share: their entry points and what one run of bonds gives back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/contacts/pair_kinematics.hpp"
#include "core/laws/bond_laws.hpp"

namespace proveta {

constexpr std::size_t bond_memory = 3; ///< most numbers that a law keeps for a bond besides its slip

/// Energy that left the bonds in one step, by mechanism, J.
struct BondDissipation {
    double damage = 0.0;
    double plastic = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
};

/// Result of one run of bonds: its dissipation and how many of them failed. Which ones is in BondView::failures from the run's begin on.
struct RunResult {
    BondDissipation dissipation;
    std::uint32_t failed = 0;
};

/// Bare pointers into the bonds' arrays (core/bonds/bonds.hpp says what they hold).
struct BondView {
    const std::int32_t *i, *j, *row_j;
    const double *length, *area, *stiffness, *share, *dashpot;
    double* slip[3];
    double* memory[bond_memory]; ///< what the laws remember, in the order of their `members`
    double* damage_work;
    std::uint8_t *mode, *worn;
    std::uint32_t* failures; ///< one a bond
    double* force[3];        ///< this and the next only when measuring
    double *normal, *shear, *criterion, *stored;
    double* rotation[3]; ///< only of bonds with moments
    double* couple[3];
    const double *shift, *shift_before; ///< of the elongation, by the averaged stress (dilatation.hpp); null: none
    const double* volumetric;           ///< e_V of each sphere (volumetric_strain.hpp); null: no law asks for it
    const double* strength;             ///< factor on each bond's strength; null: 1
    bool damped;
};

/// Advances bonds begin to end, which share a law, by dt seconds, and adds their forces to the rows. law: its constants.
using BondKernel = void (*)(const SphereView&, const BondView&, const void* law, const BondBeams&, double* rows, std::size_t begin,
                            std::size_t end, double dt, bool measure, RunResult&);

// The same source compiled for three instruction sets (core/CMakeLists.txt): the loop of each law, in the order of BondLaws.
const BondKernel* bond_kernels_baseline();
const BondKernel* bond_kernels_avx2();
const BondKernel* bond_kernels_avx512();

} // namespace proveta
