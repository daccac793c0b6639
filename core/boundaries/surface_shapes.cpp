#include "core/boundaries/surface_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace proveta {

namespace {

std::uint32_t put(SurfaceMesh& mesh, const Vec3& v) {
    mesh.vertex.push_back(v);
    return static_cast<std::uint32_t>(mesh.vertex.size() - 1);
}

// Corners of a regular polygon about z, counter-clockwise seen from above.
std::vector<std::uint32_t> ring(SurfaceMesh& mesh, double radius, double z, int sides) {
    std::vector<std::uint32_t> out;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / sides;
        out.push_back(put(mesh, {radius * std::cos(angle), radius * std::sin(angle), z}));
    }
    return out;
}

// Vertex in the middle of an edge, made once.
class Middles {
  public:
    explicit Middles(SurfaceMesh& mesh) : mesh_(mesh) {}

    std::uint32_t operator()(std::uint32_t a, std::uint32_t b) {
        const auto [at, made] = known_.try_emplace(std::pair(std::min(a, b), std::max(a, b)), 0U);
        if (made) {
            at->second = put(mesh_, 0.5 * (mesh_.vertex[a] + mesh_.vertex[b]));
        }
        return at->second;
    }

  private:
    SurfaceMesh& mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_;
};

} // namespace

SurfaceMesh plane_surface(double length_x, double length_y) {
    SurfaceMesh mesh;
    const double x = 0.5 * length_x;
    const double y = 0.5 * length_y;
    mesh.vertex = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    mesh.add({0, 1, 2, 3});
    return mesh;
}

SurfaceMesh box_surface(const Vec3& size) {
    SurfaceMesh mesh;
    for (int k = 0; k < 8; ++k) {
        mesh.vertex.emplace_back(Vec3((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5).cwiseProduct(size));
    }
    for (const auto& face :
         {std::vector<std::uint32_t>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh.add(face);
    }
    return mesh;
}

SurfaceMesh disc_surface(double radius, int sides) {
    SurfaceMesh mesh;
    mesh.add(ring(mesh, radius, 0.0, sides));
    return mesh;
}

SurfaceMesh cylinder_surface(double bottom_radius, double top_radius, double height, int sides, bool bottom, bool top, int rows) {
    SurfaceMesh mesh;
    using Ring = std::vector<std::uint32_t>; // of one corner: the apex
    const auto level = [&](int k) {
        const double t = static_cast<double>(k) / rows;
        const double radius = bottom_radius + t * (top_radius - bottom_radius);
        return radius == 0.0 ? Ring{put(mesh, {0, 0, t * height})} : ring(mesh, radius, t * height, sides);
    };
    const auto n = static_cast<std::size_t>(sides);
    const Ring lowest = level(0);
    Ring low = lowest;
    for (int row = 0; row < rows; ++row) {
        Ring high = level(row + 1);
        for (std::size_t a = 0; a < n; ++a) {
            const std::size_t b = (a + 1) % n;
            if (low.size() == 1) {
                mesh.add({low[0], high[b], high[a]});
            } else if (high.size() == 1) {
                mesh.add({low[a], low[b], high[0]});
            } else {
                mesh.add({low[a], low[b], high[b], high[a]});
            }
        }
        low = std::move(high);
    }
    if (bottom && lowest.size() > 1) {
        mesh.add({lowest.rbegin(), lowest.rend()});
    }
    if (top && low.size() > 1) {
        mesh.add(low);
    }
    return mesh;
}

SurfaceMesh sphere_surface(double radius, int cuts) {
    SurfaceMesh mesh;
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    mesh.vertex = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    constexpr std::array<std::array<std::uint32_t, 3>, 20> faces{
        {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
         {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    for (const auto& face : faces) {
        mesh.add({face[0], face[1], face[2]});
    }
    const auto blow_up = [&] {
        for (auto& v : mesh.vertex) {
            v *= radius / v.norm();
        }
    };
    blow_up();
    for (int k = 0; k < cuts; ++k) {
        mesh = refined(mesh);
        blow_up();
    }
    return mesh;
}

SurfaceMesh helix_surface(double inner_radius, double outer_radius, double pitch, double height, int steps, int rings) {
    SurfaceMesh mesh;
    const double turns = height / std::fabs(pitch);
    const int along = std::max(1, static_cast<int>(std::ceil(turns * steps - 1e-9)));
    const double way = pitch > 0.0 ? 1.0 : -1.0;
    const auto columns = static_cast<std::uint32_t>(rings + 1);
    for (int k = 0; k <= along; ++k) {
        const double share = static_cast<double>(k) / along;
        const double angle = way * 2.0 * std::numbers::pi * turns * share;
        for (int r = 0; r <= rings; ++r) {
            const double radius = inner_radius + (outer_radius - inner_radius) * r / rings;
            put(mesh, {radius * std::cos(angle), radius * std::sin(angle), height * share});
        }
    }
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(along); ++k) {
        for (std::uint32_t r = 0; r + 1 < columns; ++r) {
            const std::uint32_t a = k * columns + r;
            mesh.add({a, a + 1, a + columns + 1});
            mesh.add({a, a + columns + 1, a + columns});
        }
    }
    return mesh;
}

SurfaceMesh refined(const SurfaceMesh& mesh) {
    SurfaceMesh out;
    out.vertex = mesh.vertex;
    Middles middle(out);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::size_t n = mesh.corners(f);
        const auto* corner = &mesh.corner[mesh.first[f]];
        std::vector<std::uint32_t> half;
        for (std::size_t k = 0; k < n; ++k) {
            half.push_back(middle(corner[k], corner[(k + 1) % n]));
        }
        if (n == 3) {
            out.add(half);
        }
        Vec3 centre = Vec3::Zero();
        for (std::size_t k = 0; k < n; ++k) {
            centre += mesh.at(f, k) / static_cast<double>(n);
        }
        const std::uint32_t inside = n == 3 ? 0 : put(out, centre);
        for (std::size_t k = 0; k < n; ++k) {
            const std::uint32_t before = half[(k + n - 1) % n];
            out.add(n == 3 ? std::vector<std::uint32_t>{corner[k], half[k], before}
                           : std::vector<std::uint32_t>{corner[k], half[k], inside, before});
        }
    }
    return out;
}

SurfaceMesh triangulated(const SurfaceMesh& mesh) {
    SurfaceMesh out;
    out.vertex = mesh.vertex;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const auto* corner = &mesh.corner[mesh.first[f]];
        for (std::size_t k = 1; k + 1 < mesh.corners(f); ++k) {
            out.add({corner[0], corner[k], corner[k + 1]});
        }
    }
    return out;
}

} // namespace proveta
