// What the compiled variants of the bond kernel share: their entry points and what one run of bonds gives back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bonds/bond_law.hpp"
#include "core/contacts/pair_kinematics.hpp"

namespace proveta {

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
    double *plastic, *damage_n, *damage_t, *damage_work;
    std::uint8_t *mode, *worn;
    std::uint32_t* failures; ///< one a bond
    double* force[3];        ///< this and the next only when measuring
    double *normal, *shear, *criterion, *stored;
    double* rotation[3]; ///< only of bonds with moments
    double* couple[3];
    const double *shift, *shift_before; ///< of the elongation, by the averaged stress (dilatation.hpp); null: none
    bool damped;
};

/// Advances bonds begin to end, which share a law, by dt seconds, and adds their forces to the rows.
using BondKernel = void (*)(const SphereView&, const BondView&, const BondLaw&, double* rows, std::size_t begin, std::size_t end, double dt,
                            bool measure, RunResult&);

// The same source compiled for three instruction sets (core/CMakeLists.txt).
void bond_kernel_baseline(const SphereView&, const BondView&, const BondLaw&, double*, std::size_t, std::size_t, double, bool, RunResult&);
void bond_kernel_avx2(const SphereView&, const BondView&, const BondLaw&, double*, std::size_t, std::size_t, double, bool, RunResult&);
void bond_kernel_avx512(const SphereView&, const BondView&, const BondLaw&, double*, std::size_t, std::size_t, double, bool, RunResult&);

} // namespace proveta
