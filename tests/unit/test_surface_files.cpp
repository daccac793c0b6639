// Surfaces from STL, OBJ and PLY files: how they may be written, and what is wrong with them.
#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/boundaries/surface_shapes.hpp"
#include "core/input/words.hpp"
#include "specimens/surface_import.hpp"
#include "tests/solid_shells.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

std::string surface_refusal(const std::string& file) {
    try {
        import_surface(file, 1.0);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

std::string stl_facet(const std::string& a, const std::string& b, const std::string& c) {
    return "  facet normal 0 0 0\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
           "\n    endloop\n  endfacet\n";
}

// A stl_tetrahedron of 1/6.
const std::string stl_facets = stl_facet("0 0 0", "0 1 0", "1 0 0") + stl_facet("0 0 0", "1 0 0", "0 0 1") +
                               stl_facet("0 0 0", "0 0 1", "0 1 0") + stl_facet("1 0 0", "0 1 0", "0 0 1");
const std::string stl_tetrahedron = "solid t\n" + stl_facets + "endsolid t\n";
const std::vector<float> four_faces{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                    0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

std::string in_upper_case(std::string text) {
    for (char& c : text) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

std::string with_ends(const std::string& text, const std::string& end) {
    std::string out;
    for (const char c : text) {
        out += c == '\n' ? end : std::string(1, c);
    }
    return out;
}

// In UTF-16, the lower byte first.
std::string in_utf16(const std::string& text) {
    std::string out = "\xFF\xFE";
    for (const char c : text) {
        out += c;
        out += '\0';
    }
    return out;
}

std::string binary_stl(const std::string& title, std::uint32_t faces, const std::vector<float>& corner) {
    std::string out = title;
    out.resize(80, ' ');
    const auto add = [&](const void* from, std::size_t size) { out.append(static_cast<const char*>(from), size); };
    add(&faces, sizeof faces);
    for (std::size_t k = 0; k < corner.size(); k += 9) {
        out.append(12, '\0');
        add(&corner[k], 36);
        out.append("\x1f\x7c", 2); // a colour
    }
    return out;
}

} // namespace

TEST_CASE("STL is text or bytes by its content: case, blanks, marks and what fills a file up do not matter") {
    const TemporaryFolder folder;
    const std::string two = "solid a\n" + stl_facet("0 0 0", "0 1 0", "1 0 0") + stl_facet("0 0 0", "1 0 0", "0 0 1") +
                            "endsolid a\nsolid\n" + stl_facet("0 0 0", "0 0 1", "0 1 0") + "color 0.5 0.5 0.5\n" +
                            stl_facet("1 0 0", "0 1 0", "0 0 1") + "endsolid\n";
    const std::vector<std::string> same{stl_tetrahedron,
                                        in_upper_case(stl_tetrahedron),
                                        "\n \n\t" + stl_tetrahedron,
                                        "\xEF\xBB\xBF" + stl_tetrahedron,
                                        in_utf16(stl_tetrahedron),
                                        with_ends(stl_tetrahedron, "\r\n"),
                                        with_ends(stl_tetrahedron, "\r"),
                                        stl_tetrahedron + "\n\n \x1a",
                                        stl_tetrahedron + std::string(100, '\0'),
                                        "solid " + std::string(200, 'n') + "\n" + stl_facets + "endsolid",
                                        two,
                                        binary_stl("a title", 4, four_faces),
                                        binary_stl("solid like a text", 4, four_faces),
                                        binary_stl("\n  SOLID facet normal", 4, four_faces),
                                        binary_stl("\xEF\xBB\xBFsolid", 4, four_faces),
                                        binary_stl("COLOR=", 4, four_faces) + std::string(428, '\0')};
    for (std::size_t k = 0; k < same.size(); ++k) {
        INFO(k);
        const auto in = import_surface(folder.file("s.stl", same[k]), 1.0);
        CHECK(in.mesh.faces() == 4);
        CHECK(in.mesh.volume() == Approx(1.0 / 6.0));
        CHECK(in.state.closed());
        CHECK(in.notes.size() == (k + 1 == same.size() ? 1 : 0));
    }
    const auto more = import_surface(folder.file("m.stl", binary_stl("solid", 4, four_faces) + "more"), 1.0);
    CHECK(more.mesh.faces() == 4);
    REQUIRE(more.notes.size() == 1);
    says(more.notes[0], "4 bytes behind the last face");
}

TEST_CASE("STL text that is cut or broken is refused with facet and line") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) { return surface_refusal(folder.file("s.stl", text)); };
    const auto changed = [&](const std::string& from, const std::string& to) { return refusal(replaced(stl_tetrahedron, from, to)); };
    says(refusal("solid t\n" + stl_facets), "line 29: the file ends before endsolid, in or after facet 4: it is cut short");
    says(refusal(stl_tetrahedron.substr(0, stl_tetrahedron.find("endloop"))), "before vertex or endloop, in or after facet 1");
    says(changed("vertex 0 1 0\n", "\n"), "line 2: facet 1 has 2 vertices");
    says(changed("vertex 0 1 0\n", "vertex 0 1 0\nvertex 1 1 0\n"), "line 2: facet 1 has 4 vertices");
    says(changed("vertex 0 1 0", "vertex 0 nan 0"), "line 5: vertex 2 of facet 1: \"nan\" is no finite number");
    says(changed("vertex 0 1 0", "vertex 0 -inf 0"), "\"-inf\"");
    says(changed("vertex 0 1 0", "vertex 0 one 0"), "line 5: a coordinate of vertex 2 of the facet is expected after facet 1");
    says(changed("vertex 0 1 0", "vertex 0 1"), "and \"vertex\" was found");
    says(changed("outer loop", "inner loop"), "line 3: outer loop is expected");
    says(changed("endfacet", "facet"), "line 8: endfacet is expected after facet 1 and \"facet\" was found");
    says(changed("solid t\n", "solid t\nsolid u\n"), "line 2: facet or endsolid is expected");
    says(refusal(stl_tetrahedron + "<more>"), "line 31: solid is expected after facet 4 and \"<more>\" was found");
    says(refusal(stl_facets), "solid is expected");
    says(refusal("<!DOCTYPE html>\n<title>not found</title>\n"), "neither text, which begins with solid, nor binary");
    // All at once.
    const std::string bad = "solid\n" + stl_facet("0 0 0", "0 nan 0", "1 0 0") + stl_facet("0 0 0", "0 0 inf", "1 0 0") + "endsolid\n";
    says(refusal(bad), "facet 1: \"nan\"");
    says(refusal(bad), "facet 2: \"inf\"");
    for (std::size_t k = 0; k + 9 < stl_tetrahedron.size(); ++k) { // up to "endsolid"
        INFO(k);
        CHECK_FALSE(refusal(stl_tetrahedron.substr(0, k) + " ").empty());
    }
}

TEST_CASE("STL bytes that are cut, too many or no numbers are refused with their number") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& bytes) { return surface_refusal(folder.file("s.stl", bytes)); };
    says(refusal(binary_stl("a", 4000000000U, four_faces)), "4000000000 faces are announced");
    says(refusal(binary_stl("solid", 5, four_faces)),
         "5 faces are announced, which take 334 bytes, and the file has 284: it is cut short in face 5");
    says(refusal(binary_stl("a", 4, four_faces).substr(0, 200)), "it is cut short in face 3");
    says(refusal(binary_stl("a", 4, four_faces).substr(0, 60)), "it has 60 bytes");
    says(refusal(binary_stl("a", 2, four_faces)), "2 faces are announced, and the file holds 100 bytes more, as 2 more faces would take");
    says(refusal(binary_stl("a", 0, {})), "holds no faces");
    auto other = four_faces;
    other[10] = std::numeric_limits<float>::quiet_NaN();
    other[35] = std::numeric_limits<float>::infinity();
    says(refusal(binary_stl("a", 4, other)), "face 2: vertex 1 is at 0 nan 0; face 4: vertex 3 is at 0 0 inf");
}

