// A rigid surface of faces among loose spheres: fixed or moving as a whole, met by the Double Hierarchy method (thesis, chapter 3).
#pragma once

#include <string>
#include <vector>

#include "core/boundaries/near_faces.hpp"
#include "core/motion/rotation.hpp"

namespace proveta {

/// A contact of one sphere with a surface, as of the last step.
struct SurfaceTouch {
    std::int32_t sphere;
    std::uint32_t face;
    Feature feature;
    std::uint8_t index; ///< of the edge or the corner
    Vec3 point;         ///< in the surface's frame, m
    WallHistory history;
    Vec3 force; ///< on the sphere, N
};

/// How a surface moves during a step.
struct SurfaceVelocity {
    Vec3 velocity = Vec3::Zero(); ///< of its origin, m/s
    Vec3 spin = Vec3::Zero();     ///< about its origin, rad/s
};

/// Faces are given in the surface's own frame, which never changes: so what follows from them is worked out once, and spheres are seen from
/// there. Both sides of a face are met.
struct Surface : NearFaces {
    std::string name;
    SurfaceGeometry geometry;
    FaceTree tree;
    Material material;
    double friction = 0.0; ///< of this pair of surfaces

    Vec3 origin = Vec3::Zero();                                       ///< in space, m
    rotation::Quaternion attitude = rotation::Quaternion::Identity(); ///< turns the surface's frame into space
    SurfaceVelocity drive;                                            ///< of the steps to come
    SurfaceVelocity motion;                                           ///< of the last move

    std::vector<LooseContact> law;                  ///< constants, per listed sphere
    std::vector<std::vector<SurfaceTouch>> touches; ///< per block of spheres, ascending by sphere
    WallSums sums;                                  ///< of the last step

    Surface() = default;
    Surface(std::string called, SurfaceMesh mesh, const Material& wall, double friction_coefficient);

    [[nodiscard]] Vec3 to_space(const Vec3& own) const { return origin + attitude * own; }
    [[nodiscard]] Vec3 to_own(const Vec3& space) const { return attitude.conjugate() * (space - origin); }
    [[nodiscard]] Vec3 velocity_at(const Vec3& space) const { return motion.velocity + motion.spin.cross(space - origin); }
    /// Unit vector of a contact: along `to` (m, `distance` long) between contact point and centre, or the face's where the centre lies on
    /// it.
    [[nodiscard]] Vec3 normal_at(const FaceContact& contact, const Vec3& to, double distance) const {
        return distance > 0.0 ? Vec3(to / distance) : Vec3(attitude * geometry.plane[contact.face].normal);
    }
    /// Farthest distance of a point of the surface from its origin, m.
    [[nodiscard]] double reach() const { return reach_; }

    /// Moves the surface as it is driven for dt seconds.
    void move(double dt);

    /// How far a sphere of a touch reaches beyond its contact point, m.
    [[nodiscard]] double overlap_of(const SurfaceTouch& touch, const Spheres& spheres) const;
    /// Stiffness that the contacts of the last step have along a unit vector, N/m.
    [[nodiscard]] double stiffness_along(const Vec3& direction, const Spheres& spheres) const;

    /// Carries the contacts over to another numbering of the spheres: now[k] is the new number of sphere k, -1: gone. Spheres must be
    /// listed anew afterwards. Returns the energy that contacts of gone spheres held, J; old: the spheres as they were.
    double renumber(const Spheres& old, const std::vector<std::int32_t>& now, std::size_t spheres);

    /// As `Model::visit_state`; names begin with `prefix`.
    template <class Visit> void visit_state(const std::string& prefix, Visit&& visit) {
        Flat flat = flattened();
        visit(prefix + "pose", flat.pose);
        visit(prefix + "lists", flat.lists);
        visit(prefix + "touches", flat.touches);
        visit(prefix + "touch_values", flat.values);
        restore(flat);
    }

  private:
    [[nodiscard]] const LooseContact& law_of(const SurfaceTouch& touch) const;

    // Everything that later steps depend on, in plain numbers.
    struct Flat {
        std::vector<double> pose;          // origin, attitude, motion, reaction and torque
        std::vector<std::int32_t> lists;   // number of listed spheres, these, where their faces begin, their faces
        std::vector<std::int32_t> touches; // sphere, face, feature, index of each
        std::vector<double> values;        // point, slip, dashpots' force of each
    };
    [[nodiscard]] Flat flattened() const;
    void restore(const Flat& flat);

    double reach_ = 0.0;
};

/// Lists anew the spheres within `skin` metres of touching, and the faces near each. Contacts stay as they are. team: who shares the work.
void search_surface(const Spheres& spheres, const std::vector<Material>& materials, double skin, Surface& surface, Team* team = nullptr);

/// Fills in the constants of the listed spheres' contacts.
void set_up_surface(const Spheres& spheres, const std::vector<Material>& materials, Surface& surface);

/// Finds the contacts of one block of spheres, advances them and adds their forces to the loads. A contact takes over
/// the tangential history of the old one nearest to it within the way that the sphere went (3.22), whichever face that was on.
WallSums surface_forces(const Spheres& spheres, Surface& surface, std::size_t number, const SphereBlock& block, const ContactStep& step,
                        Loads& loads);

} // namespace proveta
