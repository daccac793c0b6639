// Meshes of deformable bodies from Gmsh's files.
#include <catch2/catch.hpp>

#include <limits>

#include "specimens/solid_import.hpp"
#include "tests/solid_shells.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// A tetrahedron of 1/6 with its lower face in a group, and the second one of the other kind of numbering.
const std::string msh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "the foot"
3 7 "body"
$EndPhysicalNames
$Nodes
6
10 0 0 0
20 1 0 0
30 0 1 0
40 0 0 1
50 1 1 1.5
60 9 9 9
$EndNodes
$Elements
5
1 15 2 5 1 10
2 1 2 0 1 10 20
3 2 2 1 1 10 30 20
4 4 2 7 1 10 20 30 40
5 4 2 7 1 20 30 40 50
$EndElements
)";

const std::string msh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
2 3 "top"
$EndPhysicalNames
$Entities
1 0 1 1
1 0 0 0 0
5 0 0 1 1 1 1 1 -3 0
1 0 0 0 1 1 1 1 4 1 5
$EndEntities
$Nodes
2 8 1 8
2 5 0 4
5
6
7
8
0 0 1
1 0 1
1 1 1
0 1 1
3 1 1 4
1
2
3
4
0 0 0 0 0 0
1 0 0 0 0 0
1 1 0 0 0 0
0 1 0 0 0 0
$EndNodes
$Elements
2 2 1 2
2 5 3 1
1 5 6 7 8
3 1 5 1
2 1 2 3 4 5 6 7 8
$EndElements
$NodeData
1
"a field"
$EndNodeData
)";

// A sheet of one element, of Gmsh's type and nodes given.
std::string sheet(const std::string& element) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 0.4 0.4 0\n$EndNodes\n$Elements\n1\n1 " +
           element + "\n$EndElements\n";
}

} // namespace

