// Which spheres are near which faces of a surface, and what a new contact takes over from old ones.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/boundaries/double_hierarchy.hpp"
#include "core/boundaries/face_tree.hpp"
#include "core/boundaries/wall_contact.hpp"
#include "core/contacts/loads.hpp"
#include "core/parallel/team.hpp"

namespace proveta {

/// Spheres near a surface and the faces near each.
struct NearFaces {
    std::vector<std::int32_t> sphere;      ///< spheres near a face, ascending
    std::vector<std::uint32_t> near_first; ///< where their faces begin in `near_face`; one more than there are spheres
    std::vector<std::uint32_t> near_face;

    [[nodiscard]] std::span<const std::uint32_t> faces_near(std::size_t listed) const {
        return {near_face.data() + near_first[listed], near_face.data() + near_first[listed + 1]};
    }
};

/// Lists the spheres within `skin` metres of touching, and the faces near each. own: takes a point of space to the frame of geometry and
/// tree. team: who shares the work.
template <class ToOwn>
void list_near(const Spheres& spheres, double skin, const SurfaceGeometry& geometry, const FaceTree& tree, const ToOwn& to_own, Team& team,
               NearFaces& out) {
    struct Found {
        std::vector<std::int32_t> sphere;
        std::vector<std::uint32_t> faces; // how many of each
        std::vector<std::uint32_t> face;
    };
    std::vector<Found> found(blocks_of(spheres.size()));
    const auto box = tree.box(); // only spheres in the intersection of both domains look for faces
    team.run(found.size(), [&](std::size_t part) {
        Found& of = found[part];
        const std::size_t begin = part * spheres_per_block;
        const std::size_t end = std::min(spheres.size(), begin + spheres_per_block);
        for (std::size_t s = begin; s < end && !box.isEmpty(); ++s) {
            const Vec3 own = to_own(spheres.position.at(s));
            const double reach = spheres.radius[s] + skin;
            if (box.squaredExteriorDistance(own) > reach * reach) {
                continue;
            }
            const std::size_t before = of.face.size();
            tree.near(own, reach, of.face);
            const auto kept = std::remove_if(of.face.begin() + static_cast<std::ptrdiff_t>(before), of.face.end(),
                                             [&](std::uint32_t face) { return !cuts(geometry, face, own, reach); });
            of.face.erase(kept, of.face.end());
            if (of.face.size() > before) {
                of.sphere.push_back(static_cast<std::int32_t>(s));
                of.faces.push_back(static_cast<std::uint32_t>(of.face.size() - before));
            }
        }
    });
    out.sphere.clear();
    out.near_first.assign(1, 0);
    out.near_face.clear();
    for (const auto& block : found) {
        out.sphere.insert(out.sphere.end(), block.sphere.begin(), block.sphere.end());
        for (const auto n : block.faces) {
            out.near_first.push_back(out.near_first.back() + n);
        }
        out.near_face.insert(out.near_face.end(), block.face.begin(), block.face.end());
    }
}

/// Constants of the listed spheres' contacts with a wall of the given material.
std::vector<LooseContact> wall_contacts(const Spheres& spheres, const std::vector<Material>& materials, const Material& wall,
                                        double friction, const std::vector<std::int32_t>& listed);

/// The old touches of one sphere in a list that ascends by sphere, found by walking along it. begin: where the last sphere's ended.
template <class Touch> std::size_t end_of_touches(const std::vector<Touch>& old, std::size_t& begin, std::int32_t sphere) {
    while (begin < old.size() && old[begin].sphere < sphere) {
        ++begin;
    }
    std::size_t end = begin;
    while (end < old.size() && old[end].sphere == sphere) {
        ++end;
    }
    return end;
}

/// The old touch nearest to a point within `bound` metres, by `point_of` (3.22); `end` if there is none or another contact has taken it.
/// Who takes one marks it by sphere = -1.
template <class Touch, class PointOf>
std::size_t nearest_touch(const std::vector<Touch>& old, std::size_t begin, std::size_t end, const Vec3& point, double bound,
                          const PointOf& point_of) {
    std::size_t nearest = end;
    double square = bound * bound;
    for (std::size_t k = begin; k < end; ++k) {
        const double d = old[k].sphere >= 0 ? (point_of(old[k]) - point).squaredNorm() : square;
        if (old[k].sphere >= 0 && d <= square) {
            square = d;
            nearest = k;
        }
    }
    return nearest;
}

} // namespace proveta
