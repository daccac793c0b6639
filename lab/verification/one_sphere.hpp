// One sphere and rigid surfaces: what the cases of chapter 3 have in common.
#pragma once

#include <vector>

#include "core/model.hpp"

namespace proveta::verification {

/// A sphere of the thesis's tables and what it meets. SI units.
struct OneSphere {
    double radius = 0.3;
    double density = 100.0;
    double young = 1e5;
    double poisson = 0.2;
    double friction = 0.3; ///< against the surfaces
    double restitution = 1.0;
    ContactLaw law = ContactLaw::hertz;
    bool rigid_wall = true; ///< else of the sphere's own material

    [[nodiscard]] Material material() const;
    [[nodiscard]] double mass() const;
    /// Force over overlap^(3/2) of the Hertzian contact, N/m^(3/2): 4/3 E* sqrt(R).
    [[nodiscard]] double hertz_stiffness() const;
    /// Overlap under a normal force in N.
    [[nodiscard]] double overlap(double force) const;
    [[nodiscard]] Surface surface(SurfaceMesh mesh) const;
};

/// A model of spheres of this kind at these places, without background damping; dt in s. Gravity is 9.81 m/s2 against z.
Model make_model(const OneSphere& kind, const std::vector<Vec3>& centres, std::vector<Surface> surfaces, double dt);

/// A sphere led along a path: forces of the surface on it, without motion of its own. Faces are searched every `every` steps, with a skin
/// as wide as the sphere goes meanwhile at `speed` m/s.
class LedSphere {
  public:
    LedSphere(const OneSphere& kind, SurfaceMesh mesh, double speed, double dt, int every);

    /// Takes the sphere to a place in one step of dt seconds and finds the contacts there.
    void go(const Vec3& to);

    [[nodiscard]] const std::vector<SurfaceTouch>& touches() const { return surface_.touches[0]; }
    [[nodiscard]] Vec3 force() const { return -surface_.sums.reaction; }        ///< on the sphere, N
    [[nodiscard]] double normal_forces() const { return surface_.sums.thrust; } ///< sum of their sizes, N
    [[nodiscard]] double tangential_forces() const;                             ///< sum of their sizes, N

  private:
    Spheres spheres_;
    std::vector<Material> materials_;
    Surface surface_;
    Loads loads_{1};
    double dt_, skin_;
    int every_, step_ = 0;
};

} // namespace proveta::verification
