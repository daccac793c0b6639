#include "core/solids/solid_shapes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/boundaries/surface_shapes.hpp"

namespace proveta {

namespace {

void require(bool met, const char* what) {
    if (!met) {
        throw std::invalid_argument(what);
    }
}

std::uint32_t put(SolidMesh& mesh, const Vec3& v) {
    mesh.node.push_back(v);
    return static_cast<std::uint32_t>(mesh.node.size() - 1);
}

// A group of the nodes for which `in` holds.
template <class In> void add_group(SolidMesh& mesh, const char* name, const In& in) {
    SolidMesh::Group group{name, {}};
    for (std::uint32_t n = 0; n < mesh.node.size(); ++n) {
        if (in(n)) {
            group.node.push_back(n);
        }
    }
    mesh.groups.push_back(std::move(group));
}

// Groups x-, x+ and so on of the first `axes` axes. The nodes of a side have its coordinate to the last bit: it is worked out the same way
// for all of them.
void add_sides(SolidMesh& mesh, const Vec3& low, const Vec3& high, Eigen::Index axes) {
    constexpr std::array<std::array<const char*, 2>, 3> name{{{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}}};
    for (Eigen::Index axis = 0; axis < axes; ++axis) {
        const auto& names = name[static_cast<std::size_t>(axis)];
        add_group(mesh, names[0], [&](std::uint32_t n) { return mesh.node[n][axis] == low[axis]; });
        add_group(mesh, names[1], [&](std::uint32_t n) { return mesh.node[n][axis] == high[axis]; });
    }
}

// A point of a grid from -length / 2 to length / 2.
double step(double length, int k, int n) { return (static_cast<double>(k) / n - 0.5) * length; }

// Six tetrahedra around the diagonal from corner 0 to 6: each follows the axes to the far corner in one of the six orders.
void cut(const SolidMesh::Hexahedron& h, std::vector<SolidMesh::Tetrahedron>& out) {
    constexpr std::array<std::array<std::size_t, 2>, 6> way{{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}};
    for (const auto& [a, b] : way) {
        out.push_back({h[0], h[a], h[b], h[6]});
    }
}

// Place in a unit core of a cylinder of the point (u, v) of the square from -1 to 1. Between a square and a circle: a third of the bulge
// makes the three cells that meet at each corner have near equal angles.
Eigen::Vector2d core_place(double u, double v) {
    constexpr double bulge = 1.0 / 3.0;
    const bool wide = std::fabs(u) >= std::fabs(v);
    const double reach = wide ? u : v;
    const double angle = reach == 0.0 ? 0.0 : 0.25 * std::numbers::pi * (wide ? v : u) / reach;
    const Eigen::Vector2d round =
        reach * (wide ? Eigen::Vector2d(std::cos(angle), std::sin(angle)) : Eigen::Vector2d(std::sin(angle), std::cos(angle)));
    return (1.0 - bulge) * std::numbers::sqrt2 / 2.0 * Eigen::Vector2d(u, v) + bulge * round;
}

// The cross-section of a cylinder: points of its core's grid row by row, then ring after ring, counter-clockwise from the corner at -135
// degrees; and its quadrilaterals, counter-clockwise.
struct Section {
    std::vector<Eigen::Vector2d> point;
    std::vector<std::array<std::uint32_t, 4>> cell;
    std::uint32_t around = 0;    // points on a ring
    std::uint32_t outermost = 0; // the first of the outer ring
};

// Points of the core's edge, in the order of the rings.
std::vector<std::uint32_t> core_edge(std::uint32_t core) {
    std::vector<std::uint32_t> out;
    const std::uint32_t row = core + 1;
    for (std::uint32_t k = 0; k < core; ++k) {
        out.push_back(k);
    }
    for (std::uint32_t k = 0; k < core; ++k) {
        out.push_back(k * row + core);
    }
    for (std::uint32_t k = 0; k < core; ++k) {
        out.push_back(core * row + core - k);
    }
    for (std::uint32_t k = 0; k < core; ++k) {
        out.push_back((core - k) * row);
    }
    return out;
}

void add_core(Section& section, double radius, int core) {
    for (int j = 0; j <= core; ++j) {
        for (int i = 0; i <= core; ++i) {
            section.point.emplace_back(radius * core_place(step(2.0, i, core), step(2.0, j, core)));
        }
    }
    const auto n = static_cast<std::uint32_t>(core);
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            section.cell.push_back({a, a + 1, a + n + 2, a + n + 1});
        }
    }
}

