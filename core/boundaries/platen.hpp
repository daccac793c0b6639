// A loading platen: a rigid plane across the z axis that moves along it.
#pragma once

#include <limits>
#include <vector>

#include "core/bonds/material.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Sums over a platen's contacts of one step, J.
struct PlatenEnergies {
    double stored = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
};

/// A rigid plane z = `position` whose specimen lies on the side `inward` (+1 above it, -1 below it). Spheres meet it by LS+D without
/// dashpot: stiffness E A / R over the half sphere between plane and centre, the areas of the first contacts sharing out the specimen's
/// end, so that the platen adds no compliance of its own. Spheres that lie within `capping` of the plane at the start touch it
/// then, without force, as a ground or capped end does.
struct Platen {
    double position = 0.0; ///< m
    double velocity = 0.0; ///< of the last move, m/s
    double inward = 1.0;
    double friction = 0.0;                          ///< mu; infinity: glued sideways
    std::vector<std::int32_t> sphere;               ///< listed spheres, ascending
    std::vector<double> contact_distance;           ///< m
    std::vector<double> stiffness, shear_stiffness; ///< N/m
    std::vector<double> slip_x, slip_y;             ///< elastic tangential displacement, m
    VectorField force;                              ///< on each listed sphere at the last step, N
    std::vector<double> capped;                     ///< per sphere of the specimen: contact distance from the start, m; 0: none
    double area_weight = 1.0;                       ///< contact area over the sphere's section
    Vec3 reaction = Vec3::Zero();                   ///< force of the specimen on the platen, N
    int touching = 0;

    /// Moves the plane by velocity dt.
    void move(double speed, double dt) {
        velocity = speed;
        position += speed * dt;
    }
};

constexpr double glued = std::numeric_limits<double>::infinity();

/// A platen at `position` that caps the given end of the specimen. end_area: nominal area of that end, m2; capping: reach of the first
/// contacts beyond the plane over the sphere's radius.
Platen make_platen(const Spheres& spheres, double position, double inward, double friction, double end_area, double capping);

/// Lists anew the spheres within `skin` metres of touching, keeping tangential histories.
void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& platen);

/// Advances the platen's contacts by dt seconds: adds to the spheres' external forces and torques and sets `reaction`.
PlatenEnergies platen_forces(Spheres& spheres, Platen& platen, double dt);

} // namespace proveta
