#include "core/boundaries/surface_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

namespace proveta {

namespace {

// Corners may lie this far out of a polygon's plane or behind its edges, over its size.
constexpr double flat = 1e-5;

Eigen::AlignedBox3d box_of(const SurfaceMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const auto& v : mesh.vertex) {
        box.extend(v);
    }
    return box;
}

// Longest side of a face.
double longest(const SurfaceMesh& mesh, std::size_t f) {
    double square = 0.0;
    for (std::size_t k = 0; k < mesh.corners(f); ++k) {
        square = std::max(square, (mesh.at(f, (k + 1) % mesh.corners(f)) - mesh.at(f, k)).squaredNorm());
    }
    return std::sqrt(square);
}

bool degenerate(const SurfaceMesh& mesh, std::size_t f) {
    const double side = longest(mesh, f);
    return mesh.corners(f) < 3 || !(mesh.twice_area(f).norm() > 1e-12 * side * side);
}

bool bent(const SurfaceMesh& mesh, std::size_t f, const Vec3& normal) {
    const double tolerance = flat * longest(mesh, f);
    for (std::size_t k = 1; k < mesh.corners(f); ++k) {
        if (std::fabs(normal.dot(mesh.at(f, k) - mesh.at(f, 0))) > tolerance) {
            return true;
        }
    }
    return false;
}

// Some corner lies behind some edge.
bool concave(const SurfaceMesh& mesh, std::size_t f, const Vec3& normal) {
    const std::size_t n = mesh.corners(f);
    const double tolerance = flat * longest(mesh, f);
    for (std::size_t a = 0; a < n; ++a) {
        const Vec3 inward = normal.cross(mesh.at(f, (a + 1) % n) - mesh.at(f, a)).normalized();
        for (std::size_t k = 0; k < n; ++k) {
            if (inward.dot(mesh.at(f, k) - mesh.at(f, a)) < -tolerance) {
                return true;
            }
        }
    }
    return false;
}

struct Side {
    std::size_t face;
    bool forward; // from the lower vertex to the higher one
};
using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>>;

Edges edges_of(const SurfaceMesh& mesh) {
    Edges edges;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::size_t n = mesh.corners(f);
        for (std::size_t a = 0; a < n; ++a) {
            const auto from = mesh.corner[mesh.first[f] + a];
            const auto to = mesh.corner[mesh.first[f] + (a + 1) % n];
            edges[std::minmax(from, to)].push_back({f, from < to});
        }
    }
    return edges;
}

std::size_t root(std::vector<std::size_t>& parent, std::size_t f) {
    while (parent[f] != f) {
        f = parent[f] = parent[parent[f]];
    }
    return f;
}

} // namespace

void SurfaceMesh::add(const std::vector<std::uint32_t>& vertices) {
    corner.insert(corner.end(), vertices.begin(), vertices.end());
    first.push_back(static_cast<std::uint32_t>(corner.size()));
}

void SurfaceMesh::add(const SurfaceMesh& other) {
    const auto shift = static_cast<std::uint32_t>(vertex.size());
    vertex.insert(vertex.end(), other.vertex.begin(), other.vertex.end());
    for (std::size_t f = 0; f < other.faces(); ++f) {
        for (auto k = other.first[f]; k < other.first[f + 1]; ++k) {
            corner.push_back(other.corner[k] + shift);
        }
        first.push_back(static_cast<std::uint32_t>(corner.size()));
    }
}

Vec3 SurfaceMesh::twice_area(std::size_t face) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners(face); ++k) {
        sum += (at(face, k) - at(face, 0)).cross(at(face, k + 1) - at(face, 0));
    }
    return sum;
}

double SurfaceMesh::area() const {
    double sum = 0.0;
    for (std::size_t f = 0; f < faces(); ++f) {
        sum += 0.5 * twice_area(f).norm();
    }
    return sum;
}

double SurfaceMesh::volume() const {
    double sum = 0.0;
    for (std::size_t f = 0; f < faces(); ++f) {
        sum += at(f, 0).dot(twice_area(f)) / 6.0;
    }
    return sum;
}

