#include "specimens/stones.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voro++/voro++.hh>

#include "specimens/cluster_shape.hpp"

namespace proveta {

namespace {

Vec3 direction(Random& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

// Directions that keep away from each other: of ten candidates the one farthest from all before (D. Mitchell, SIGGRAPH 1991, 157).
std::vector<Vec3> directions(int n, Random& random) {
    std::vector<Vec3> out;
    while (static_cast<int>(out.size()) < n) {
        Vec3 best = Vec3::Zero();
        double lowest = 2.0; // cosine of the angle to the nearest one
        for (int k = 0; k < 10; ++k) {
            const Vec3 candidate = direction(random);
            double nearest = -1.0;
            for (const auto& other : out) {
                nearest = std::max(nearest, other.dot(candidate));
            }
            if (nearest < lowest) {
                lowest = nearest;
                best = candidate;
            }
        }
        out.push_back(best);
    }
    return out;
}

} // namespace

SurfaceMesh stone_surface(const StoneKind& kind, std::uint64_t seed) {
    Random random(seed, Stream::stones);
    voro::voronoicell cell;
    cell.init(-3.0, 3.0, -3.0, 3.0, -3.0, 3.0); // facets at random may leave a side open
    for (const Vec3& n : directions(kind.facets, random)) {
        cell.plane(n.x(), n.y(), n.z(), 2.0); // n x = 1: touches the unit sphere
    }
    std::vector<double> vertices;
    std::vector<int> faces;
    cell.vertices(vertices);
    cell.face_vertices(faces);
    const Vec3 axes(1.0, kind.elongation, kind.elongation * kind.flatness);
    SurfaceMesh mesh;
    for (std::size_t k = 0; k < vertices.size(); k += 3) {
        mesh.vertex.push_back(axes.cwiseProduct(Vec3(vertices[k], vertices[k + 1], vertices[k + 2])));
    }
    for (std::size_t k = 0; k < faces.size(); k += static_cast<std::size_t>(faces[k]) + 1) {
        const auto begin = faces.begin() + static_cast<std::ptrdiff_t>(k) + 1;
        mesh.add({begin, begin + faces[k]});
    }
    const double volume = mesh.volume();
    if (volume < 0.0) {
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            std::reverse(mesh.corner.begin() + mesh.first[f], mesh.corner.begin() + mesh.first[f + 1]);
        }
    }
    const double factor = std::cbrt(std::numbers::pi / 6.0 / std::fabs(volume));
    for (auto& v : mesh.vertex) {
        v *= factor;
    }
    return mesh;
}

ClusterShape form_of(const SurfaceMesh& closed, int spheres) {
    FillRule rule;
    rule.spheres = spheres;
    rule.cells = 32;
    ClusterShape shape = fill_with_spheres(closed, rule);
    const double factor = std::cbrt(shape.volume / mass_properties(shape.centre, shape.radius).volume);
    for (auto& c : shape.centre) {
        c *= factor;
    }
    for (double& r : shape.radius) {
        r *= factor;
    }
    return scaled(shape, 1.0 / std::cbrt(6.0 * shape.volume / std::numbers::pi));
}

double reach_of(const ClusterShape& form) {
    double reach = 0.0;
    for (std::size_t s = 0; s < form.radius.size(); ++s) {
        reach = std::max(reach, form.centre[s].norm() + form.radius[s]);
    }
    return reach;
}

// K. Shoemake, Graphics Gems III, 124, 1992.
rotation::Quaternion any_attitude(Random& random) {
    const double u = random.uniform();
    const double a = 2.0 * std::numbers::pi * random.uniform();
    const double b = 2.0 * std::numbers::pi * random.uniform();
    const double p = std::sqrt(1.0 - u);
    const double q = std::sqrt(u);
    return {q * std::cos(b), p * std::sin(a), p * std::cos(a), q * std::sin(b)};
}

ClusterShape scaled(const ClusterShape& shape, double factor) {
    ClusterShape out = shape;
    for (auto& c : out.centre) {
        c *= factor;
    }
    for (double& r : out.radius) {
        r *= factor;
    }
    out.volume *= std::pow(factor, 3);
    out.inertia *= std::pow(factor, 5);
    return out;
}

} // namespace proveta
