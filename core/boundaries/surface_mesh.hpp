// A surface of triangles and planar convex polygons, as it is, and what is wrong with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta {

/// Corners of a face in their order: counter-clockwise seen from where its normal points to.
struct SurfaceMesh {
    std::vector<Vec3> vertex;             ///< m
    std::vector<std::uint32_t> corner;    ///< vertices of all faces, one face after the other
    std::vector<std::uint32_t> first{0U}; ///< where each face's corners begin in `corner`; one more than there are faces

    [[nodiscard]] std::size_t faces() const { return first.size() - 1; }
    [[nodiscard]] std::size_t corners(std::size_t face) const { return first[face + 1] - first[face]; }
    [[nodiscard]] const Vec3& at(std::size_t face, std::size_t k) const { return vertex[corner[first[face] + k]]; }

    /// Appends a face of three corners or more.
    void add(const std::vector<std::uint32_t>& vertices);
    /// Appends another surface.
    void add(const SurfaceMesh& other);

    /// Sum of the edges' cross products about the first corner: twice the face's area along its normal, m2.
    [[nodiscard]] Vec3 twice_area(std::size_t face) const;
    [[nodiscard]] double area() const; ///< of all faces, m2
    /// Enclosed by a closed surface whose normals point outwards, m3; negative where they point inwards.
    [[nodiscard]] double volume() const;
};

/// What a look at a surface finds. Faces and edges are counted; the first of each kind is named in `notes`.
struct SurfaceState {
    std::size_t degenerate = 0;   ///< faces without area
    std::size_t bent = 0;         ///< polygons whose corners do not lie in a plane
    std::size_t concave = 0;      ///< polygons that are not convex
    std::size_t open_edges = 0;   ///< edges of one face only
    std::size_t forked_edges = 0; ///< edges of three faces or more
    std::size_t turned_edges = 0; ///< edges between two faces whose normals contradict each other
    std::size_t parts = 0;        ///< pieces that no edge connects
    std::vector<std::string> notes;

    /// Faces that contact cannot be worked out with.
    [[nodiscard]] bool usable() const { return bent == 0 && concave == 0; }
    [[nodiscard]] bool closed() const { return open_edges == 0 && forked_edges == 0 && turned_edges == 0; }
};
SurfaceState look_at(const SurfaceMesh& mesh);

/// A surface and which faces it was made without, by their numbers from 0.
struct WeldedSurface {
    SurfaceMesh mesh;
    std::vector<std::size_t> flat;     ///< without area
    std::vector<std::size_t> repeated; ///< of the same corners as one before, whichever way round
};

/// The same surface with vertices nearer than `tolerance` times its size made one, and without the faces that have no area then or are
/// there twice.
WeldedSurface welded(const SurfaceMesh& mesh, double tolerance = 1e-7);

} // namespace proveta
