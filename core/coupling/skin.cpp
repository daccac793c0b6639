#include "core/coupling/skin.hpp"

#include <algorithm>

namespace proveta {

namespace {

Vec3 centroid(const SkinFace& f, const std::vector<Vec3>& at) {
    return 0.25 * (at[f.node[0]] + at[f.node[1]] + at[f.node[2]] + at[f.node[3]]);
}

} // namespace

Skin::Skin(const std::vector<SkinFace>& faces, const std::vector<Vec3>& nodes)
    : faces_(faces), nodes_(static_cast<std::uint32_t>(nodes.size())) {
    SurfaceMesh mesh;
    mesh.vertex = nodes;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto& n = faces[f].node;
        if (!faces[f].quadrilateral) {
            mesh.add({n[0], n[1], n[2]});
            continue;
        }
        const auto middle = static_cast<std::uint32_t>(mesh.vertex.size());
        mesh.vertex.push_back(centroid(faces[f], nodes));
        centre_of_.push_back(static_cast<std::uint32_t>(f));
        for (std::size_t k = 0; k < 4; ++k) {
            mesh.add({n[k], n[(k + 1) % 4], middle});
        }
    }
    velocity_.assign(mesh.vertex.size(), Vec3::Zero());
    geometry_ = SurfaceGeometry(std::move(mesh));
}

void Skin::follow(const std::vector<Vec3>& position, const std::vector<Vec3>& velocity, Team& team) {
    auto& vertex = geometry_.mesh.vertex;
    std::copy(position.begin(), position.end(), vertex.begin());
    std::copy(velocity.begin(), velocity.end(), velocity_.begin());
    for (std::size_t k = 0; k < centre_of_.size(); ++k) {
        vertex[nodes_ + k] = centroid(faces_[centre_of_[k]], position);
        velocity_[nodes_ + k] = centroid(faces_[centre_of_[k]], velocity);
    }
    constexpr std::size_t per_part = 512;
    team.run((triangles() + per_part - 1) / per_part, [&](std::size_t part) {
        for (std::size_t t = part * per_part; t < std::min(triangles(), (part + 1) * per_part); ++t) {
            Vec3* corner = &geometry_.corner[3 * t];
            for (std::size_t c = 0; c < 3; ++c) {
                corner[c] = vertex[geometry_.mesh.corner[3 * t + c]];
            }
            const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
            geometry_.plane[t] = {normal, normal.dot(corner[0] + corner[1] + corner[2]) / 3.0};
        }
    });
}

Vec3 Skin::coordinates(std::uint32_t t, const Vec3& p) const {
    const auto v = geometry_.corners(t);
    const Vec3& n = geometry_.plane[t].normal;
    const double whole = (v[1] - v[0]).cross(v[2] - v[0]).dot(n);
    const double first = (v[1] - p).cross(v[2] - p).dot(n) / whole;
    const double second = (v[2] - p).cross(v[0] - p).dot(n) / whole;
    return {first, second, 1.0 - first - second};
}

Vec3 Skin::point(std::uint32_t t, const Vec3& c) const {
    const auto v = geometry_.corners(t);
    return c[0] * v[0] + c[1] * v[1] + c[2] * v[2];
}

Vec3 Skin::velocity(std::uint32_t t, const Vec3& c) const {
    const std::uint32_t* v = &geometry_.mesh.corner[3 * t];
    return c[0] * velocity_[v[0]] + c[1] * velocity_[v[1]] + c[2] * velocity_[v[2]];
}

// Half the circulation of the velocity around the triangle over its area (Stokes).
double Skin::spin(std::uint32_t t) const {
    const auto v = geometry_.corners(t);
    const std::uint32_t* id = &geometry_.mesh.corner[3 * t];
    double around = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        around += 0.5 * (velocity_[id[a]] + velocity_[id[b]]).dot(v[b] - v[a]);
    }
    return around / (v[1] - v[0]).cross(v[2] - v[0]).dot(geometry_.plane[t].normal);
}

double Skin::tilt(std::uint32_t t) const {
    const auto v = geometry_.corners(t);
    const std::uint32_t* id = &geometry_.mesh.corner[3 * t];
    const Vec3 a = v[1] - v[0], b = v[2] - v[0];
    const Vec3 rate = (velocity_[id[1]] - velocity_[id[0]]).cross(b) + a.cross(velocity_[id[2]] - velocity_[id[0]]);
    const Vec3& n = geometry_.plane[t].normal;
    return (rate - n.dot(rate) * n).norm() / a.cross(b).norm();
}

} // namespace proveta
