// Stress averaged over each sphere (Love-Weber), and failure criteria on it.
//
// Reference: thesis 5.4.5, which names averaged stress tensors as the cure for single-direction criteria that load bonds under pure
// confinement; J. Christoffersen, M. Mehrabadi, S. Nemat-Nasser, J. Appl. Mech. 48 (1981) 339 for the average.
#pragma once

#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/boundaries/pressure.hpp"
#include "core/boundaries/walls.hpp"
#include "core/contacts/contacts.hpp"

namespace proveta {

/// Mean stress of each sphere, compression positive, symmetric, Pa: (1/V) sum over bonds, contacts, walls and pressures of r x F with r
/// from the centre to the contact point. volume: one a sphere, m3.
std::vector<Mat3> sphere_stresses(const Spheres& spheres, const Bonds& bonds, const Contacts& contacts, const Walls& walls,
                                  const std::vector<Pressure>& pressures, const std::vector<double>& volume);

/// Mean stress of each sphere's vicinity: itself and the spheres it is still bonded to, weighted by their volumes, Pa. Single spheres of a
/// random packing carry deviators of a third of an all-round pressure; their vicinities do not.
std::vector<Mat3> vicinity_stresses(const Bonds& bonds, const std::vector<Mat3>& stress, const std::vector<double>& volume);

/// Use of strength, 1 at failure, of a stress (compression positive, Pa) by Mohr-Coulomb with tension cut-off: over all planes the largest
/// tau / (c + mu sigma), and largest tension over sigma_f.
double mohr_coulomb(const Mat3& stress, double cohesion, double mu, double sigma_f);

/// The same by Rankine: largest tension over sigma_f.
double rankine(const Mat3& stress, double sigma_f);

/// Criterion value of every bond with an averaged criterion, by the mean of its two spheres' `stress`; failed bonds have 1. Bonds with
/// criteria of their own are left as they are. `shear_governs` tells which part of the criterion was the larger.
void averaged_criteria(const Bonds& bonds, const std::vector<Mat3>& stress, std::vector<double>& value,
                       std::vector<std::uint8_t>& shear_governs);

/// Fails a bond at once at the end of a step of dt seconds: tension and shear are gone, compression stays; the loads get the force after
/// failure instead of the one before, and the output arrays of Bonds follow, which must be those of this step. Returns the energy that this
/// took, J, trapezoidal over the step as in the law. group: the bond's.
double fail_bond(const Spheres& spheres, Bonds& bonds, std::size_t bond, const BondGroup& group, FailureMode mode, double dt, Loads& loads);

} // namespace proveta