SurfaceState look_at(const SurfaceMesh& mesh) {
    SurfaceState state;
    const auto count = [&](std::size_t& what, const std::string& note) {
        if (what++ == 0) {
            state.notes.push_back(note);
        }
    };
    const auto at = [&](std::size_t f) {
        const Vec3& v = mesh.at(f, 0);
        return "face " + std::to_string(f + 1) + " at (" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " +
               std::to_string(v.z()) + ") m";
    };
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        if (degenerate(mesh, f)) {
            count(state.degenerate, at(f) + " has no area");
            continue;
        }
        const Vec3 normal = mesh.twice_area(f).normalized();
        if (bent(mesh, f, normal)) {
            count(state.bent, at(f) + " is not plane");
        } else if (concave(mesh, f, normal)) {
            count(state.concave, at(f) + " is not convex");
        }
    }
    std::vector<std::size_t> parent(mesh.faces());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    for (const auto& [ends, sides] : edges_of(mesh)) {
        for (const auto& side : sides) {
            parent[root(parent, side.face)] = root(parent, sides.front().face);
        }
        if (sides.size() == 1) {
            count(state.open_edges, at(sides[0].face) + " has an edge without a neighbour");
        } else if (sides.size() > 2) {
            count(state.forked_edges, at(sides[0].face) + " shares an edge with more than one face");
        } else if (sides[0].forward == sides[1].forward) {
            count(state.turned_edges, at(sides[0].face) + " and its neighbour have normals to different sides");
        }
    }
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        state.parts += root(parent, f) == f ? 1 : 0;
    }
    return state;
}

WeldedSurface welded(const SurfaceMesh& mesh, double tolerance) {
    const auto box = box_of(mesh);
    const double reach = box.isEmpty() ? 0.0 : tolerance * box.diagonal().norm();
    WeldedSurface welded;
    SurfaceMesh& out = welded.mesh;
    std::vector<std::uint32_t> target(mesh.vertex.size());
    using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
    const auto hash = [](const Cell& c) { return static_cast<std::size_t>(c.x() * 73856093 ^ c.y() * 19349663 ^ c.z() * 83492791); };
    std::unordered_multimap<std::size_t, std::uint32_t> cells;
    const double width = reach > 0.0 ? 2.0 * reach : 1.0;
    for (std::size_t k = 0; k < mesh.vertex.size(); ++k) {
        const Vec3& v = mesh.vertex[k];
        // Cells twice as wide as the reach: a near vertex lies in the cell itself or in one beside it. Counted from a corner of the
        // surface, which may lie far away for its size.
        const Cell cell = ((v - box.min()) / width).array().floor().matrix().cast<std::int64_t>();
        std::uint32_t found = static_cast<std::uint32_t>(out.vertex.size());
        for (int n = 0; n < 27; ++n) {
            const auto [begin, end] = cells.equal_range(hash(cell + Cell(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
            for (auto it = begin; it != end; ++it) {
                if ((out.vertex[it->second] - v).norm() <= reach) {
                    found = std::min(found, it->second);
                }
            }
        }
        if (found == out.vertex.size()) {
            out.vertex.push_back(v);
            cells.emplace(hash(cell), found);
        }
        target[k] = found;
    }
    std::set<std::vector<std::uint32_t>> known;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        std::vector<std::uint32_t> face;
        for (std::size_t k = 0; k < mesh.corners(f); ++k) {
            const auto v = target[mesh.corner[mesh.first[f] + k]];
            if (face.empty() || (face.back() != v && face.front() != v)) {
                face.push_back(v);
            }
        }
        auto sorted = face;
        std::sort(sorted.begin(), sorted.end());
        out.add(face);
        const bool flat = degenerate(out, out.faces() - 1);
        if (flat || !known.insert(sorted).second) {
            (flat ? welded.flat : welded.repeated).push_back(f);
            out.first.pop_back();
            out.corner.resize(out.first.back());
        }
    }
    return welded;
}

} // namespace proveta
