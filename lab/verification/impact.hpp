// Normal impact of two equal spheres through the engine: the set-up of figure 2.9(b), shared by several cases.
#pragma once

#include <array>
#include <vector>

#include "core/model.hpp"
#include "lab/verification/case.hpp"

namespace proveta::verification {

/// The schemes with their names and colours in plots.
struct SchemeName {
    Scheme scheme;
    const char* name;
    const char* colour;
};
inline constexpr std::array<SchemeName, 4> schemes{{{Scheme::forward_euler, "Forward Euler", "#c0392b"},
                                                    {Scheme::symplectic_euler, "Symplectic Euler", "#1e7b46"},
                                                    {Scheme::taylor, "Taylor", "#b9770e"},
                                                    {Scheme::velocity_verlet, "Velocity Verlet", "#1f4e79"}}};

/// One sphere flies at `speed` along the line of centres against an equal one at rest; they touch at time 0.
struct Impact {
    Material material;
    Scheme scheme = Scheme::velocity_verlet;
    double dt = 0.0;      ///< s
    double radius = 0.01; ///< m
    double density = 100; ///< kg/m3
    double speed = 0.5;   ///< m/s

    [[nodiscard]] double mass() const;         ///< of one sphere, kg
    [[nodiscard]] double reduced_mass() const; ///< kg
};

/// What happened, at whole steps.
struct ImpactPath {
    std::vector<double> time, overlap, approach; ///< s, m, m/s
    double duration = 0.0;                       ///< until the overlap is gone, interpolated between steps, s
    double deepest = 0.0;                        ///< largest overlap at a step, m
    double exit_speed = 0.0;                     ///< at which the spheres part, m/s
};

ImpactPath collide(const Impact& impact);

/// Linear material whose contacts of spheres of this radius (m) have this stiffness (N/m).
Material linear_material(double stiffness, double radius);

/// Errors of the deepest overlap and the exit speed of every scheme over a range of steps.
struct Convergence {
    std::array<std::vector<double>, 4> depth, speed; ///< relative errors, by scheme and step
    std::vector<double> step;                        ///< s
    [[nodiscard]] double depth_order(std::size_t scheme) const;
    [[nodiscard]] double speed_order(std::size_t scheme) const;
};

/// duration and depth: the exact ones, s and m. The steps are the duration over 10.5, 20.5, 40.5 ... 320.5: an impact of a whole number of
/// steps would end on a step, which flatters the exit speed by an order, and one of any number would scatter the error of the sampled
/// depth.
Convergence convergence(Impact impact, double duration, double depth);

/// The figures of an impact: overlap and speed with ten steps a contact, errors over steps.
std::vector<report::Plot> impact_plots(Impact impact, double duration, const Convergence& errors, const std::string& law,
                                       const std::array<std::string, 3>& figures, double (*exact_overlap)(double),
                                       double (*exact_speed)(double));

} // namespace proveta::verification
