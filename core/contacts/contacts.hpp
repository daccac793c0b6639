// Contacts between spheres that were never bonded: neighbour list with a skin, tangential history, LS+D law.
#pragma once

#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/bonds/material.hpp"
#include "core/contacts/incidence.hpp"
#include "core/contacts/pair_force.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Candidate pairs of the current neighbour list, one array per quantity; SI units. Not all of them touch.
struct Contacts {
    std::vector<std::int32_t> i, j;
    std::vector<double> contact_distance; ///< min(d(0), R_i + R_j): overlaps of a dense packing store nothing, m
    std::vector<double> stiffness;        ///< k_n as a bond of the pair would have, N/m
    std::vector<double> shear_stiffness;  ///< k_t, N/m
    std::vector<double> dashpot;          ///< c_n, N s/m
    std::vector<double> friction;         ///< mu_d of the pair
    VectorField slip;                     ///< u_t, m
    std::vector<double> normal;           ///< F_n of the last step, N
    std::vector<PairForce> forces;
    Incidence incidence;

    [[nodiscard]] std::size_t size() const { return i.size(); }
    void resize(std::size_t n);
};

/// Lever arm of i over the distance for a contact of spheres that just touch.
double lever_share(const Spheres& spheres, std::int32_t i, std::int32_t j);

/// Sums over the contacts of one step, J.
struct ContactEnergies {
    double stored = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
};

/// Lists anew all unbonded pairs nearer than R_i + R_j + skin, keeping the tangential history of those that were listed. weight: area
/// weights of `make_bonds`; skin in m.
Contacts search_contacts(const Spheres& spheres, const Bonds& bonds, const std::vector<Material>& materials,
                         const std::vector<double>& weight, double skin, const Contacts& old);

/// Advances every contact by dt seconds and fills `contacts.forces`.
ContactEnergies contact_forces(const Spheres& spheres, Contacts& contacts, double dt);

} // namespace proveta