TEST_CASE("faces without area and faces that are there twice are left out and named") {
    const TemporaryFolder folder;
    const std::string flaws =
        stl_facet("0 0 0", "1 1 1", "2 2 2") + stl_facet("0 0 0", "0 0 0", "1 0 0") + stl_facet("1 0 0", "0 1 0", "0 0 0");
    const auto in = import_surface(folder.file("s.stl", "solid\n" + stl_facets + flaws + "endsolid\n"), 1.0);
    CHECK(in.mesh.faces() == 4);
    REQUIRE(in.notes.size() == 2);
    CHECK(in.notes[0] == "2 faces without area were left out: 5 (line 30), 6 (line 37)");
    CHECK(in.notes[1] == "1 faces that are there twice were taken once: 7 (line 44)");
    auto bytes = four_faces;
    bytes.insert(bytes.end(), four_faces.begin(), four_faces.begin() + 9);
    const auto binary = import_surface(folder.file("b.stl", binary_stl("a", 5, bytes)), 1.0);
    REQUIRE(binary.notes.size() == 1);
    CHECK(binary.notes[0] == "1 faces that are there twice were taken once: 5");
    const auto obj = import_surface(folder.file("o.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\nf 1 2 2\n"), 1.0);
    CHECK(any_has(obj.notes, "taken once: 2 (line 5)"));
    CHECK(any_has(obj.notes, "left out: 3 (line 6)"));
}