TEST_CASE("Gmsh's format 2.2: groups, an inverted element, an unused node") {
    const TemporaryFolder folder;
    const auto in = import_solid(folder.file("a.msh", msh2), 0.1);
    CHECK(in.mesh.node.size() == 5);
    CHECK(in.mesh.tetrahedra.size() == 2);
    CHECK(in.mesh.membranes.empty());
    CHECK(volume_of(in.mesh) == Approx(1e-3 * (1.0 / 6.0 + 2.5 / 6.0)));
    CHECK(group(in.mesh, "the foot") == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(group(in.mesh, "body").size() == 5);
    CHECK(group(in.mesh, "5") == std::vector<std::uint32_t>{0});
    CHECK(in.mesh.groups.size() == 3);
    CHECK(any_has(in.notes, "1 nodes of no element"));
    CHECK(any_has(in.notes, "1 points, lines"));
    CHECK(in.notes.size() == 2);
    const std::string inverted = replaced(msh2, "1 10 20 30 40", "1 20 10 30 40");
    const auto turned = import_solid(folder.file("i.msh", inverted), 0.1);
    CHECK(any_has(turned.notes, "1 inverted elements"));
    CHECK(volume_of(turned.mesh) == Approx(volume_of(in.mesh)));
    // Lines of other systems.
    std::string dos;
    for (const char c : msh2) {
        dos += c == '\n' ? "\r\n" : std::string(1, c);
    }
    CHECK(import_solid(folder.file("d.msh", dos)).mesh.tetrahedra == in.mesh.tetrahedra);
}

TEST_CASE("an element of two groups is taken once, and groups of one number but several dimensions stay apart") {
    const TemporaryFolder folder;
    std::string text = replaced(msh2, "$Elements\n5", "$Elements\n6");
    text = replaced(text, "5 4 2 7 1 20", "4 4 2 8 1 10 20 30 40\n5 4 2 5 1 20");
    const auto in = import_solid(folder.file("a.msh", text));
    CHECK(in.mesh.tetrahedra.size() == 2);
    CHECK(any_has(in.notes, "more than once"));
    CHECK(group(in.mesh, "8") == group(in.mesh, "body"));
    CHECK(group(in.mesh, "5 (points)").size() == 1);
    CHECK(group(in.mesh, "5 (volumes)").size() == 4);
}

TEST_CASE("Gmsh's format 4.1: blocks, entities, parametric nodes, sections to pass over") {
    const TemporaryFolder folder;
    const auto in = import_solid(folder.file("a.MSH", msh4));
    CHECK(in.mesh.hexahedra.size() == 1);
    CHECK(volume_of(in.mesh) == Approx(1.0));
    CHECK(in.notes.empty());
    CHECK(in.mesh.groups.size() == 2);
    REQUIRE(group(in.mesh, "top").size() == 4);
    for (const auto n : group(in.mesh, "top")) {
        CHECK(in.mesh.node[n].z() == 1.0);
    }
    CHECK(group(in.mesh, "4").size() == 8);
    // As other programs write it: without entities.
    const auto from = msh4.find("$Entities");
    const auto to = msh4.find("$Nodes");
    const auto bare = import_solid(folder.file("b.msh", msh4.substr(0, from) + msh4.substr(to)));
    CHECK(bare.mesh.groups.empty());
    CHECK(any_has(bare.notes, "1 points, lines"));
}

TEST_CASE("files without volume elements are membranes; quadrilaterals are cut along the shorter or the inner diagonal") {
    const TemporaryFolder folder;
    const auto one = import_solid(folder.file("t.msh", sheet("2 2 9 1 1 2 4")));
    CHECK(one.mesh.membranes == std::vector<SolidMesh::Triangle>{{0, 1, 2}});
    CHECK(group(one.mesh, "9").size() == 3);
    const auto two = import_solid(folder.file("q.msh", sheet("3 2 0 1 1 2 3 4")));
    CHECK(two.mesh.membranes == std::vector<SolidMesh::Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(shell_of(two.mesh).area == Approx(2.0));
    // An arrow, whose fourth corner points inwards, and one whose shorter diagonal is outside.
    const auto arrow = import_solid(folder.file("a.msh", sheet("3 2 0 1 1 2 5 4")));
    CHECK(shell_of(arrow.mesh).area == Approx(0.6));
    CHECK(arrow.mesh.membranes.size() == 2);
    const std::string thin = replaced(sheet("3 2 0 1 1 2 5 4"), "4 0 1 0\n5 0.4 0.4 0", "4 2 0.1 0\n5 1 0.04 0");
    const auto narrow = import_solid(folder.file("n.msh", thin));
    const Vec3 up = twice_area(narrow.mesh, {narrow.mesh.membranes[0].begin(), narrow.mesh.membranes[0].end()});
    const Vec3 too = twice_area(narrow.mesh, {narrow.mesh.membranes[1].begin(), narrow.mesh.membranes[1].end()});
    CHECK(up.dot(too) > 0.0);
}

TEST_CASE("nodes in one place are mentioned: nothing is joined there") {
    const TemporaryFolder folder;
    const auto in = import_solid(folder.file("a.msh", replaced(sheet("3 2 0 1 1 2 3 4"), "5 0.4 0.4 0", "5 0 0 0")));
    CHECK_FALSE(any_has(in.notes, "where another does")); // the fifth is of no element
    std::string text = replaced(sheet("2 0 1 2 3"), "5 0.4 0.4 0", "5 0 0 0");
    text = replaced(text, "$Elements\n1\n", "$Elements\n2\n2 2 0 5 3 4\n");
    CHECK(any_has(import_solid(folder.file("b.msh", text)).notes, "1 nodes lie where another does"));
}

TEST_CASE("bad Gmsh files are refused with file, line and reason") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) { return message(folder.file("bad.msh", text)); };
    const auto two = [&](const std::string& from, const std::string& to) { return refusal(replaced(msh2, from, to)); };
    const auto four = [&](const std::string& from, const std::string& to) { return refusal(replaced(msh4, from, to)); };

    says(message((folder.path() / "nowhere.msh").string()), "no such file");
    says(message(folder.file("a.step", "x")), ".msh");
    says(refusal("\n"), "$MeshFormat is expected");
    says(refusal("$NOD\n1\n"), "version 1.0 of Gmsh's format, which begins with \"$NOD\"");
    says(two("2.2 0 8", "4.0 0 8"), "bad.msh:2: version \"4.0\"");
    says(two("2.2 0 8", "4 0 8"), "version \"4\" of Gmsh's format; versions 2.2 and 4.1 are read (in Gmsh: Mesh.MshFileVersion = 4.1)");
    says(two("2.2 0 8", "2.2 2 8"), "the file's type is 2");
    says(two("2.2 0 8", "2.2 1 8"), "the number 1 in four bytes is expected");
    says(refusal(std::string("\x7f\x00\xff\n\x01", 5)), "$MeshFormat is expected and \"???\"");
    says(two("$Nodes\n6", "$Nodes\n4000000000000"), "bad.msh:10: the number of nodes is 4000000000000");
    says(two("$Nodes\n6", "$Nodes\n-6"), "-6");
    says(two("$Nodes\n6", "$Nodes\n99999999999999999999999"), "the number of nodes is expected and");
    says(two("$Nodes\n6", "$Nodes\n5"), "$EndNodes is expected and \"60 9 9 9\"");
    says(two("$Nodes\n6", "$Nodes\n7"), "bad.msh:17: a node");
    says(two("20 1 0 0", "20 1 zero 0"), "bad.msh:12: a node's coordinate, a finite number, is expected and \"zero\"");
    says(two("20 1 0 0", "20 1 nan 0"), "\"nan\"");
    says(two("20 1 0 0", "20 1 1e999 0"), "\"1e999\"");
    says(two("20 1 0 0", "20 1 0"), "of 4 numbers");
    says(two("20 1 0 0", "1.5 1 0 0"), "\"1.5\"");
    says(two("20 1 0 0", "10 1 0 0"), "bad.msh:12: a second node 10; the first is in line 11");
    says(two("10 20 30 40", "10 20 30 41"), "node 41 is not among");
    says(two("10 20 30 40", "10 20 30"), "4 nodes");
    says(two("5 4 2 7 1 20", "4 4 2 7 1 20"), "a second element 4");
    says(two("4 4 2 7", "4 11 2 7"), "second-order tetrahedron");
    says(two("4 4 2 7", "4 11 2 7"), "Mesh.ElementOrder = 1");
    says(two("4 4 2 7 1", "4 4 4 7 1 1 2"), "element 4 of a mesh in partitions");
    says(refusal(msh4 + "$PartitionedEntities\n3\n"), "a mesh in partitions ($PartitionedEntities)");
    says(refusal("$Comments\n" + msh2), "the file ends where $EndComments is expected");
    says(refusal(msh2.substr(msh2.find("$Nodes"))), "bad.msh:1: $Nodes before $MeshFormat");
    says(two("4 4 2 7", "4 6 2 7"), "prism");
    says(two("4 4 2 7", "4 7 2 7"), "pyramid");
    says(two("4 4 2 7", "4 777 2 7"), "unknown kind (Gmsh's type 777)");
    says(two("4 4 2 7", "4 4 2000000000 7"), "2000000000 tags");
    says(two("4 4 2 7", "4 4 -2 7"), "-2 tags");
    says(two("$Elements\n5", "$Elements\n6"), "\"$EndElements\"");
    says(two("2 1 \"the foot\"", "2 1 the foot"), "quotes");
    says(two("2 1 \"the foot\"", "9 1 \"the foot\""), "dimension");
    says(two("50 1 1 1.5", "50 0.5 0.5 0"), "tetrahedron 2 at"); // with three others in a plane
    says(two("50 1 1 1.5", "50 0.5 0.5 0"), "no volume");
    says(two("10 20 30 40", "10 20 30 30"), "same node twice");
    says(refusal(msh2.substr(0, msh2.find("$Elements"))), "holds no tetrahedra");
    says(refusal(msh2 + "$Nodes\n0\n$EndNodes\n"), "a second section $Nodes");
    says(refusal(msh2 + "$Notes\n"), "the file ends where $EndNotes is expected");
    says(refusal(msh2 + "what\n"), "the beginning of a section");
    says(refusal("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + msh2.substr(msh2.find("$Elements"))), "$Elements before $Nodes");

    says(four("2 8 1 8", "2 9 1 8"), "8 nodes where 9 are expected");
    says(four("3 1 5 1", "3 1 5 2"), "an element's tag is expected and \"$EndElements\"");
    says(four("1 5 6 7 8", "1 5 6 7"), "an element of 4 nodes");
    says(four("3 1 5 1", "2 1 5 1"), "elements of dimension 3 in an entity of dimension 2");
    says(four("3 1 5 1", "3 1 5 9999999999"), "9999999999");
    says(four("2 2 1 2", "2 3 1 2"), "2 elements where 3 are expected");
    says(four("1 0 1 1\n", "1 0 1 1000000000000\n"), "a number of entities");
    says(four("1 1 1 -3 0", "1 1 5000000 -3 0"), "physical groups");
    says(four("1 1 1 -3 0", "1 1 5 -3 0"), "a physical group's number");
    says(four("2 5 0 4\n5\n6", "2 5 0 4\n5\n5"), "a second node 5");
    says(four("2 5 0 4", "7 5 0 4"), "dimension is 7");

    // Cut anywhere but behind its last section, a file is refused; whatever else changes, it is read or refused.
    const std::size_t whole = msh2.size() - 2;
    for (std::size_t k = 0; k < whole; k += 3) {
        INFO(k);
        CHECK_FALSE(refusal(msh2.substr(0, k) + " ").empty());
    }
    for (const auto& text : {msh2, msh4}) {
        for (std::size_t k = 0; k < text.size(); ++k) {
            std::string other = text;
            other[k] = std::string("9- \n$")[k % 5];
            CHECK_NOTHROW(refusal(other)); // message() lets nothing but std::runtime_error by
        }
    }
}

TEST_CASE("Gmsh's sections may come with comments anywhere, with parametric nodes, and with a byte-order mark") {
    const TemporaryFolder folder;
    const auto same = [&](const std::string& text) {
        const auto in = import_solid(folder.file("a.msh", text));
        CHECK(in.mesh.tetrahedra.size() == 2);
        CHECK(in.mesh.groups.size() == 3);
        CHECK(volume_of(in.mesh) == Approx(3.5 / 6.0));
    };
    const std::string comment = "$Comments\nmade by $hand\n$EndComment\n\n$EndComments\n";
    same(comment + msh2);
    same("\n" + comment + replaced(msh2, "$Nodes", comment + "$Nodes") + comment);
    same("\xEF\xBB\xBF" + msh2);
    std::string parametric = replaced(replaced(msh2, "$Nodes", "$ParametricNodes"), "$EndNodes", "$EndParametricNodes");
    same(parametric);
    parametric = replaced(replaced(parametric, "20 1 0 0", "20 1 0 0 1 3 0.5"), "30 0 1 0", "30 0 1 0 2 1 0.5 0.25");
    same(replaced(parametric, "40 0 0 1", "40 0 0 1 3 1"));
    says(message(folder.file("b.msh", replaced(parametric, "40 0 0 1", "40 0 0 1 3 1 0"))), "1 numbers too many");
    std::string returns = msh2;
    std::replace(returns.begin(), returns.end(), '\n', '\r');
    same(returns);
}

TEST_CASE("a scale must be positive") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(import_solid(folder.file("a.msh", msh2), 0.0), std::runtime_error);
    CHECK_THROWS_AS(import_solid(folder.file("a.msh", msh2), std::nan("")), std::runtime_error);
}
