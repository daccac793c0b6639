// Shapes that the program meshes itself, and what is said of a mesh.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/solids/solid_shapes.hpp"
#include "tests/solid_shells.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

constexpr double pi = std::numbers::pi;

std::size_t nodes_in_one_place(const SolidMesh& mesh) {
    std::set<std::array<long, 3>> places;
    for (const auto& v : mesh.node) {
        places.insert({std::lround(1e9 * v.x()), std::lround(1e9 * v.y()), std::lround(1e9 * v.z())});
    }
    return mesh.node.size() - places.size();
}

} // namespace

TEST_CASE("a box of hexahedra or tetrahedra has its volume, a closed outward skin and its sides") {
    const Vec3 size(1.0, 2.0, 0.5);
    for (const bool tetrahedra : {false, true}) {
        const SolidMesh mesh = box_mesh(size, 3, 4, 2, tetrahedra);
        CHECK(problems_of(mesh).empty());
        CHECK(mesh.node.size() == 60);
        CHECK(mesh.elements() == (tetrahedra ? 144 : 24));
        CHECK(volume_of(mesh) == Approx(1.0));
        CHECK(skin_of(mesh).size() == (tetrahedra ? 104 : 52)); // neighbours match: nothing of the inside shows
        const Shell shell = shell_of(mesh);
        CHECK(shell.area == Approx(7.0));
        CHECK(shell.volume == Approx(1.0)); // positive: it faces outwards
        CHECK(shell.euler == 2);
        CHECK(shell.open == 0);
        REQUIRE(mesh.groups.size() == 6);
        CHECK(group(mesh, "x-").size() == 15);
        CHECK(group(mesh, "y+").size() == 12);
        CHECK(group(mesh, "z+").size() == 20);
        for (const auto n : group(mesh, "y-")) {
            CHECK(mesh.node[n].y() == -1.0);
        }
        CHECK(std::is_sorted(group(mesh, "z-").begin(), group(mesh, "z-").end()));
    }
    CHECK_THROWS_AS(box_mesh(size, 0, 1, 1, false), std::invalid_argument);
}

TEST_CASE("a cylinder of hexahedra is a prism over a regular polygon, of well shaped cells") {
    for (const auto& [core, rings, layers] : {std::array{1, 1, 1}, std::array{2, 1, 3}, std::array{3, 2, 2}, std::array{4, 3, 5}}) {
        const SolidMesh mesh = cylinder_mesh(0.5, 2.0, core, rings, layers);
        CHECK(problems_of(mesh).empty());
        CHECK(nodes_in_one_place(mesh) == 0);
        const int n = 4 * core;
        CHECK(static_cast<int>(mesh.hexahedra.size()) == (core * core + rings * n) * layers);
        const double volume = 0.5 * n * 0.25 * std::sin(2.0 * pi / n) * 2.0;
        CHECK(volume_of(mesh) == Approx(volume));
        const Shell shell = shell_of(mesh);
        CHECK(shell.volume == Approx(volume));
        CHECK(shell.area == Approx(volume + n * 2.0 * 0.5 * std::sin(pi / n) * 2.0)); // both ends: volume over 2 m, twice
        CHECK(shell.euler == 2);
        CHECK(shell.open == 0);
        CHECK(static_cast<int>(group(mesh, "side").size()) == n * (layers + 1));
        for (const auto k : group(mesh, "side")) {
            CHECK(mesh.node[k].head<2>().norm() == Approx(0.5).epsilon(1e-14));
        }
        for (const auto k : group(mesh, "z+")) {
            CHECK(mesh.node[k].z() == 2.0);
        }
        CHECK(group(mesh, "z-").size() == mesh.node.size() / static_cast<std::size_t>(layers + 1));
    }
    // Corners of the cells seen from above; a core that is square, or round, has some of 135 degrees and more.
    const SolidMesh mesh = cylinder_mesh(1.0, 1.0, 6, 3, 1);
    for (const auto& h : mesh.hexahedra) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 a = (mesh.node[h[(k + 1) % 4]] - mesh.node[h[k]]).normalized();
            const Vec3 b = (mesh.node[h[(k + 3) % 4]] - mesh.node[h[k]]).normalized();
            CHECK(std::acos(a.dot(b)) > pi / 4.0);
            CHECK(std::acos(a.dot(b)) < 0.72 * pi);
        }
    }
}

TEST_CASE("a tube of membranes stands on its circles with near equilateral triangles, open at its ends only") {
    const int around = 24;
    const double side = 2.0 * std::sin(pi / around);
    const int layers = 7;
    const SolidMesh mesh = tube_membrane(1.0, layers * side * std::sqrt(0.75), around, layers);
    CHECK(problems_of(mesh).empty());
    CHECK(mesh.node.size() == 8 * 24);
    CHECK(mesh.membranes.size() == 2 * 7 * 24);
    CHECK(nodes_in_one_place(mesh) == 0);
    for (const auto& v : mesh.node) {
        CHECK(v.head<2>().norm() == Approx(1.0).epsilon(1e-15));
    }
    double greatest = 0.0;
    double least = 1.0;
    for (const auto& t : mesh.membranes) {
        const Vec3 middle = (mesh.node[t[0]] + mesh.node[t[1]] + mesh.node[t[2]]) / 3.0;
        CHECK(twice_area(mesh, {t[0], t[1], t[2]}).dot(Vec3(middle.x(), middle.y(), 0.0)) > 0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = (mesh.node[t[(k + 1) % 3]] - mesh.node[t[k]]).norm();
            greatest = std::max(greatest, length);
            least = std::min(least, length);
        }
    }
    CHECK(greatest / least < 1.01);
    const Shell shell = shell_of(mesh);
    CHECK(shell.open == 48);
    CHECK(shell.euler == 0);
    CHECK(group(mesh, "z-").size() == 24);
    CHECK(group(mesh, "z+").size() == 24);
}

