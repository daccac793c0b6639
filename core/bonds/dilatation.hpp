// The averaged part of the stress: what lets a network of bonds have any Poisson's ratio.
//
// Bonds alone have one stress for one strain along their own line, so that a network of them reaches a Poisson's ratio of a quarter at
// most. Celigueta, Latorre, Arrufat, Onate, Comput. Part. Mech. 4 (2017) 483 add to each bond's normal stress what the mean stress around
// it, taken from its spheres, causes by Poisson's effect. Here the same follows from a potential, so that no path through strains gains
// energy: each sphere stores (1/2) lambda V theta^2, where theta is the change of its volume as its bonds show it,
//
//     theta_i = sum over bonds g_ib e_b,   g_ib = A_b l_ib / (V_i L_b),   V_i = sum A_b l_ib / 3   (in a plane / 2)
//
// with e_b the elastic elongation, l_ib the lever arm. A bond pulls by that with lambda_i V_i theta_i g_ib + lambda_j V_j theta_j g_jb,
// which is k_n times a shift s_b: its law sees the elongation e_b + s_b, so that strength, damage and plasticity speak of the whole normal
// force. e_b is then what the law's force says of it, F_n / k_n - s_b: an open crack has none of its opening in theta.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/particles/spheres.hpp"

namespace proveta {

struct Bonds;

struct Dilatation {
    std::vector<double> stiffness;    ///< lambda V of each sphere, J; empty: no bond has an averaged part
    std::vector<double> g_i, g_j;     ///< `volume_shares`
    std::vector<double> shift;        ///< s of each bond at the last forces, m
    std::vector<double> shift_before; ///< the same one step earlier
    std::vector<double> elongation;   ///< scratch: elastic elongation of each bond without what its own spheres' theta make of it, m
    std::vector<double> following;    ///< scratch: share of each bond's shift that its elastic elongation gives way to, 0 intact to 1 open
    std::vector<double> theta;        ///< of each sphere

    [[nodiscard]] bool active() const { return !stiffness.empty(); }
};

/// Volume that each sphere stands for: the cones from its centre to its bonds' areas, sum of A l / 3 (in a plane A l / 2) with l the
/// lever arm, m3. A sphere without bonds gets its own volume.
std::vector<double> tributary_volumes(const Spheres& spheres, const Bonds& bonds);

/// Each bond's g_ib and g_jb above, 1/m, of spheres that stand for these volumes, m3.
struct VolumeShares {
    std::vector<double> i, j;
};
VolumeShares volume_shares(const Bonds& bonds, const std::vector<double>& volume);

/// Gives the bonds' spheres their averaged part: modulus is lambda of each sphere, Pa. With all of it zero there is none.
void set_dilatation(const Spheres& spheres, const std::vector<double>& modulus, Bonds& bonds);

/// The steps of one evaluation, each over a part of the work that touches nothing of another part: elongations of bonds begin to end, then
/// theta of spheres begin to end, then shifts of bonds begin to end.
void measure_elongations(const Spheres& spheres, Bonds& bonds, std::size_t begin, std::size_t end);
void measure_dilatation(Bonds& bonds, std::size_t begin, std::size_t end);
void set_shifts(Bonds& bonds, std::size_t begin, std::size_t end);

/// What the bonds' own energies, which are those of the shifted elongation, leave to be added, J: minus half of lambda V theta^2 and of
/// k_n s^2. Whatever the bonds' state: the sum of F_n ds over all bonds is the change of this, with the sign turned.
double dilatation_energy(const Bonds& bonds);

/// Factor on a bond's normal stiffness with which a bound on the stable step holds: lambda V (sum g e)^2 <= lambda V (sum g) (sum g e^2).
std::vector<double> stiffening(const Bonds& bonds);

} // namespace proveta
