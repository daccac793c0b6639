// A rigid plane across the z axis that moves along it: a loading platen, or a wall that loose spheres meet.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/bonds/material.hpp"
#include "core/contacts/loads.hpp"
#include "core/contacts/loose.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Sums over a platen's contacts of one step, or over those of one block of spheres; energies in J.
struct PlatenSums {
    double stored = 0.0;
    double friction = 0.0;
    double dashpot = 0.0;
    Vec3 reaction = Vec3::Zero(); ///< force of the specimen on the platen, N
    int touching = 0;

    void add(const PlatenSums& other);
};

/// A rigid plane z = `position` whose specimen lies on the side `inward` (+1 above it, -1 below it). Without a face material it is the cap
/// of a specimen's end: spheres meet it by LS+D without dashpot: stiffness E A / R over the half sphere between plane and centre, the areas
/// of the first contacts sharing out the specimen's end, so that the platen adds no compliance of its own. Spheres that lie within
/// `capping` of the plane at the start touch it then, without force, as a ground or capped end does. With a face material spheres meet it
/// by their loose law with the equivalents of a wall (2.41), rolling resistance included.
struct Platen {
    double position = 0.0; ///< m
    double velocity = 0.0; ///< of the last move, m/s
    double inward = 1.0;
    double friction = 0.0;                ///< mu; infinity: glued sideways
    std::vector<std::int32_t> sphere;     ///< listed spheres, ascending
    std::optional<Material> face;         ///< of a wall
    std::vector<double> contact_distance; ///< m
    std::vector<LooseContact> law;        ///< constants of each contact
    std::vector<double> slip_x, slip_y;   ///< elastic tangential displacement, m
    VectorField viscous;                  ///< force of the dashpots on the sphere at the last step, N
    VectorField force;                    ///< on each listed sphere at the last step, N
    std::vector<double> capped;           ///< per sphere of the specimen: contact distance from the start, m; 0: none
    double area_weight = 1.0;             ///< contact area over the sphere's section
    Vec3 reaction = Vec3::Zero();         ///< force of the specimen on the platen, N
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

/// A wall at `position` with a face material; its friction is that of the spheres' surface against this one.
Platen make_wall(const Spheres& spheres, double position, double inward, const Material& face, double friction);

/// Lists anew the spheres within `skin` metres of touching, keeping tangential histories.
void search_platen(const Spheres& spheres, const std::vector<Material>& materials, double skin, Platen& platen);

/// Fills in what follows from the listed spheres: contact distances and laws.
void set_up_platen(const Spheres& spheres, const std::vector<Material>& materials, Platen& platen);

/// Advances the platen's contacts with one block of spheres by `elapsed` seconds and adds their forces to the loads. dt: the step that the
/// forces will act for, s.
PlatenSums platen_forces(const Spheres& spheres, Platen& platen, const SphereBlock& block, double elapsed, double dt, Loads& loads);

} // namespace proveta
