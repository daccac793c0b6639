// What the split of a search into candidates, fast intersection test and hierarchy is worth (thesis, table 6.2 and fig. 3.2). Not a test of
// right or wrong: run it by `test_verification "[benchmark]"`.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/boundaries/double_hierarchy.hpp"
#include "core/boundaries/face_tree.hpp"
#include "core/boundaries/surface_shapes.hpp"
#include "specimens/random.hpp"

using namespace proveta;

namespace {

// The mixer of examples/mixer.json in one surface.
SurfaceMesh mixer() {
    SurfaceMesh mesh = cylinder_surface(0.15, 0.15, 0.3, 80, true, true, 20);
    SurfaceMesh blade = helix_surface(0.09, 0.14, 0.15, 0.28, 114, 2);
    for (auto& v : blade.vertex) {
        v.z() += 0.01;
    }
    mesh.add(blade);
    return mesh;
}

// 29,559 spheres, shaken off a lattice, from the bottom of the drum up.
std::vector<Vec3> bed(double radius) {
    Random random(1, Stream::positions);
    std::vector<Vec3> out;
    const double pitch = 2.02 * radius;
    for (double y = -0.1465; out.size() < 29559; y += pitch) {
        for (double x = -0.1465; x < 0.1465; x += pitch) {
            for (double z = radius; z < 0.3 - 0.9 * radius; z += pitch) {
                const Vec3 at(x + 0.3 * radius * random.uniform(), y + 0.3 * radius * random.uniform(),
                              z + 0.3 * radius * random.uniform());
                if (std::hypot(at.x(), at.y()) < 0.15 - 0.97 * radius && out.size() < 29559) {
                    out.push_back(at);
                }
            }
        }
    }
    return out;
}

template <class Work> double seconds(const Work& work) {
    double best = 1e300;
    for (int round = 0; round < 5; ++round) {
        const auto start = std::chrono::steady_clock::now();
        work();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

} // namespace

TEST_CASE("the split of the contact search, measured", "[.benchmark]") {
    constexpr double radius = 0.0035;
    const SurfaceGeometry geometry(mixer());
    const FaceTree tree(geometry.mesh);
    const auto centres = bed(radius);
    std::vector<std::uint32_t> faces;
    std::vector<FaceContact> found;
    std::size_t candidates = 0, cutting = 0, contacts = 0;
    const auto look = [&](bool filter, bool resolve) {
        candidates = cutting = contacts = 0;
        for (const auto& c : centres) {
            faces.clear();
            tree.near(c, radius, faces);
            candidates += faces.size();
            if (filter) {
                std::erase_if(faces, [&](std::uint32_t f) { return !cuts(geometry, f, c, radius); });
                cutting += faces.size();
            }
            if (resolve && !faces.empty()) {
                double_hierarchy(geometry, faces, c, radius, found);
                contacts += found.size();
            }
        }
    };
    const double search = seconds([&] { look(false, false); });
    const double fast = seconds([&] { look(true, false); }) - search;
    const double split = seconds([&] { look(true, true); });
    const std::size_t by_split = contacts;
    const double direct = seconds([&] { look(false, true); });
    const auto n = static_cast<double>(centres.size());
    CHECK(contacts == by_split);
    CHECK(cutting <= candidates);
    std::printf("%zu spheres, %zu faces; a sphere: %.3f candidates, %.3f contacts\n", centres.size(), geometry.mesh.faces(),
                static_cast<double>(candidates) / n, static_cast<double>(by_split) / n);
    look(true, true);
    std::printf("  faces cut a sphere: %.3f\n", static_cast<double>(cutting) / n);
    std::printf("ns a sphere: candidates %.1f, fast test %.1f, hierarchy %.1f; with split %.1f, direct %.1f\n", 1e9 * search / n,
                1e9 * fast / n, 1e9 * (split - search - fast) / n, 1e9 * split / n, 1e9 * direct / n);
}
