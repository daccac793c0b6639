// A sphere that falls on the middle of a simply supported beam: Timoshenko's solution by modes, and the same with elements.
#pragma once

#include <utility>
#include <vector>

#include "core/model.hpp"

namespace proveta::verification {

/// Table 4.1 of the thesis: sphere and beam of one material, Hertz's law between them, nothing that dissipates.
struct StruckBeam {
    double radius = 0.01;   ///< of the sphere, m
    double length = 0.1535; ///< m
    double side = 0.01;     ///< of the square section, m
    double density = 7960.0;
    double young = 215.82e9;
    double poisson = 0.289;
    double speed = 0.01; ///< of the sphere, m/s

    [[nodiscard]] double sphere_mass() const;
    /// k of F = k d^(3/2): 4/3 E* sqrt(R), of two equal bodies.
    [[nodiscard]] double hertz_stiffness() const;
    /// Angular frequency of the n-th mode of a slender beam, (n pi / L)^2 sqrt(E I / (rho A)), rad/s.
    [[nodiscard]] double frequency(int n) const;
};

/// What an impact looks like in time; positive down, towards the beam.
struct ImpactHistory {
    std::vector<double> time, force, deflection; ///< s; N; of the beam's middle, m

    void add(double t, double f, double w);
    [[nodiscard]] double peak() const; ///< N, of the first contact
    /// Begin and end of every contact, s.
    [[nodiscard]] std::vector<std::pair<double, double>> contacts() const;
    [[nodiscard]] double contact_time() const; ///< of the first contact, s
    [[nodiscard]] double impulse() const;      ///< of the first contact, N s
    [[nodiscard]] double deepest() const;      ///< largest deflection, m
    [[nodiscard]] double force_at(double t) const;
    /// Root mean square of the difference of two forces until a time, over the other's peak.
    [[nodiscard]] double distance_to(const ImpactHistory& other, double until) const;
};

/// By which theory the modes of the beam go.
enum class BeamTheory {
    slender, ///< Euler and Bernoulli
    thick    ///< Timoshenko, with shear and rotatory inertia; the lower branch of its modes
};

/// The solution by `modes` odd modes: the convolution of each with the contact force as a sum over impulses `dt` apart, each mode turning
/// exactly by its own angle between them. Second order in dt.
ImpactHistory modal_solution(const StruckBeam& beam, BeamTheory theory, int modes, double dt, double until);

/// The beam of nx x ny x nz hexahedra about the origin, its ends held down as a whole: sections there turn freely, and without stress along
/// the beam their height does not change. The sphere, just above the middle, touches at once.
Model struck_beam_model(const StruckBeam& beam, int nx, int ny, int nz, Coupling coupling);

/// Runs that model.
ImpactHistory run_impact(const StruckBeam& beam, Model& model, double until);

} // namespace proveta::verification