void add_rings(Section& section, double radius, int core, int rings) {
    std::vector<std::uint32_t> inner = core_edge(static_cast<std::uint32_t>(core));
    const std::vector<std::uint32_t> edge = inner;
    section.around = static_cast<std::uint32_t>(edge.size());
    for (int ring = 1; ring <= rings; ++ring) {
        std::vector<std::uint32_t> outer;
        section.outermost = static_cast<std::uint32_t>(section.point.size());
        for (std::size_t k = 0; k < edge.size(); ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / section.around - 0.75 * std::numbers::pi;
            const Eigen::Vector2d rim = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
            const double share = static_cast<double>(ring) / rings;
            outer.push_back(static_cast<std::uint32_t>(section.point.size()));
            section.point.emplace_back((1.0 - share) * section.point[edge[k]] + share * rim);
        }
        for (std::size_t a = 0; a < edge.size(); ++a) {
            const std::size_t b = (a + 1) % edge.size();
            section.cell.push_back({inner[a], outer[a], outer[b], inner[b]});
        }
        inner = std::move(outer);
    }
}

Section section_of(double radius, int core, int rings) {
    Section section;
    // Cells of the rings as thick as those of the core are wide.
    add_core(section, radius / (1.0 + std::numbers::sqrt2 * rings / core), core);
    add_rings(section, radius, core, rings);
    return section;
}

} // namespace

SolidMesh box_mesh(const Vec3& size, int nx, int ny, int nz, bool tetrahedra) {
    require(nx > 0 && ny > 0 && nz > 0, "a box needs a cell along each axis");
    SolidMesh mesh;
    for (int k = 0; k <= nz; ++k) {
        for (int j = 0; j <= ny; ++j) {
            for (int i = 0; i <= nx; ++i) {
                put(mesh, {step(size.x(), i, nx), step(size.y(), j, ny), step(size.z(), k, nz)});
            }
        }
    }
    const auto row = static_cast<std::uint32_t>(nx + 1);
    const auto layer = row * static_cast<std::uint32_t>(ny + 1);
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(nz); ++k) {
        for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(ny); ++j) {
            for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(nx); ++i) {
                const std::uint32_t a = k * layer + j * row + i;
                const std::uint32_t b = a + layer;
                const SolidMesh::Hexahedron cell{a, a + 1, a + row + 1, a + row, b, b + 1, b + row + 1, b + row};
                if (tetrahedra) {
                    cut(cell, mesh.tetrahedra);
                } else {
                    mesh.hexahedra.push_back(cell);
                }
            }
        }
    }
    add_sides(mesh, -0.5 * size, 0.5 * size, 3);
    return mesh;
}

