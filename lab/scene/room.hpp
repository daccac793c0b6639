// Where there is still room for a particle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "core/boundaries/walls.hpp"
#include "core/particles/spheres.hpp"

namespace proveta {

/// Spheres, surfaces and deformable bodies that are there, and spheres around the particles that were put in since.
class Room {
  public:
    /// widest: radius of the largest sphere that will be asked for, m.
    Room(const Walls& walls, const Spheres& there, double widest) : walls_(walls) {
        for (const auto& body : walls.bodies) {
            trees_.emplace_back(body.skin.geometry().mesh);
        }
        double largest = widest;
        for (const double r : there.radius) {
            largest = std::max(largest, r);
        }
        cell_ = 2.0 * largest;
        for (std::size_t k = 0; k < there.size(); ++k) {
            take(there.position.at(k), there.radius[k]);
        }
    }

    void take(const Vec3& centre, double radius) { taken_[key(cell_of(centre))].push_back({centre, radius}); }

    /// Whether a sphere touches nothing.
    [[nodiscard]] bool is_free(const Vec3& centre, double radius) const {
        const auto cell = cell_of(centre);
        for (std::int64_t x = -1; x <= 1; ++x) {
            for (std::int64_t y = -1; y <= 1; ++y) {
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto found = taken_.find(key({cell.x() + x, cell.y() + y, cell.z() + z}));
                    if (found == taken_.end()) {
                        continue;
                    }
                    for (const auto& sphere : found->second) {
                        const double reach = sphere.radius + radius;
                        if ((sphere.centre - centre).squaredNorm() <= reach * reach) {
                            return false;
                        }
                    }
                }
            }
        }
        return beyond_surfaces(centre, radius);
    }

    /// Whether it touches no surface and no body.
    [[nodiscard]] bool beyond_surfaces(const Vec3& centre, double radius) const {
        std::vector<std::uint32_t> faces;
        for (const auto& surface : walls_.surfaces) {
            const Vec3 own = surface.to_own(centre);
            faces.clear();
            surface.tree.near(own, radius, faces);
            for (const auto face : faces) {
                if (cuts(surface.geometry, face, own, radius)) {
                    return false;
                }
            }
        }
        for (std::size_t b = 0; b < trees_.size(); ++b) {
            const SurfaceGeometry& skin = walls_.bodies[b].skin.geometry();
            faces.clear();
            trees_[b].near(centre, radius, faces);
            if (std::any_of(faces.begin(), faces.end(), [&](auto face) { return cuts(skin, face, centre, radius); })) {
                return false;
            }
            if (walls_.bodies[b].side > 0.0 && trees_[b].box().contains(centre) && inside(skin, centre)) {
                return false;
            }
        }
        return true;
    }

  private:
    struct Taken {
        Vec3 centre;
        double radius;
    };
    // Of a closed skin: by the solid angles that its triangles take up, 4 pi inside and 0 outside (A. van Oosterom and J. Strackee, IEEE
    // Trans. Biomed. Eng. 30 (1983) 125).
    static bool inside(const SurfaceGeometry& skin, const Vec3& point) {
        double half_angles = 0.0;
        for (std::uint32_t t = 0; t < skin.plane.size(); ++t) {
            const auto v = skin.corners(t);
            const Vec3 a = v[0] - point;
            const Vec3 b = v[1] - point;
            const Vec3 c = v[2] - point;
            half_angles += std::atan2(a.dot(b.cross(c)),
                                      a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() + c.dot(a) * b.norm());
        }
        return half_angles > std::numbers::pi;
    }

    using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

    [[nodiscard]] Cell cell_of(const Vec3& at) const { return (at / cell_).array().floor().cast<std::int64_t>().matrix(); }
    // 21 bits each: cells that share a key only cost time.
    static std::uint64_t key(const Cell& c) {
        constexpr std::uint64_t mask = (1U << 21) - 1;
        return (static_cast<std::uint64_t>(c.x()) & mask) << 42 | (static_cast<std::uint64_t>(c.y()) & mask) << 21 |
               (static_cast<std::uint64_t>(c.z()) & mask);
    }

    const Walls& walls_;
    std::vector<FaceTree> trees_; // of the bodies as they are now
    double cell_ = 1.0;
    std::unordered_map<std::uint64_t, std::vector<Taken>> taken_;
};

} // namespace proveta
