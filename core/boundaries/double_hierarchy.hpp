// Contact of a sphere with a surface of planar convex faces: the Double Hierarchy method (thesis 3.2.2 to 3.4).
//
//   fast test   does the sphere cut the face at all (table 3.2)
//   type        facet before edge before vertex: the contact of one face (table 3.3)
//   distance    of two contacts, that which lies beyond the other's tangent plane gives way (table 3.4, (3.16))
//
// Of a convex face only the point nearest to the centre can survive the distance hierarchy, so that each face offers one contact. They
// are taken in the order of their distance, not of the faces: contacts do not depend on how a mesh is numbered, and what gives way to a
// contact that itself gives way is not lost.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/boundaries/surface_mesh.hpp"

namespace proveta {

enum class Feature : std::uint8_t { facet, edge, vertex };

/// A face as contact sees it.
struct FacePlane {
    Vec3 normal;   ///< unit vector
    double offset; ///< normal . x of its points, m
};

/// A mesh with what follows from it.
struct SurfaceGeometry {
    SurfaceGeometry() = default;
    /// Takes a mesh without degenerate faces.
    explicit SurfaceGeometry(SurfaceMesh surface);

    SurfaceMesh mesh;
    std::vector<FacePlane> plane; ///< per face
    std::vector<Vec3> corner;     ///< positions in the order of `mesh.corner`, m

    [[nodiscard]] std::span<const Vec3> corners(std::uint32_t face) const {
        return {corner.data() + mesh.first[face], corner.data() + mesh.first[face + 1]};
    }
};

/// Point of a face that a sphere touches.
struct FaceContact {
    Vec3 point;    ///< m
    double square; ///< of its distance from the centre, m2
    std::uint32_t face;
    Feature feature;
    std::uint8_t index; ///< of the edge (from this corner to the next) or the corner; 0 of a facet
};

/// Whether a sphere cuts a face (table 3.2).
bool cuts(const SurfaceGeometry& surface, std::uint32_t face, const Vec3& centre, double radius);

/// The point of a face nearest to a centre, by the hierarchy of contact types (table 3.3).
FaceContact nearest_on_face(const SurfaceGeometry& surface, std::uint32_t face, const Vec3& centre);

/// Relative tolerance of the distance hierarchy: neighbours that meet at less than 0.08 degrees count as one plane.
constexpr double coplanar = 1e-6;

/// A face that a sphere cuts, and which of its contacts it gave way to: the master of this slave (thesis, appendix B). A master is a slave
/// of its own.
struct SlaveFace {
    std::uint32_t face;
    std::uint32_t master; ///< position among the contacts
};

/// Contacts of a sphere with some faces, nearest first. `found` is emptied before; slaves, if they are wanted, too.
void double_hierarchy(const SurfaceGeometry& surface, std::span<const std::uint32_t> faces, const Vec3& centre, double radius,
                      std::vector<FaceContact>& found, std::vector<SlaveFace>* slaves = nullptr);

/// Weights of a face's corners at a contact: Wachspress' (3.17) on a facet, which are (3.13) in a triangle and (3.14) in a parallelogram;
/// linear on an edge (3.15). They are not negative, sum to 1, and the corners weighted by them give the point, so that a force shared out
/// by them keeps its moment; (3.14) does not do that in other quadrilaterals. One for each corner.
std::vector<double> contact_weights(const SurfaceGeometry& surface, const FaceContact& contact);

} // namespace proveta
