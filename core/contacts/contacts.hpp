// Contacts between spheres that were never bonded: neighbour list with a skin, tangential history, law of the pair.
#pragma once

#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/contacts/contact_kernel.hpp"
#include "core/contacts/incidence.hpp"
#include "core/contacts/loads.hpp"
#include "core/contacts/loose.hpp"
#include "core/laws/material.hpp"
#include "core/particles/clusters.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Candidate pairs of the current neighbour list, one array per quantity; SI units. Not all of them touch.
struct Contacts {
    std::vector<std::int32_t> i, j;
    std::vector<std::int32_t> row_j;      ///< row of the loads that j's share goes to
    std::vector<double> share;            ///< lever arm of i over the distance
    std::vector<double> contact_distance; ///< R_i + R_j, of packed spheres at most d(0), m
    std::vector<LooseContact> law;        ///< constants; the linear law has the stiffness that a bond of the pair would have
    VectorField slip;                     ///< u_t, m
    VectorField viscous;                  ///< force of the dashpots on i at the last step, N
    std::vector<double> normal;           ///< F_n of the last step, N
    VectorField force;                    ///< of j on i at the last step, N
    std::vector<std::uint8_t> active;     ///< touched at the last step, so that there may be a history
    std::vector<std::uint32_t> touching;  ///< scratch of the kernel
    std::vector<std::uint32_t> first;     ///< first contact of each block of spheres, and the number of contacts
    Incidence incidence;
    bool rolls = false; ///< some pair has rolling resistance
    bool pulls = false; ///< some pair may pull

    [[nodiscard]] std::size_t size() const { return i.size(); }
    void resize(std::size_t n);
    [[nodiscard]] ContactView view();
};

/// Lever arm of i over the distance for a contact of spheres that just touch.
double lever_share(const Spheres& spheres, std::int32_t i, std::int32_t j);

/// Lists anew all unbonded pairs of different bodies nearer than R_i + R_j + skin, keeping the history of those that were listed. weight:
/// area weights of `make_bonds`; skin in m; team: who shares the work, nobody: OpenMP's threads.
Contacts search_contacts(const Spheres& spheres, const Bonds& bonds, const Clusters& clusters, const std::vector<Material>& materials,
                         const std::vector<double>& weight, double skin, const Contacts& old, Team* team = nullptr);

/// Fills in what follows from the pairs themselves: contact distances, laws, lever shares, incidence.
void set_up_contacts(const Spheres& spheres, const std::vector<Material>& materials, const std::vector<double>& weight, Contacts& contacts);

/// Advances the contacts of one block of spheres and adds their forces and rolling resistance to the loads.
ContactEnergies contact_forces(const SphereView& spheres, const Contacts& contacts, const ContactView& view, std::size_t block,
                               const ContactStep& step, Loads& loads);

} // namespace proveta
