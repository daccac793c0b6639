// The bond network: a fixed list of bonds with a state each, one array per quantity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/bonds/areas.hpp"
#include "core/bonds/bond_kernel.hpp"
#include "core/bonds/dilatation.hpp"
#include "core/bonds/volumetric_strain.hpp"
#include "core/contacts/incidence.hpp"
#include "core/laws/material.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// A run of bonds that share a material pair and whose first spheres are of one block of spheres (core/contacts/loads.hpp).
struct BondBlock {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t group; ///< index into Bonds::groups
};

/// Bonds of a specimen, sorted by the block of sphere i, then by material pair, then by i and j. One entry per bond; SI units.
struct Bonds {
    std::vector<std::int32_t> i, j;          ///< the two spheres, i < j
    std::vector<std::int32_t> row_j;         ///< row of the loads that j's share goes to
    std::vector<double> share;               ///< lever arm of i over the distance, 0 to 1
    std::vector<double> length;              ///< d0, distance at the start, m
    std::vector<double> area;                ///< m2
    std::vector<double> stiffness;           ///< k_n, N/m
    std::vector<double> dashpot;             ///< c_n, N s/m
    std::vector<double> strength;            ///< factor on the strength, where it scatters; else empty
    VectorField slip;                        ///< u_t, elastic tangential displacement, m
    std::vector<double> memory[bond_memory]; ///< what the bonds' laws remember, in the order of their `members`: of each of them the first
                                             ///< is u_p, plastic shortening, m, and the second the damage of an elongated bond, 0 to 1
    std::vector<double> damage_work;         ///< dissipated by damage and failure so far, J
    std::vector<std::uint8_t> mode;          ///< FailureMode
    std::vector<std::uint8_t> worn;          ///< 0 as long as the memory is surely zero, so that it need not be read
    std::vector<std::uint32_t> failures;     ///< scratch of the kernel
    Incidence incidence;                     ///< bonds of each sphere
    VectorField rotation;                    ///< theta of bonds with moments, rad; empty without
    VectorField couple;                      ///< moment of j on i of bonds with moments, N m; empty without
    Dilatation dilatation;                   ///< the averaged part of the stress, for Poisson's ratios that bonds alone do not reach
    VolumetricStrain volumetric;             ///< strain around spheres, for laws that look at it
    std::vector<BondGroup> groups;           ///< one of each pair of materials
    std::vector<BondBlock> blocks;
    std::vector<std::uint32_t> first_block; ///< of each block of spheres, and the number of blocks
    bool damped = false;                    ///< some bond has a dashpot
    bool moments = false;                   ///< some bond resists bending or twisting

    // Filled on request by `bond_forces`, for output.
    VectorField force;             ///< of j on i, N
    std::vector<double> normal;    ///< F_n without dashpot, compression positive, N
    std::vector<double> shear;     ///< |F_t|, N
    std::vector<double> criterion; ///< failure criterion state (5.44), 0 to 1
    std::vector<double> stored;    ///< elastic energy, J

    [[nodiscard]] std::size_t size() const { return i.size(); }
    /// u_p of each bond, m.
    [[nodiscard]] const std::vector<double>& plastic() const { return memory[0]; }
    /// State of a bond's law, but for the slip.
    template <class Law> [[nodiscard]] auto state(std::size_t bond) const {
        typename Law::template State<double> state{};
        std::size_t k = 0;
        Law::members(state, [&](const char*, double& x) { x = memory[k++][bond]; });
        return state;
    }
    template <class Law> void set_state(std::size_t bond, const typename Law::template State<double>& state) {
        std::size_t k = 0;
        Law::members(state, [&](const char*, const double& x) { memory[k++][bond] = x; });
    }
    /// Damage of a bond whatever its law, 0 intact to 1 failed.
    [[nodiscard]] double damage(std::size_t bond, const BondGroup& group) const;
    /// Name of memory k in checkpoints: what its laws call it.
    [[nodiscard]] std::string memory_name(std::size_t k) const;
    void resize(std::size_t n);
    [[nodiscard]] BondView view();
};

/// Which spheres are bonded, and over what distance.
struct BondingRule {
    double beta = 0.15;        ///< pairs with d <= (1 + beta)(R_i + R_j)
    double coordination = 0.0; ///< when positive, the nearest pairs are bonded until the mean number of bonds a sphere is this
    bool absolute = false;     ///< nearest by gap in m, as the released DEMpack code does, not by gap over the sum of radii
};

/// Pairs to bond: same cohesive group, within reach. Overlapping pairs of a group are always among them. `beta` returns the largest gap
/// over the sum of radii that was bonded.
/// Throws std::runtime_error when a wished coordination cannot be reached with beta below 1.
std::vector<Pair> bonded_pairs(const Spheres& spheres, const BondingRule& rule, double& beta);

/// Bonds the pairs: areas by each material's rule, stiffness (5.34), dashpot (5.15), laws of material pairs. The initial distance is the
/// equilibrium. `weight` receives the per-sphere area weights for later contacts. given: areas and weights that the rule `laguerre` takes,
/// one a pair and one a sphere; pairs to which it gives no area are left out. Throws std::invalid_argument when they are missing.
Bonds make_bonds(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<Pair>& pairs,
                 const std::vector<std::uint8_t>& skin, std::vector<double>& weight, const Areas* given = nullptr);

} // namespace proveta