TEST_CASE("OBJ files: vertices from the end, textures, lines that go on, vertices that are not there") {
    const TemporaryFolder folder;
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    const auto area = [&](const std::string& text) { return import_surface(folder.file("a.obj", text), 1.0).mesh.area(); };
    CHECK(area(points + "f -4 -3 -2 -1\n") == Approx(1.0));
    CHECK(area(points + "f 1/2/3 2//1 \\\n 3 # and no more\n") == Approx(0.5));
    CHECK(area("\xEF\xBB\xBF" + in_upper_case(points) + "F 1 2 3 4\n") == Approx(1.0));
    CHECK(area(with_ends(points + "f 1 2 3 4\n", "\r")) == Approx(1.0));
    CHECK(area("f 1 2 3\n# a face before its vertices \\\n" + points) == Approx(0.5));
    for (const char* face : {"f 1 2 5\n", "f -5 1 2\n", "f 0 1 2\n", "f one 2 3\n", "f 1 2 99999999999999999999\n", "f 1 2\n"}) {
        says(surface_refusal(folder.file("f.obj", points + face)), "f.obj: line 5: ");
    }
    says(surface_refusal(folder.file("v.obj", "v 0 0\n")), "line 1: vertex 1 has no three coordinates");
    says(surface_refusal(folder.file("n.obj", points + "v 0 nan 0\nf 1 2 9\n")),
         "line 5: vertex 5 has no three coordinates that are finite");
    says(surface_refusal(folder.file("n.obj", points + "v 0 nan 0\nf 1 2 9\n")),
         "; line 6: vertex 9 of a face is not there: the file has 5");
    const auto lines = import_surface(folder.file("l.obj", points + "vn 0 0 1\nl 1 2\nl 2 3\nf 1 2 3\n"), 1.0);
    CHECK(any_has(lines.notes, "2 lines that begin with \"l\""));
}

