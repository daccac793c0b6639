// Global search among the faces of a surface: a tree of boxes, good for any size of face against any size of sphere.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/boundaries/surface_mesh.hpp"

namespace proveta {

/// Boxes of a surface's faces, halved along their longest side until few are left. Made once for a rigid surface, in its own frame.
class FaceTree {
  public:
    FaceTree() = default;
    explicit FaceTree(const SurfaceMesh& mesh);

    /// Appends the faces whose boxes are nearer than `reach` metres to a point, in ascending order.
    void near(const Vec3& point, double reach, std::vector<std::uint32_t>& found) const;

    /// Box of the whole surface; empty without faces.
    [[nodiscard]] Eigen::AlignedBox3d box() const { return nodes_.empty() ? Eigen::AlignedBox3d() : nodes_.front().box; }

  private:
    struct Node {
        Eigen::AlignedBox3d box;
        std::uint32_t begin, end; // of its faces in `order_`
        std::uint32_t second;     // its second half; the first half follows it directly; 0: a leaf
    };

    void split(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t begin, std::uint32_t end);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    std::vector<Eigen::AlignedBox3d> boxes_; // of the faces, in the order of `order_`
};

} // namespace proveta
