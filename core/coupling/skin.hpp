// The surface of a deformable body as contact sees it: triangles that move with the nodes.
//
// Quadrilaterals are seen as four triangles about their centroid (thesis 4.3.3), which is the mean of their corners: whatever a triangle's
// corner there takes goes to the quadrilateral's own nodes in equal parts, so that forces and moments stay what they are.
#pragma once

#include <array>

#include "core/boundaries/double_hierarchy.hpp"
#include "core/parallel/team.hpp"
#include "core/solids/solid_mesh.hpp"

namespace proveta {

class Skin {
  public:
    Skin() = default;
    /// nodes: of the body, at the start.
    Skin(const std::vector<SkinFace>& faces, const std::vector<Vec3>& nodes);

    [[nodiscard]] const SurfaceGeometry& geometry() const { return geometry_; }
    [[nodiscard]] std::size_t triangles() const { return geometry_.plane.size(); }
    [[nodiscard]] std::span<const SkinFace> faces() const { return faces_; }

    /// Takes over positions and velocities of the nodes.
    void follow(const std::vector<Vec3>& position, const std::vector<Vec3>& velocity, Team& team);

    /// Barycentric coordinates of a point over a triangle's plane, as it is now; they sum to 1.
    [[nodiscard]] Vec3 coordinates(std::uint32_t triangle, const Vec3& point) const;
    /// The point with such coordinates, and its velocity.
    [[nodiscard]] Vec3 point(std::uint32_t triangle, const Vec3& coordinates) const;
    [[nodiscard]] Vec3 velocity(std::uint32_t triangle, const Vec3& coordinates) const;
    /// Angular velocity of a triangle about its normal, rad/s.
    [[nodiscard]] double spin(std::uint32_t triangle) const;
    /// How fast a triangle's normal turns, rad/s.
    [[nodiscard]] double tilt(std::uint32_t triangle) const;

    /// Calls use(node, weight) for the body's nodes that a point of a triangle hangs on.
    template <class Use> void each_node(std::uint32_t triangle, const Vec3& coordinates, const Use& use) const {
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t v = geometry_.mesh.corner[3 * triangle + static_cast<std::uint32_t>(c)];
            if (v < nodes_) {
                use(v, coordinates[c]);
            } else {
                for (const auto node : faces_[centre_of_[v - nodes_]].node) {
                    use(node, 0.25 * coordinates[c]);
                }
            }
        }
    }

  private:
    std::vector<SkinFace> faces_;
    SurfaceGeometry geometry_;             // vertices: the body's nodes, then the centroids
    std::vector<std::uint32_t> centre_of_; // face of each centroid
    std::vector<Vec3> velocity_;           // of the vertices, m/s
    std::uint32_t nodes_ = 0;
};

} // namespace proveta