TEST_CASE("PLY files: text and bytes of both orders, strips, and lists by their three names") {
    const TemporaryFolder folder;
    const auto head = [](const std::string& format, const std::string& list = "vertex_indices", const std::string& element = "face") {
        return "ply\nformat " + format + " 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
               "property uchar red\nelement " + element + " 1\nproperty list uchar int " + list + "\nend_header\n";
    };
    const std::string points = "0 0 0 9\n1 0 0 9\n0 1 0 9\n1 1 0 9\n";
    const auto area = [&](const std::string& text) { return import_surface(folder.file("a.ply", text), 1.0).mesh.area(); };
    for (const char* list : {"vertex_indices", "vertex_index", "vertex_indexes", "Vertex_Indices"}) {
        CHECK(area(head("ascii", list) + points + "4 0 1 3 2\n") == Approx(1.0));
    }
    CHECK(area("\xEF\xBB\xBF" + head("ascii") + points + "3 0 1 2\n\n") == Approx(0.5));
    CHECK(area(with_ends(head("ascii") + points + "3 0 1 2\n", "\r")) == Approx(0.5));
    CHECK(area(with_ends(head("ascii") + points + "3 0 1 2\n", "\r\n")) == Approx(0.5));
    const auto strip = import_surface(folder.file("s.ply", head("ascii", "vertex_indices", "tristrips") + points + "4 0 1 2 3\n"), 1.0);
    CHECK(strip.mesh.faces() == 2);
    CHECK(strip.mesh.area() == Approx(1.0));
    CHECK(strip.state.turned_edges == 0);
    const auto strips =
        import_surface(folder.file("s.ply", head("ascii", "vertex_indices", "tristrips") + points + "7 0 1 2 -1 1 3 2\n"), 1.0);
    CHECK(strips.mesh.faces() == 2);
    for (const bool big : {false, true}) {
        std::string body;
        const auto add = [&](auto value) {
            std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
            body += big == (std::endian::native == std::endian::little) ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
        };
        for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}}) {
            add(x);
            add(y);
            add(0.0F);
            add(std::uint8_t{9});
        }
        add(std::uint8_t{3});
        for (const std::int32_t k : {0, 1, 2}) {
            add(k);
        }
        const std::string text = head(big ? "binary_big_endian" : "binary_little_endian") + body;
        CHECK(area(text) == Approx(0.5));
        CHECK(area(text + "\n") == Approx(0.5));
        CHECK(any_has(import_surface(folder.file("m.ply", text + "more"), 1.0).notes, "4 bytes behind the last element"));
        says(surface_refusal(folder.file("c.ply", text.substr(0, text.size() - 3))), "face 1: the file ends in it");
    }
}

TEST_CASE("PLY files that are cut, promise too much or hold no faces are refused with element and line") {
    const TemporaryFolder folder;
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto refusal = [&](const std::string& text) { return surface_refusal(folder.file("p.ply", text)); };
    const auto changed = [&](const std::string& from, const std::string& to) { return refusal(replaced(head + body, from, to)); };
    says(changed("vertex 3", "vertex 9000000000"), "9000000000");
    says(changed("3 0 1 2", "3 0 1 3"), "line 13: face 1: its vertex 3 is 3, and there are 3 from 0 on");
    says(changed("3 0 1 2", "3 0 1 -1"), "its vertex 3 is -1");
    says(changed("3 0 1 2", "3000000 0 1"), "the length of the list vertex_indices is 3000000");
    says(changed("3 0 1 2", "3 0 1"), "line 13: face 1: the line ends after 3 numbers");
    says(changed("1 0 0", "1 0 0 0"), "line 11: vertex 2: 3 numbers are expected and 4 were found");
    says(changed("1 0 0", "1 nan 0"), "line 11: vertex 2: it is at 1 nan 0");
    says(changed("1 0 0", "1 zero 0"), "line 11: vertex 2: a number is expected and \"zero\"");
    says(refusal(head + "0 0 0\n"), "vertex 2: the file ends before it, and 3 are announced");
    says(refusal(head + body + "3 0 1 2\n"), "line 14: \"3\" follows the last element that the header announces");
    says(changed("vertex_indices", "four_faces"),
         "by a list vertex_index, vertex_indices or vertex_indexes are read; there are 3 vertex (x, y, z)");
    says(changed("element face", "element strip"), "1 strip (vertex_indices)");
    says(changed("property float z\n", ""), "a vertex needs the properties x, y and z");
    says(changed("format ascii 1.0\n", ""), "no line \"format\"");
    says(changed("ascii", "text"), "\"text\" is none of ascii");
    says(changed("1.0", "2.0"), "version 1.0 is expected and \"2.0\"");
    says(changed("uchar int", "uchar int64"), "\"int64\" is no type");
    says(changed("element face 1", "element vertex 1"), "a second element");
    says(refusal("ply\nproperty float x\nend_header\n"), "not understood");
    says(refusal("ply\nformat ascii 1.0\n"), "p.ply:2: the file ends before end_header");
}
