// Sphere meshes of GiD and Kratos: how they may be written, and what is wrong with them.
#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "specimens/import.hpp"
#include "tests/solid_shells.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

std::string import_refusal(const std::string& file) {
    try {
        import_specimen(file, {});
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

const std::string gid_text = "MESH \"s\" dimension 3 ElemType Sphere Nnode 1\nCoordinates\n1 0 0 0\n2 0 0 1\nend coordinates\n"
                             "Elements\n1 1 0.5\n2 2 0.5\nend elements\n";
const std::string kratos_text = "Begin Nodes\n1 0 0 0\n2 0 0 1\nEnd Nodes\nBegin NodalData RADIUS\n1 0 0.5\n2 0 0.5\nEnd NodalData\n";

// As GiD writes meshes of spheres; nodes and elements of two spheres, and their numbers as announced.
std::string gid_binary(std::int32_t nodes, std::int32_t elements, std::int32_t second_node = 2, double second_radius = 0.5) {
    std::string out;
    const auto add = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const auto fill = [&](std::size_t bytes) { out.append(bytes, '\x07'); };
    for (const std::int32_t v : {3, 9, 1, nodes, elements}) {
        add(v);
    }
    for (const std::int32_t id : {1, second_node}) {
        add(id);
        fill(28);
        for (const double x : {0.0, 0.0, out.size() < 60 ? 0.0 : 1.0}) {
            add(x);
        }
    }
    fill(4);
    for (const std::int32_t id : {1, 2}) {
        add(id);
        fill(28);
        add(id);
        add(id == 1 ? 0.5 : second_radius);
    }
    return out;
}

} // namespace

TEST_CASE("sphere meshes are read in either case, with any line ends and byte-order marks") {
    const TemporaryFolder folder;
    const auto height = [&](const char* name, const std::string& text) {
        return import_specimen(folder.file(name, text), {}).specimen.shape.height;
    };
    std::string capitals;
    std::string returns;
    for (const char c : gid_text) {
        capitals += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        returns += c == '\n' ? '\r' : c;
    }
    CHECK(height("a.msh", capitals) == Approx(2.0));
    CHECK(height("b.MSH", returns) == Approx(2.0));
    CHECK(height("c.msh", "\xEF\xBB\xBF" + gid_text) == Approx(2.0));
    CHECK(height("d.mdpa", kratos_text) == Approx(2.0));
    CHECK(height("e.mdpa", replaced(kratos_text, "Begin Nodes", "begin nodes")) == Approx(2.0));
    CHECK(height("f.msh", gid_binary(2, 2)) == Approx(2.0));
    CHECK(height("g.CSV", "x,y,z,r\n0,0,0,0.5\n0,0,1,0.5\n") == Approx(2.0));
    const auto noted = import_specimen(folder.file("w.msh", "Unit \"m\"\n" + gid_text + "more\n"), {}).warnings;
    CHECK(any_has(noted, "2 lines outside Coordinates and Elements were passed over: 1, 11"));
    CHECK(any_has(import_specimen(folder.file("m.msh", gid_binary(2, 2) + "more"), {}).warnings, "4 bytes behind the last sphere"));
}

TEST_CASE("sphere meshes that are cut or contradict themselves are refused with line or number") {
    const TemporaryFolder folder;
    const auto in_gid = [&](const std::string& from, const std::string& to) {
        return import_refusal(folder.file("g.msh", replaced(gid_text, from, to)));
    };
    const auto in_kratos = [&](const std::string& from, const std::string& to) {
        return import_refusal(folder.file("k.mdpa", replaced(kratos_text, from, to)));
    };
    says(in_gid("end elements\n", ""), "the file ends before \"end elements\"");
    says(in_gid("end coordinates\n", ""), "g.msh:5: \"Elements\" before \"end coordinates\"");
    says(in_gid("end coordinates", "end elements"), "g.msh:5: \"end elements\" closes no block that is open");
    says(in_gid("2 0 0 1", "1 0 0 1"), "g.msh:4: a second node 1 in another place");
    says(in_gid("2 0 0 1", "2 0 0 nan"), "g.msh:4: \"nan\" is not a finite number");
    says(in_gid("2 2 0.5", "2 1 0.25"), "g.msh:8: a second radius of node 1, 0.25 after 0.5");
    says(in_gid("2 2 0.5", "2 3 0.5"), "g.msh:8: node 3 was not declared");
    says(in_gid("2 2 0.5", "2 2 0"), "radius 0 is not positive");
    CHECK(in_gid("2 0 0 1", "2 0 0 1\n2 0 0 1").empty());
    says(import_refusal(folder.file("m.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")), "a mesh of Gmsh");

    says(in_kratos("End NodalData\n", ""), "the file ends before \"End NodalData\"");
    says(in_kratos("End Nodes", "End Elements"), "closes no block that is open");
    says(in_kratos("2 0 0 1", "1 0 0 1"), "k.mdpa:3: a second node 1 in another place");
    says(in_kratos("2 0 0 1", "2 0 0 1 4"), "k.mdpa:3: a node needs its number and three coordinates");
    says(in_kratos("2 0 0 1", "2 0 0 1,25"), "k.mdpa:3: a node needs its number and three coordinates, with decimal points");
    says(in_kratos("2 0 0.5", "2 0 0,5"), "k.mdpa:7: a node's number, whether it is fixed, and a value are expected, with decimal points");
    says(in_gid("2 0 0 1", "2 0,5 0,25 1,5"), "g.msh:4: a node needs its number and two or three coordinates, with decimal points");
    says(in_kratos("2 0 0.5", "1 0 0.25"), "k.mdpa:7: a second radius of node 1");
    says(in_kratos("2 0 0.5", "\x01 0 0.5"), "\"?\" is not a finite number");

    const auto binary = [&](const std::string& bytes) { return import_refusal(folder.file("b.msh", bytes)); };
    says(binary(gid_binary(3, 2)), "it is cut short");
    says(binary(gid_binary(-2, 2)), "-2 nodes or spheres are announced");
    says(binary(gid_binary(2, 2).substr(0, 180)), "it is cut short");
    says(binary(gid_binary(2, 2, 1)), "a second node 1 in another place");
    says(binary(gid_binary(2, 2, 3)), "sphere 2: node 2 was not declared");
    says(binary(gid_binary(2, 2, 2, -1.0)), "sphere 2: radius -1 is not positive");
}
