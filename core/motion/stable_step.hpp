// The largest stable step, bounded from below rigorously, sphere by sphere.
#pragma once

#include <algorithm>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/boundaries/walls.hpp"
#include "core/contacts/contacts.hpp"
#include "core/particles/clusters.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// What the bound asks of one sphere: it is stable while stiffness dt^2 + 2 damping dt <= left. Eigenvalues over the sphere's mass and
/// inertia, so that both fall with a factor on these.
struct SphereDemand {
    double stiffness = 0.0; ///< 1/s2
    double damping = 0.0;   ///< 1/s
    double left = 4.0;      ///< of the 4, after rolling resistance

    [[nodiscard]] double step() const; ///< largest step, s
    /// Factor on mass and inertia at which a step of dt seconds is the largest; below 1 where the sphere could be lighter.
    [[nodiscard]] double factor(double dt) const { return (stiffness * dt + 2.0 * damping) * dt / left; }
};

/// What acts on the spheres of a model.
struct Assembly {
    const Spheres& spheres;
    const Bonds& bonds;
    const Contacts& contacts;
    const Walls& walls;
    const Clusters& clusters;
};

/// Lower bound on the critical step of velocity Verlet with velocities that lag half a step: lambda_max[M^-1 (dt^2 K + 2 dt C)] <= 4.
///
/// Each spring's energy is split between its two spheres by Young's inequality, (a + b)^2 <= (1 + g_j/g_i) a^2 + (1 + g_i/g_j) b^2,
/// which leaves one 6 x 6 eigenvalue problem (translation and rotation, lever arms included) a sphere. Any positive g gives a bound; a
/// few sweeps choose g so that the largest eigenvalue is small. Rolling resistance takes its share of the 4, whatever the step. All
/// stiffnesses are the undamaged ones, which no later state exceeds; failed bonds that are out of reach until the next search are left out.
class StepBound {
  public:
    StepBound(const Spheres& spheres, const Bonds& bonds);

    /// Begins another split, even at first.
    void level() { std::fill(share_.begin(), share_.end(), 1.0); }
    /// Hands springs over to spheres that have mass to spare, while `factor`, the demanded mass over the true one, is below 1; between two
    /// spheres that both ask for mass an even split asks for least.
    void hand_over(const std::vector<double>& factor);

    /// The bound in s, with the pairs of the contact list and the walls taken as closed. skin: how much overlaps may still grow before
    /// the next search, m; laws that stiffen with overlap count as stiff as they can get by then. enough: a step in s beyond which nobody
    /// asks; the answer is at most this, and costs little when no sphere is below it.
    [[nodiscard]] double limit(const Assembly& assembly, double skin = 0.0, double enough = 1e300) const;
    /// The same sphere by sphere: the bound is the lowest of their steps.
    [[nodiscard]] std::vector<SphereDemand> demands(const Assembly& assembly, double skin = 0.0) const;

    /// The spheres that are not stable at a step of dt seconds, ascending, and the factor on mass and inertia at which each would be.
    struct Offender {
        std::uint32_t sphere;
        double factor;
    };
    [[nodiscard]] std::vector<Offender> offenders(const Assembly& assembly, double skin, double dt) const;

  private:
    template <class Use> void each_block(const Assembly& assembly, double skin, const Use& use) const;

    std::vector<double> share_;  // g for bonds, tuned to their network
    std::vector<double> single_; // g for any other pair: the sphere's own frequency
};

} // namespace proveta
