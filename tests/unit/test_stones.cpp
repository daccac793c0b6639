#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/boundaries/double_hierarchy.hpp"
#include "specimens/cluster_shape.hpp"
#include "specimens/stones.hpp"

using namespace proveta;

TEST_CASE("a stone is a closed convex body of the volume asked for") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const StoneKind kind{0.4 + 0.03 * static_cast<double>(seed), 1.0 - 0.03 * static_cast<double>(seed), 6 + static_cast<int>(seed)};
        const SurfaceMesh mesh = stone_surface(kind, seed);
        const SurfaceState state = look_at(mesh);
        CHECK(state.closed());
        CHECK(state.usable());
        CHECK(state.parts == 1);
        CHECK(mesh.volume() == Approx(std::numbers::pi / 6.0).epsilon(1e-12));
        // Convex: no corner stands out of any facet's plane. Voro++ joins corners nearer than some 1e-10.
        const SurfaceGeometry geometry{SurfaceMesh(mesh)};
        for (const auto& plane : geometry.plane) {
            for (const auto& v : mesh.vertex) {
                CHECK(plane.normal.dot(v) < plane.offset + 1e-8);
            }
        }
    }
}

TEST_CASE("stones have the ratios of axes of their kind") {
    // Of a body around an ellipsoid with semi-axes a, b, c the second moments go with a^2, b^2, c^2; the mean over many stones shows it.
    double long_to_middle = 0.0;
    double middle_to_short = 0.0;
    constexpr int stones = 60;
    for (int k = 0; k < stones; ++k) {
        const auto body = mass_properties(stone_surface({0.6, 0.7, 20}, static_cast<std::uint64_t>(k) + 100));
        const ClusterShape shape = cluster_shape({Vec3::Zero()}, {0.1}, body);
        // From moments of inertia back to second moments, the largest axis first.
        const double half = 0.5 * shape.inertia.sum();
        const Vec3 second = Vec3::Constant(half) - shape.inertia;
        long_to_middle += std::sqrt(second.y() / second.x()) / stones;
        middle_to_short += std::sqrt(second.z() / second.y()) / stones;
    }
    // Facets at random shift single stones by some 5 %, and sorting by size widens the gaps a little.
    CHECK(long_to_middle == Approx(0.6).epsilon(0.05));
    CHECK(middle_to_short == Approx(0.7).epsilon(0.05));
}

TEST_CASE("the same seed gives the same stone, another another one") {
    const SurfaceMesh a = stone_surface({}, 5);
    const SurfaceMesh b = stone_surface({}, 5);
    const SurfaceMesh c = stone_surface({}, 6);
    REQUIRE(a.vertex.size() == b.vertex.size());
    for (std::size_t k = 0; k < a.vertex.size(); ++k) {
        CHECK(a.vertex[k] == b.vertex[k]);
    }
    CHECK((a.vertex.size() != c.vertex.size() || a.vertex[0] != c.vertex[0]));
}

TEST_CASE("a form scaled is the form of the body scaled") {
    const SurfaceMesh mesh = stone_surface({}, 7);
    FillRule rule;
    rule.spheres = 8;
    rule.cells = 16;
    const ClusterShape small = fill_with_spheres(mesh, rule);
    SurfaceMesh twice = mesh;
    for (auto& v : twice.vertex) {
        v *= 2.0;
    }
    const ClusterShape large = fill_with_spheres(twice, rule);
    const ClusterShape grown = scaled(small, 2.0);
    REQUIRE(grown.radius.size() == large.radius.size());
    CHECK(grown.volume == Approx(large.volume).epsilon(1e-12));
    for (int c = 0; c < 3; ++c) {
        CHECK(grown.inertia[c] == Approx(large.inertia[c]).epsilon(1e-12));
    }
    for (std::size_t k = 0; k < grown.radius.size(); ++k) {
        CHECK(grown.radius[k] == Approx(large.radius[k]).epsilon(1e-12));
    }
}
