// Mass scaling: the few spheres that keep the stable step small get more mass.
#pragma once

#include <vector>

#include "core/motion/stable_step.hpp"

namespace proveta {

/// What a scaling did. Shares are of the specimen's true mass.
struct MassScaling {
    double added = 0.0;          ///< mass added over the true mass of all spheres
    std::size_t spheres = 0;     ///< that were made heavier
    double largest_factor = 1.0; ///< on mass and inertia of one sphere
    double step_before = 0.0;    ///< bound on the stable step with true masses, s
    double step_after = 0.0;     ///< with scaled ones, s
    double added_later = 0.0;    ///< mass added in the course of the calculation, over the true mass
    std::vector<double> mass;    ///< true mass of each sphere, kg; empty: nothing was scaled
};

/// Makes spheres heavier, mass and inertia by the same factor, so that the bound on the stable step becomes as large as an added mass of
/// `share` of the specimen's allows: each sphere gets the least factor with which the bound holds at one common step, and bisection finds
/// the largest step whose factors stay within the share. `bound` is split anew, so that heavy neighbours carry what they can of a spring.
/// Dashpots of bonds keep their constants; `contacts` and `walls`, which must list what is near, get their laws anew, because
/// restitution follows the mass. Stiffness, strength and every static state are those of the true masses: only motion feels the scaling. A
/// share of 0 changes nothing; nor is anything changed where there are clusters. Call it once, on true masses.
MassScaling scale_masses(Spheres& spheres, const Bonds& bonds, const std::vector<Material>& materials, const std::vector<double>& weight,
                         Contacts& contacts, Walls& walls, const Clusters& clusters, double skin, double share, StepBound& bound);

/// What `ease_step` did.
struct Easing {
    double dt = 0.0;     ///< step that is stable now, at most the one asked for, s
    double added = 0.0;  ///< mass, kg
    double energy = 0.0; ///< kinetic energy that the heavier spheres lost by keeping their momentum, J
};

/// In the course of a calculation: makes spheres that new contacts have made unstable at a step of dt seconds as heavy as that step asks
/// for, momentum kept. With more to add than `allowed` kg the step is shortened as far as that reaches.
Easing ease_step(Spheres& spheres, const Bonds& bonds, const std::vector<Material>& materials, const std::vector<double>& weight,
                 Contacts& contacts, Walls& walls, const Clusters& clusters, double skin, double dt, double allowed,
                 const StepBound& bound);

} // namespace proveta
