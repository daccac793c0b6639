// What the compiled variants of the contact kernel share: their entry points, what they see, what they give back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/contacts/loose_contact.hpp"
#include "core/particles/sphere_view.hpp"

namespace proveta {

/// Sums over the contacts of one step, J.
struct ContactEnergies {
    double stored = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
    double deepest = 0.0; ///< largest overlap over the smaller radius, when it is asked for
};

/// Bare pointers into the contacts' arrays (core/contacts/contacts.hpp says what they hold).
struct ContactView {
    const std::int32_t *i, *j, *row_j;
    const double *share, *reach; ///< lever share; distance at which the spheres begin to touch
    const LooseContact* law;
    double* slip[3];
    double* viscous[3];
    double* normal;
    double* force[3];
    std::uint8_t* active;
    std::uint32_t* touching; ///< scratch, one a contact
    bool pulls;              ///< some contact may pull
    bool rolls;              ///< some contact has rolling resistance
};

/// Advances contacts begin to end and adds their forces to the rows.
using ContactKernel = void (*)(const SphereView&, const ContactView&, double* rows, std::size_t begin, std::size_t end, const ContactStep&,
                               ContactEnergies&);

// The same source compiled for three instruction sets (core/CMakeLists.txt).
void contact_kernel_baseline(const SphereView&, const ContactView&, double*, std::size_t, std::size_t, const ContactStep&,
                             ContactEnergies&);
void contact_kernel_avx2(const SphereView&, const ContactView&, double*, std::size_t, std::size_t, const ContactStep&, ContactEnergies&);
void contact_kernel_avx512(const SphereView&, const ContactView&, double*, std::size_t, std::size_t, const ContactStep&, ContactEnergies&);

} // namespace proveta
