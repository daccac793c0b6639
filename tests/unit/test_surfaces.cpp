#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/boundaries/surface_shapes.hpp"
#include "specimens/surface_import.hpp"
#include "tests/support.hpp"

using namespace proveta;
using proveta::testing::TemporaryFolder;

namespace {

std::string stl(const SurfaceMesh& mesh, const std::string& more = "") {
    std::string out = "solid s\n";
    const SurfaceMesh t = triangulated(mesh);
    for (std::size_t f = 0; f < t.faces(); ++f) {
        out += "facet normal 0 0 0\nouter loop\n";
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& v = t.at(f, k);
            out += "vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
        }
        out += "endloop\nendfacet\n";
    }
    return out + more + "endsolid s\n";
}

std::string refusal_of(const std::string& file) {
    try {
        import_surface(file, 1.0);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

} // namespace

TEST_CASE("surfaces made by the program have their areas and volumes, and are closed where they should be") {
    const SurfaceMesh box = box_surface({1.0, 2.0, 3.0});
    CHECK(box.area() == Approx(22.0));
    CHECK(box.volume() == Approx(6.0));
    CHECK(look_at(box).closed());
    CHECK(look_at(refined(box)).closed());
    CHECK(refined(box).volume() == Approx(6.0));
    const SurfaceMesh ball = sphere_surface(1.0, 3);
    CHECK(look_at(ball).closed());
    CHECK(ball.volume() == Approx(4.0 / 3.0 * std::numbers::pi).epsilon(0.02)); // of 1,280 flat triangles
    const SurfaceMesh can = cylinder_surface(0.5, 0.5, 2.0, 12, true, true);
    CHECK(can.volume() == Approx(0.5 * 12 * 0.25 * std::sin(std::numbers::pi / 6.0) * 2.0));
    CHECK(look_at(can).closed());
    CHECK(look_at(can).usable());
    CHECK(look_at(cylinder_surface(0.5, 0.0, 1.0, 9, true, true)).closed());
    const SurfaceState open = look_at(cylinder_surface(0.5, 0.5, 2.0, 12, true, false));
    CHECK(open.open_edges == 12);
    CHECK_FALSE(open.closed());
    // A screw's blade of one turn: its area is that of the helicoid, int sqrt(p^2 + (2 pi r)^2) dr.
    const SurfaceMesh blade = helix_surface(0.1, 0.4, 0.3, 0.3, 200, 20);
    double area = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const double r = 0.1 + 0.3 * (k + 0.5) / 1000;
        area += 0.3 / 1000 * std::sqrt(0.09 + 4.0 * std::numbers::pi * std::numbers::pi * r * r);
    }
    CHECK(blade.area() == Approx(area).epsilon(1e-3));
}

TEST_CASE("what is wrong with a surface is found, named and counted") {
    SurfaceMesh mesh = box_surface({1, 1, 1});
    std::swap(mesh.corner[1], mesh.corner[3]); // turns the first face
    CHECK(look_at(mesh).turned_edges == 4);
    mesh.vertex.emplace_back(0, 0, 0.7);
    mesh.add({4, 5, 8, 6}); // through the middle of the upper side, and bent
    const SurfaceState state = look_at(mesh);
    CHECK(state.bent + state.concave == 1);
    CHECK(state.forked_edges > 0);
    CHECK_FALSE(state.usable());
    CHECK_FALSE(state.notes.empty());
    SurfaceMesh two = box_surface({1, 1, 1});
    two.add(box_surface({0.1, 0.1, 0.1}));
    CHECK(look_at(two).parts == 2);
}

TEST_CASE("surfaces are read from files of others and mended on the way") {
    const TemporaryFolder folder;
    // Corners come three times a face, one triangle has no area and one is there twice.
    const std::string flaw = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 1 1\nvertex 2 2 2\nendloop\nendfacet\n";
    const auto box = import_surface(folder.file("box.stl", stl(box_surface({2, 2, 2}), flaw)), 0.001);
    CHECK(box.mesh.faces() == 12);
    CHECK(box.mesh.volume() == Approx(8e-9));
    CHECK(box.state.closed());
    REQUIRE(box.notes.size() == 1);
    CHECK(box.notes[0] == "1 faces without area were left out: 13 (line 86)");
    const auto quad = import_surface(folder.file("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), 1.0);
    CHECK(quad.mesh.faces() == 1);
    CHECK(quad.mesh.corners(0) == 4);
    CHECK(quad.notes.size() == 1); // open
    const auto arrow = import_surface(folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0.2 0.2 0\nv 0 1 0\nf 1 2 3 4\n"), 1.0);
    CHECK(arrow.mesh.faces() == 2);
    CHECK(arrow.mesh.area() == Approx(0.2));
    CHECK(arrow.state.usable());
    SurfaceMesh inward = box_surface({1, 1, 1});
    for (auto& v : inward.vertex) {
        v.x() = -v.x();
    }
    const auto turned = import_surface(folder.file("i.stl", stl(inward)), 1.0);
    REQUIRE(turned.notes.size() == 1);
    CHECK(turned.notes[0].find("inwards") != std::string::npos);
}

TEST_CASE("files that hold no surface are refused with the reason") {
    const TemporaryFolder folder;
    CHECK(refusal_of(folder.file("e.stl", "solid s\nendsolid s\n")).find("holds no faces") != std::string::npos);
    CHECK(refusal_of(folder.file("n.stl", "\n")).find("neither text") != std::string::npos);
    CHECK(refusal_of(folder.file("x.obj", "this is no surface\n")).find("holds no faces") != std::string::npos);
    CHECK(refusal_of(folder.file("z.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")).find("no face has an area") != std::string::npos);
    CHECK(refusal_of("nowhere.stl").find("no such file") != std::string::npos);
    CHECK(refusal_of(folder.file("s.step", "x")).find(".stl") != std::string::npos);
}
