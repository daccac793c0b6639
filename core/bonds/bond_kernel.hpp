// What the compiled variants of the bond kernel share: their entry points and what one block of bonds gives back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bonds/bond_law.hpp"
#include "core/contacts/pair_kinematics.hpp"

namespace proveta {

constexpr std::uint32_t bond_block = 512; ///< most bonds a block: a multiple of every vector width, small enough to balance threads

/// Energy that left the bonds in one step, by mechanism, J.
struct BondDissipation {
    double damage = 0.0;
    double plastic = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
};

/// Result of one block: its dissipation and the bonds of it that failed, of which there may be as many as it has.
struct BlockResult {
    BondDissipation dissipation;
    std::uint32_t failed = 0;
    std::uint32_t failures[bond_block];
};

/// Bare pointers into the bonds' arrays (core/bonds/bonds.hpp says what they hold).
struct BondView {
    const std::int32_t *i, *j;
    const double *length, *area, *stiffness, *dashpot;
    double* slip[3];
    double *plastic, *damage_n, *damage_t, *damage_work;
    std::uint8_t* mode;
    PairForce* forces;
    double *normal, *shear, *criterion, *stored; ///< only when measuring
    double* rotation[3];                         ///< only of bonds with moments
    double* couple[3];
    bool damped;
};

/// Advances bonds begin to end, which share a law, by dt seconds.
using BondKernel = void (*)(const SphereView&, const BondView&, const BondLaw&, std::size_t begin, std::size_t end, double dt, bool measure,
                            BlockResult&);

// The same source compiled for three instruction sets (core/CMakeLists.txt).
void bond_kernel_baseline(const SphereView&, const BondView&, const BondLaw&, std::size_t, std::size_t, double, bool, BlockResult&);
void bond_kernel_avx2(const SphereView&, const BondView&, const BondLaw&, std::size_t, std::size_t, double, bool, BlockResult&);
void bond_kernel_avx512(const SphereView&, const BondView&, const BondLaw&, std::size_t, std::size_t, double, bool, BlockResult&);

} // namespace proveta