TEST_CASE("a sphere and a sheet of membranes") {
    const SolidMesh ball = sphere_membrane(2.0, 2);
    CHECK(problems_of(ball).empty());
    CHECK(ball.membranes.size() == 320);
    CHECK(ball.node.size() == 162);
    CHECK(shell_of(ball).euler == 2);
    CHECK(shell_of(ball).open == 0);
    CHECK(shell_of(ball).volume == Approx(32.0 / 3.0 * pi).epsilon(0.05)); // of flat triangles
    for (const auto& v : ball.node) {
        CHECK(v.norm() == Approx(2.0).epsilon(1e-14));
    }
    const SolidMesh flat = sheet_membrane(3.0, 2.0, 6, 4);
    CHECK(problems_of(flat).empty());
    CHECK(flat.membranes.size() == 48);
    CHECK(shell_of(flat).area == Approx(6.0));
    CHECK(shell_of(flat).euler == 1);
    CHECK(shell_of(flat).open == 20);
    for (const auto& t : flat.membranes) {
        CHECK(twice_area(flat, {t[0], t[1], t[2]}).z() == Approx(0.25));
    }
    CHECK(group(flat, "x+").size() == 5);
    CHECK(group(flat, "y-").size() == 7);
    CHECK(group(flat, "rim").size() == 20);
}

TEST_CASE("volume and sense of bent hexahedra are those of their shape functions") {
    SolidMesh mesh = box_mesh({1, 1, 1}, 1, 1, 1, false);
    mesh.node[7].z() += 0.4; // a corner of the upper face: by the mean of the bilinear face
    CHECK(volume_of(mesh) == Approx(1.1));
    CHECK(problems_of(mesh).empty());
    mesh.node[7].z() -= 3.0;
    CHECK(any_has(problems_of(mesh), "folded"));
}

TEST_CASE("what is wrong with a mesh is named and counted, and tidied where it can be") {
    SolidMesh mesh = box_mesh({1, 1, 1}, 2, 1, 1, true);
    std::swap(mesh.tetrahedra[3][0], mesh.tetrahedra[3][1]);
    std::swap(mesh.tetrahedra[5][2], mesh.tetrahedra[5][3]);
    mesh.node.insert(mesh.node.begin(), Vec3(5, 5, 5));
    for (auto& t : mesh.tetrahedra) {
        for (auto& n : t) {
            ++n;
        }
    }
    for (auto& g : mesh.groups) {
        for (auto& n : g.node) {
            ++n;
        }
    }
    mesh.groups.push_back({"far", {0}});
    const auto found = problems_of(mesh);
    REQUIRE(found.size() == 2);
    says(found[0], "node 1 at (5");
    says(found[1], "tetrahedron 4 at");
    says(found[1], "inside out; 2 in all");
    CHECK(tidy(mesh) == 2);
    CHECK(problems_of(mesh).empty());
    CHECK(mesh.node.size() == 12);
    CHECK(volume_of(mesh) == Approx(1.0));
    CHECK(group(mesh, "x-") == group(box_mesh({1, 1, 1}, 2, 1, 1, true), "x-"));
    CHECK(group(mesh, "far").empty());

    SolidMesh turned = box_mesh({1, 1, 1}, 2, 1, 1, false);
    for (auto& v : turned.node) {
        v.x() = -v.x();
    }
    CHECK(any_has(problems_of(turned), "hexahedron 1 at"));
    CHECK(tidy(turned) == 2);
    CHECK(problems_of(turned).empty());
    CHECK(shell_of(turned).volume == Approx(1.0));

    SolidMesh bad = box_mesh({1, 1, 1}, 1, 1, 1, true);
    bad.tetrahedra[0][2] = 8;
    CHECK(any_has(problems_of(bad), "not there"));
    CHECK(tidy(bad) == 0);
    CHECK(any_has(problems_of(bad), "not there"));
    bad = box_mesh({1, 1, 0}, 1, 1, 1, true);
    CHECK(any_has(problems_of(bad), "tetrahedron 1 at (-0.5"));
    CHECK(any_has(problems_of(bad), "no volume; 6 in all"));
    CHECK(any_has(problems_of(box_mesh({1, 1, 0}, 1, 1, 1, false)), "no volume"));
    CHECK(any_has(problems_of(sheet_membrane(1, 0, 1, 1)), "no area"));
    bad = sheet_membrane(1, 1, 1, 1);
    bad.membranes[0][1] = bad.membranes[0][0];
    CHECK(any_has(problems_of(bad), "same node twice"));
    bad = sheet_membrane(1, 1, 1, 1);
    bad.node[2].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(any_has(problems_of(bad), "node 3 has coordinates that are not finite"));
    bad = sheet_membrane(1, 1, 1, 1);
    bad.groups[0].node.push_back(99);
    CHECK(any_has(problems_of(bad), "group x-"));
    CHECK(any_has(problems_of(SolidMesh{}), "no elements"));
    // A needle is no flat element.
    SolidMesh needle;
    needle.node = {{0, 0, 0}, {1e-4, 0, 0}, {0, 1e-4, 0}, {0, 0, 1}};
    needle.tetrahedra = {{0, 1, 2, 3}};
    CHECK(problems_of(needle).empty());
}
