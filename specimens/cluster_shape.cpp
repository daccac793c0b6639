#include "specimens/cluster_shape.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <stdexcept>

#include "core/boundaries/double_hierarchy.hpp"

namespace proveta {

namespace {

// Volume and moments about the origin, summed over pieces.
struct Moments {
    double volume = 0.0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();

    [[nodiscard]] MassProperties properties() const {
        MassProperties p;
        p.volume = volume;
        p.centre = first / volume;
        const Mat3 about = second - volume * p.centre * p.centre.transpose();
        p.inertia = about.trace() * Mat3::Identity() - about;
        return p;
    }
};

// Where a body lies, as a grid of points in the middle of cells.
struct Grid {
    Vec3 low;
    double cell = 0.0;
    Eigen::Array3i count;

    Grid(const SurfaceMesh& mesh, int cells) {
        Eigen::AlignedBox3d box;
        for (const auto& v : mesh.vertex) {
            box.extend(v);
        }
        low = box.min();
        cell = box.sizes().maxCoeff() / cells;
        count = (box.sizes().array() / cell).ceil().cast<int>().max(1);
    }
    [[nodiscard]] int size() const { return count.prod(); }
    [[nodiscard]] Vec3 at(int k) const {
        const int layer = count[0] * count[1];
        const Eigen::Vector3i cells(k % count[0], k % layer / count[0], k / layer);
        return low + cell * (cells.cast<double>() + Vec3::Constant(0.5));
    }
};

// Solid angle of a closed surface seen from a point, over 4 pi: 1 inside, 0 outside (Van Oosterom and Strackee 1983).
double winding(const SurfaceMesh& mesh, const Vec3& from) {
    double sum = 0.0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        for (std::size_t k = 1; k + 1 < mesh.corners(f); ++k) {
            const Vec3 a = mesh.at(f, 0) - from, b = mesh.at(f, k) - from, c = mesh.at(f, k + 1) - from;
            const double la = a.norm(), lb = b.norm(), lc = c.norm();
            sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
        }
    }
    return sum / (2.0 * std::numbers::pi);
}

// Distance of a point inside from the surface; negative outside.
double depth(const SurfaceGeometry& surface, const Vec3& point) {
    double square = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < surface.mesh.faces(); ++f) {
        square = std::min(square, nearest_on_face(surface, f, point).square);
    }
    return std::fabs(winding(surface.mesh, point)) > 0.5 ? std::sqrt(square) : -std::sqrt(square);
}

// Right-handed, by ascending moment.
Mat3 principal_axes(const Mat3& inertia, Vec3& moments) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
    moments = solver.eigenvalues();
    Mat3 axes = solver.eigenvectors();
    if (axes.determinant() < 0.0) {
        axes.col(0) *= -1.0;
    }
    return axes;
}

void require_closed(const SurfaceMesh& mesh) {
    const SurfaceState state = look_at(mesh);
    if (!state.closed()) {
        throw std::invalid_argument("the surface is not closed: " + state.notes.front());
    }
}

} // namespace

MassProperties mass_properties(const SurfaceMesh& mesh) {
    require_closed(mesh);
    Moments m;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        for (std::size_t k = 1; k + 1 < mesh.corners(f); ++k) {
            const Vec3& a = mesh.at(f, 0);
            const Vec3& b = mesh.at(f, k);
            const Vec3& c = mesh.at(f, k + 1);
            const double volume = a.dot(b.cross(c)) / 6.0; // of the tetrahedron with the origin
            const Vec3 sum = a + b + c;
            m.volume += volume;
            m.first += 0.25 * volume * sum;
            m.second += volume / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        }
    }
    if (m.volume < 0.0) { // normals inwards
        m = {-m.volume, -m.first, -m.second};
    }
    if (!(m.volume > 0.0)) {
        throw std::invalid_argument("the surface encloses no volume");
    }
    return m.properties();
}

MassProperties mass_properties(const std::vector<Vec3>& centre, const std::vector<double>& radius, int columns) {
    Eigen::AlignedBox3d box;
    for (std::size_t k = 0; k < centre.size(); ++k) {
        box.extend(Vec3(centre[k] - Vec3::Constant(radius[k])));
        box.extend(Vec3(centre[k] + Vec3::Constant(radius[k])));
    }
    if (box.isEmpty()) {
        throw std::invalid_argument("a cluster needs a sphere");
    }
    const double cell = std::max(box.sizes().x(), box.sizes().y()) / columns;
    Moments m;
    std::vector<std::pair<double, double>> pieces; // of a column inside spheres
    const auto cells = [&](int axis) { return static_cast<int>(std::ceil(box.sizes()[axis] / cell)); };
    for (int i = 0; i < cells(0); ++i) {
        for (int j = 0; j < cells(1); ++j) {
            const double x = box.min().x() + (i + 0.5) * cell;
            const double y = box.min().y() + (j + 0.5) * cell;
            pieces.clear();
            for (std::size_t k = 0; k < centre.size(); ++k) {
                const double square =
                    radius[k] * radius[k] - (x - centre[k].x()) * (x - centre[k].x()) - (y - centre[k].y()) * (y - centre[k].y());
                if (square > 0.0) {
                    pieces.emplace_back(centre[k].z() - std::sqrt(square), centre[k].z() + std::sqrt(square));
                }
            }
            std::sort(pieces.begin(), pieces.end());
            double reached = -std::numeric_limits<double>::infinity();
            for (const auto& [from, to] : pieces) {
                const double a = std::max(from, reached);
                if (to <= a) {
                    continue;
                }
                reached = to;
                const double area = cell * cell;
                const double length = to - a;
                const Vec3 middle(x, y, 0.5 * (a + to));
                m.volume += area * length;
                m.first += area * length * middle;
                m.second += area * length * (middle * middle.transpose());
                m.second += area * length / 12.0 * Vec3(cell * cell, cell * cell, length * length).asDiagonal().toDenseMatrix();
            }
        }
    }
    return m.properties();
}

