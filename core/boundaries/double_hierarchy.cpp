#include "core/boundaries/double_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace proveta {

SurfaceGeometry::SurfaceGeometry(SurfaceMesh surface) : mesh(std::move(surface)) {
    corner.reserve(mesh.corner.size());
    for (const auto v : mesh.corner) {
        corner.push_back(mesh.vertex[v]);
    }
    plane.reserve(mesh.faces());
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Vec3 n = mesh.twice_area(f).normalized();
        double offset = 0.0;
        for (std::size_t k = 0; k < mesh.corners(f); ++k) {
            offset += n.dot(mesh.at(f, k));
        }
        plane.push_back({n, offset / static_cast<double>(mesh.corners(f))});
    }
}

namespace {

// The first edge that the centre's projection onto the face lies outside of; the number of corners if there is none (3.5-3.6). What it lies
// on counts as inside.
std::size_t first_outside(std::span<const Vec3> v, const Vec3& normal, const Vec3& centre) {
    for (std::size_t a = 0; a < v.size(); ++a) {
        const Vec3 edge = v[a + 1 < v.size() ? a + 1 : 0] - v[a];
        if (edge.cross(centre - v[a]).dot(normal) < 0.0) { // the centre instead of its projection: they differ along the normal
            return a;
        }
    }
    return v.size();
}

} // namespace

bool cuts(const SurfaceGeometry& surface, std::uint32_t face, const Vec3& centre, double radius) {
    const FacePlane& plane = surface.plane[face];
    const double height = plane.normal.dot(centre) - plane.offset;
    if (std::fabs(height) > radius) {
        return false;
    }
    const auto v = surface.corners(face);
    std::size_t a = first_outside(v, plane.normal, centre);
    if (a == v.size()) {
        return true;
    }
    for (; a < v.size(); ++a) {
        const Vec3 edge = v[a + 1 < v.size() ? a + 1 : 0] - v[a];
        const Vec3 from = centre - v[a];
        const double along = std::clamp(from.dot(edge) / edge.squaredNorm(), 0.0, 1.0); // beyond its ends the vertices stand for the edge
        if ((from - along * edge).squaredNorm() <= radius * radius) {
            return true;
        }
    }
    return false;
}

FaceContact nearest_on_face(const SurfaceGeometry& surface, std::uint32_t face, const Vec3& centre) {
    const FacePlane& plane = surface.plane[face];
    const auto v = surface.corners(face);
    std::size_t a = first_outside(v, plane.normal, centre);
    if (a == v.size()) {
        const double height = plane.normal.dot(centre) - plane.offset;
        return {centre - height * plane.normal, height * height, face, Feature::facet, 0};
    }
    FaceContact best{{}, std::numeric_limits<double>::infinity(), face, Feature::edge, 0};
    for (; a < v.size(); ++a) { // edges before the first outside one cannot hold the nearest point
        const std::size_t b = a + 1 < v.size() ? a + 1 : 0;
        const Vec3 edge = v[b] - v[a];
        const Vec3 from = centre - v[a];
        const double along = from.dot(edge) / edge.squaredNorm();
        const bool inner = along > 0.0 && along < 1.0;
        const std::size_t end = along <= 0.0 ? a : b;
        const Vec3 point = inner ? Vec3(v[a] + along * edge) : v[end];
        const double square = (centre - point).squaredNorm();
        if (square < best.square) {
            best = {point, square, face, inner ? Feature::edge : Feature::vertex, static_cast<std::uint8_t>(inner ? a : end)};
        }
    }
    return best;
}

void double_hierarchy(const SurfaceGeometry& surface, std::span<const std::uint32_t> faces, const Vec3& centre, double radius,
                      std::vector<FaceContact>& found, std::vector<SlaveFace>* slaves) {
    found.clear();
    if (slaves != nullptr) {
        slaves->clear();
    }
    for (const auto face : faces) {
        if (!cuts(surface, face, centre, radius)) {
            continue;
        }
        const FaceContact contact = nearest_on_face(surface, face, centre);
        if (contact.square <= radius * radius) {
            found.push_back(contact);
        }
    }
    if (found.size() < 2) {
        if (slaves != nullptr && !found.empty()) {
            slaves->push_back({found.front().face, 0});
        }
        return;
    }
    // Equal distances, of neighbours that share the point, in the order of the faces.
    std::sort(found.begin(), found.end(),
              [](const FaceContact& a, const FaceContact& b) { return a.square != b.square ? a.square < b.square : a.face < b.face; });
    // What rounding makes of the products when the centre all but lies on a face.
    const double rounding = 1e-15 * (centre.lpNorm<Eigen::Infinity>() + radius) * radius;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Vec3 new_one = centre - found[i].point;
        const auto end = found.begin() + static_cast<std::ptrdiff_t>(valid);
        const auto master = std::find_if(found.begin(), end, [&](const FaceContact& nearer) {
            return new_one.dot(centre - nearer.point) >= nearer.square * (1.0 - coplanar) - rounding;
        });
        if (slaves != nullptr) {
            slaves->push_back({found[i].face, static_cast<std::uint32_t>(master - found.begin())});
        }
        if (master == end) {
            found[valid++] = found[i];
        }
    }
    found.resize(valid);
}

std::vector<double> contact_weights(const SurfaceGeometry& surface, const FaceContact& contact) {
    const auto v = surface.corners(contact.face);
    const std::size_t n = v.size();
    std::vector<double> w(n, 0.0);
    if (contact.feature == Feature::vertex) {
        w[contact.index] = 1.0;
        return w;
    }
    if (contact.feature == Feature::edge) {
        const std::size_t b = (contact.index + 1U) % n;
        const Vec3 edge = v[b] - v[contact.index];
        w[b] = (contact.point - v[contact.index]).dot(edge) / edge.squaredNorm();
        w[contact.index] = 1.0 - w[b];
        return w;
    }
    const Vec3& normal = surface.plane[contact.face].normal;
    std::vector<double> over(n); // twice the areas of the triangles between the point and the edges
    for (std::size_t a = 0; a < n; ++a) {
        over[a] = std::max(0.0, (v[(a + 1) % n] - v[a]).cross(contact.point - v[a]).dot(normal));
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        // The triangle of the corner and its neighbours, times the areas over all edges that do not meet in the corner.
        const std::size_t before = (k + n - 1) % n;
        w[k] = (v[k] - v[before]).cross(v[(k + 1) % n] - v[k]).dot(normal);
        for (std::size_t a = 0; a < n; ++a) {
            w[k] *= a == before || a == k ? 1.0 : over[a];
        }
        sum += w[k];
    }
    for (auto& weight : w) {
        weight /= sum;
    }
    return w;
}

} // namespace proveta
