// Linear elasticity of a bond network: spheres with translations and rotations, bonds as springs with lever arms, with their resistance to
// bending and twisting and their averaged part.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// A prescribed component of a sphere's motion. component: 0 to 2 displacement along x, y, z (m), 3 to 5 rotation about them (rad).
struct Support {
    std::size_t sphere = 0;
    int component = 0;
    double value = 0.0;
};

/// A spring between a sphere and something rigid: its force on the sphere is -stiffness (motion of the contact point - given motion).
struct Bearing {
    std::size_t sphere = 0;
    Mat3 stiffness = Mat3::Zero(); ///< N/m
    Vec3 arm = Vec3::Zero();       ///< from the centre to the contact point, m
    Vec3 motion = Vec3::Zero();    ///< given motion of what it rests on, m
};

/// How the equations are solved.
struct ElasticOptions {
    std::size_t direct_in_plane = 300000; ///< up to so many unknowns of a planar network by sparse Cholesky,
    std::size_t direct_in_space = 1000;   ///< of a spatial one, where factors fill in far more; beyond by conjugate gradients
    double tolerance = 1e-10;             ///< residual over the right-hand side at which conjugate gradients stop
    int most_iterations = 20000;
    double anchor = 0.0; ///< a spring to the ground at every component, over its stiffness: keeps mechanisms (k_t = 0) solvable
};

/// Small displacements from the start. One entry a sphere.
struct ElasticSolution {
    VectorField displacement; ///< m
    VectorField rotation;     ///< rad
    VectorField force;        ///< that holds the sphere where it is prescribed, N; round-off elsewhere
    VectorField moment;       ///< N m
    VectorField bond;         ///< force of each bond on its sphere i, N
    double energy = 0.0;      ///< in the bonds and bearings, J
    int iterations = 0;       ///< 0: solved directly
};

/// The network cannot carry what it is asked to: it is a mechanism, or not held against rigid motion.
struct NotSolvable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Displacements of the network under prescribed components and bearings, free of load everywhere else. Each bond has k_n along the line of
/// centres and k_t across it at the contact point (5.34), as in the start of the dynamic calculation; discs move in their plane.
/// Components that no bond holds (rattlers, rotations where k_t = 0) stay at rest. start: a solution to begin from, of the same network
/// with other stiffnesses. Same input, same bits, whatever the number of threads. Throws NotSolvable, and std::invalid_argument for a
/// support of a sphere or component that is not there.
ElasticSolution solve_elastic(const Spheres& spheres, const Bonds& bonds, const std::vector<Support>& supports,
                              const ElasticOptions& options = {}, const std::vector<Bearing>& bearings = {},
                              const ElasticSolution* start = nullptr);

/// The same for up to six cases at once that prescribe the same components, in the same order, to different values.
std::vector<ElasticSolution> solve_elastic(const Spheres& spheres, const Bonds& bonds, const std::vector<std::vector<Support>>& cases,
                                           const ElasticOptions& options = {});

} // namespace proveta