ClusterShape cluster_shape(std::vector<Vec3> centre, std::vector<double> radius, const MassProperties& body) {
    ClusterShape shape;
    const Mat3 axes = principal_axes(body.inertia, shape.inertia);
    for (const auto& c : centre) {
        shape.centre.emplace_back(axes.transpose() * (c - body.centre));
    }
    shape.radius = std::move(radius);
    shape.volume = body.volume;
    return shape;
}

ClusterShape fill_with_spheres(const SurfaceMesh& mesh, const FillRule& rule) {
    const MassProperties body = mass_properties(mesh);
    const SurfaceGeometry surface{SurfaceMesh(mesh)};
    const Grid grid(mesh, rule.cells);
    std::vector<Vec3> point;
    std::vector<double> room; // radius of the sphere inscribed there
    for (int k = 0; k < grid.size(); ++k) {
        const double d = depth(surface, grid.at(k));
        if (d > 0.0) {
            point.push_back(grid.at(k));
            room.push_back(d);
        }
    }
    if (point.empty()) {
        throw std::invalid_argument("the solid is thinner than the grid's cells");
    }
    const double overhang = rule.overhang * *std::max_element(room.begin(), room.end());
    std::vector<char> filled(point.size(), 0);
    const auto gain = [&](std::size_t k) {
        const double reach = room[k] + overhang;
        std::size_t n = 0;
        for (std::size_t p = 0; p < point.size(); ++p) {
            n += filled[p] == 0 && (point[p] - point[k]).squaredNorm() <= reach * reach ? 1 : 0;
        }
        return n;
    };
    // What a sphere fills of the rest only falls as others come: an old figure is a bound, and the best of the bounds is looked at anew.
    std::priority_queue<std::pair<double, std::size_t>> best;
    for (std::size_t k = 0; k < point.size(); ++k) {
        best.emplace(std::pow(room[k] + overhang, 3.0) * 4.2 / std::pow(grid.cell, 3.0) * 1.5 + 8.0, k);
    }
    std::vector<Vec3> centre;
    std::vector<double> radius;
    std::size_t done = 0;
    while (static_cast<int>(centre.size()) < rule.spheres &&
           static_cast<double>(done) < rule.coverage * static_cast<double>(point.size())) {
        const std::size_t k = best.top().second;
        best.pop();
        const std::size_t now = gain(k);
        if (!best.empty() && static_cast<double>(now) < best.top().first) {
            best.emplace(static_cast<double>(now), k);
            continue;
        }
        if (now == 0) {
            break;
        }
        const double reach = room[k] + overhang;
        for (std::size_t p = 0; p < point.size(); ++p) {
            filled[p] = static_cast<char>(filled[p] != 0 || (point[p] - point[k]).squaredNorm() <= reach * reach);
        }
        done += now;
        centre.push_back(point[k]);
        radius.push_back(reach);
    }
    return cluster_shape(std::move(centre), std::move(radius), body);
}

Fit fit_of(const SurfaceMesh& mesh, const ClusterShape& shape, int cells) {
    const MassProperties body = mass_properties(mesh);
    Vec3 moments;
    const Mat3 axes = principal_axes(body.inertia, moments);
    const Grid grid(mesh, cells);
    std::size_t inside = 0, filled = 0;
    for (int k = 0; k < grid.size(); ++k) {
        if (std::fabs(winding(mesh, grid.at(k))) > 0.5) {
            const Vec3 own = axes.transpose() * (grid.at(k) - body.centre);
            ++inside;
            for (std::size_t s = 0; s < shape.radius.size(); ++s) {
                if ((own - shape.centre[s]).norm() <= shape.radius[s]) {
                    ++filled;
                    break;
                }
            }
        }
    }
    const double share = inside > 0 ? static_cast<double>(filled) / static_cast<double>(inside) : 0.0;
    const double spheres = mass_properties(shape.centre, shape.radius).volume;
    return {share, std::max(0.0, 1.0 - share * body.volume / spheres)};
}

} // namespace proveta