SolidMesh cylinder_mesh(double radius, double height, int core, int rings, int layers) {
    require(core > 0 && rings > 0 && layers > 0, "a cylinder needs a cell in its core, a ring around it and a layer");
    SolidMesh mesh;
    const Section section = section_of(radius, core, rings);
    const auto per_layer = static_cast<std::uint32_t>(section.point.size());
    for (int layer = 0; layer <= layers; ++layer) {
        for (const auto& p : section.point) {
            put(mesh, {p.x(), p.y(), height * layer / layers});
        }
    }
    for (std::uint32_t layer = 0; layer < static_cast<std::uint32_t>(layers); ++layer) {
        const std::uint32_t low = layer * per_layer;
        const std::uint32_t high = low + per_layer;
        for (const auto& [a, b, c, d] : section.cell) {
            mesh.hexahedra.push_back({low + a, low + b, low + c, low + d, high + a, high + b, high + c, high + d});
        }
    }
    const auto top = per_layer * static_cast<std::uint32_t>(layers);
    add_group(mesh, "z-", [&](std::uint32_t n) { return n < per_layer; });
    add_group(mesh, "z+", [&](std::uint32_t n) { return n >= top; });
    add_group(mesh, "side", [&](std::uint32_t n) { return n % per_layer >= section.outermost; });
    return mesh;
}

SolidMesh tube_membrane(double radius, double height, int around, int layers) {
    require(around > 2 && layers > 0, "a tube needs three nodes around and a layer");
    SolidMesh mesh;
    for (int layer = 0; layer <= layers; ++layer) {
        for (int k = 0; k < around; ++k) {
            const double angle =
                2.0 * std::numbers::pi * (k + 0.5 * (layer % 2)) / around; // turning on and on would only number nodes otherwise
            put(mesh, {radius * std::cos(angle), radius * std::sin(angle), height * layer / layers});
        }
    }
    const auto n = static_cast<std::uint32_t>(around);
    for (std::uint32_t layer = 0; layer < static_cast<std::uint32_t>(layers); ++layer) {
        const std::uint32_t low = layer * n;
        const std::uint32_t high = low + n;
        for (std::uint32_t a = 0; a < n; ++a) {
            const std::uint32_t b = (a + 1) % n;
            if (layer % 2 == 0) { // the upper node a stands between the lower a and b
                mesh.membranes.push_back({low + a, low + b, high + a});
                mesh.membranes.push_back({low + b, high + b, high + a});
            } else {
                mesh.membranes.push_back({low + a, low + b, high + b});
                mesh.membranes.push_back({low + a, high + b, high + a});
            }
        }
    }
    const auto top = n * static_cast<std::uint32_t>(layers);
    add_group(mesh, "z-", [&](std::uint32_t k) { return k < n; });
    add_group(mesh, "z+", [&](std::uint32_t k) { return k >= top; });
    return mesh;
}

SolidMesh sphere_membrane(double radius, int cuts) {
    require(cuts >= 0, "a sphere is cut no times or more");
    const SurfaceMesh surface = sphere_surface(radius, cuts);
    SolidMesh mesh;
    mesh.node = surface.vertex;
    for (std::size_t f = 0; f < surface.faces(); ++f) {
        const auto* corner = &surface.corner[surface.first[f]];
        mesh.membranes.push_back({corner[0], corner[1], corner[2]});
    }
    return mesh;
}

SolidMesh sheet_membrane(double length_x, double length_y, int nx, int ny) {
    require(nx > 0 && ny > 0, "a sheet needs a cell along each side");
    SolidMesh mesh;
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) {
            put(mesh, {step(length_x, i, nx), step(length_y, j, ny), 0.0});
        }
    }
    const auto row = static_cast<std::uint32_t>(nx + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(ny); ++j) {
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = j * row + i;
            const std::uint32_t d = a + row;
            if ((i + j) % 2 == 0) {
                mesh.membranes.push_back({a, a + 1, d + 1});
                mesh.membranes.push_back({a, d + 1, d});
            } else {
                mesh.membranes.push_back({a, a + 1, d});
                mesh.membranes.push_back({a + 1, d + 1, d});
            }
        }
    }
    const Vec3 half(0.5 * length_x, 0.5 * length_y, 0.0);
    add_sides(mesh, -half, half, 2);
    add_group(mesh, "rim",
              [&](std::uint32_t n) { return std::fabs(mesh.node[n].x()) == half.x() || std::fabs(mesh.node[n].y()) == half.y(); });
    return mesh;
}

} // namespace proveta
