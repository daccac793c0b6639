// Gmsh's binary meshes, of both versions and both orders of bytes, which must be what the same meshes are as text.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>

#include "specimens/solid_import.hpp"
#include "tests/solid_shells.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// A file whose numbers are text, or bytes in either order.
class GmshWriter {
  public:
    enum class Form { text, little, big };
    explicit GmshWriter(Form form, std::size_t size = 8) : form_(form), size_(size) {}

    void line(const std::string& text) { out_ += text + "\n"; }
    // A record of text ends with its line.
    void end() { out_ += form_ == Form::text ? "\n" : ""; }
    void section_end(const std::string& name) { out_ += (form_ == Form::text ? "" : "\n") + ("$End" + name) + "\n"; }
    void integers(std::initializer_list<std::int32_t> values) {
        for (const auto v : values) {
            put(v);
        }
    }
    void sizes(std::initializer_list<std::uint64_t> values) {
        for (const auto v : values) {
            size_ == 8 ? put(v) : put(static_cast<std::uint32_t>(v));
        }
    }
    void reals(std::initializer_list<double> values) {
        for (const auto v : values) {
            put(v);
        }
    }
    void format(const std::string& version) {
        line("$MeshFormat");
        line(version + (form_ == Form::text ? " 0 " : " 1 ") + std::to_string(size_));
        if (form_ != Form::text) {
            integers({1});
        }
        section_end("MeshFormat");
    }
    [[nodiscard]] bool text() const { return form_ == Form::text; }
    [[nodiscard]] const std::string& all() const { return out_; }

  private:
    template <class Number> void put(Number value) {
        if (form_ == Form::text) {
            out_ += fmt::format("{} ", value);
            return;
        }
        std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
        if ((form_ == Form::big) == (std::endian::native == std::endian::little)) {
            std::reverse(bytes.begin(), bytes.end());
        }
        out_ += bytes;
    }

    Form form_;
    std::size_t size_;
    std::string out_;
};

constexpr double unit_cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// A cube of one hexahedron with a side in a group. parametric: of the nodes' places on curves and surfaces.
std::string cube_of_version_2(GmshWriter out, bool parametric) {
    out.line("$Comments\n\x01\x02 before the format\n$EndComments");
    out.format("2.2");
    out.line("$PhysicalNames\n1\n2 3 \"top\"\n$EndPhysicalNames");
    out.line(parametric ? "$ParametricNodes" : "$Nodes");
    out.line("8");
    for (int k = 0; k < 8; ++k) {
        out.integers({10 + k});
        out.reals({unit_cube[k][0], unit_cube[k][1], unit_cube[k][2]});
        if (parametric) {
            out.integers({k % 4, 1});
            for (int c = 0; c < k % 4 && k % 4 < 3; ++c) {
                out.reals({0.5});
            }
        }
        out.end();
    }
    out.section_end(parametric ? "ParametricNodes" : "Nodes");
    out.line("$Elements");
    out.line("2");
    if (out.text()) {
        out.integers({1, 3, 2, 3, 5, 14, 15, 16, 17});
        out.end();
        out.integers({2, 5, 2, 4, 1, 10, 11, 12, 13, 14, 15, 16, 17});
        out.end();
    } else {
        out.integers({3, 1, 2, 1, 3, 5, 14, 15, 16, 17});
        out.integers({5, 1, 2, 2, 4, 1, 10, 11, 12, 13, 14, 15, 16, 17});
    }
    out.section_end("Elements");
    return out.all();
}

std::string cube_of_version_4(GmshWriter out) {
    out.format("4.1");
    out.line("$PhysicalNames\n1\n2 3 \"top\"\n$EndPhysicalNames");
    out.line("$Entities");
    out.sizes({1, 0, 1, 1});
    out.end();
    out.integers({1});
    out.reals({0, 0, 0});
    out.sizes({0});
    out.end();
    for (const std::int32_t entity : {5, 1}) { // a surface and a volume
        out.integers({entity});
        out.reals({0, 0, 0, 1, 1, 1});
        out.sizes({1});
        out.integers({entity == 5 ? -3 : 4});
        out.sizes({1});
        out.integers({entity == 5 ? 1 : 5});
        out.end();
    }
    out.section_end("Entities");
    out.line("$Nodes");
    out.sizes({2, 8, 1, 8});
    out.end();
    for (const int block : {0, 1}) { // four nodes on a surface, with their places on it, and four others
        out.integers({3 - block, 1, block});
        out.sizes({4});
        out.end();
        for (std::uint64_t k = 1; k <= 4; ++k) {
            out.sizes({k + 4U * static_cast<std::uint64_t>(block)});
            out.end();
        }
        for (int k = 0; k < 4; ++k) {
            const auto& x = unit_cube[k + 4 * block];
            out.reals({x[0], x[1], x[2]});
            if (block == 1) {
                out.reals({0.25, 0.75});
            }
            out.end();
        }
    }
    out.section_end("Nodes");
    out.line("$Elements");
    out.sizes({2, 2, 1, 2});
    out.end();
    out.integers({2, 5, 3});
    out.sizes({1});
    out.end();
    out.sizes({1, 5, 6, 7, 8});
    out.end();
    out.integers({3, 1, 5});
    out.sizes({1});
    out.end();
    out.sizes({2, 1, 2, 3, 4, 5, 6, 7, 8});
    out.end();
    out.section_end("Elements");
    out.line("$Periodic\n\x01\x02\n$EndPeriodic");
    return out.all();
}

void check_cube(const ImportedSolid& in, const ImportedSolid& as_text) {
    CHECK(in.mesh.hexahedra == as_text.mesh.hexahedra);
    CHECK(in.mesh.node == as_text.mesh.node);
    CHECK(in.notes == as_text.notes);
    CHECK(volume_of(in.mesh) == Approx(1.0));
    REQUIRE(in.mesh.groups.size() == 2);
    CHECK(group(in.mesh, "top") == std::vector<std::uint32_t>{4, 5, 6, 7});
    CHECK(group(in.mesh, "4").size() == 8);
}

} // namespace

TEST_CASE("Gmsh's binary meshes are the same as their text") {
    const TemporaryFolder folder;
    using Form = GmshWriter::Form;
    for (const bool parametric : {false, true}) {
        const auto text = import_solid(folder.file("a.msh", cube_of_version_2(GmshWriter(Form::text), parametric)));
        check_cube(text, text);
        for (const Form form : {Form::little, Form::big}) {
            check_cube(import_solid(folder.file("b.msh", cube_of_version_2(GmshWriter(form), parametric))), text);
        }
    }
    const auto text = import_solid(folder.file("a.msh", cube_of_version_4(GmshWriter(Form::text))));
    check_cube(text, text);
    for (const Form form : {Form::little, Form::big}) {
        for (const std::size_t size : {4U, 8U}) {
            check_cube(import_solid(folder.file("b.msh", cube_of_version_4(GmshWriter(form, size)))), text);
        }
    }
}

TEST_CASE("binary meshes of Gmsh that are cut or broken are refused with the byte") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& bytes) { return message(folder.file("b.msh", bytes)); };
    const std::string two = cube_of_version_2(GmshWriter(GmshWriter::Form::little), false);
    const std::string four = cube_of_version_4(GmshWriter(GmshWriter::Form::little));
    says(refusal(replaced(two, "2.2 1 8", "2.2 1 4")), "the data size is 4, where 8 is expected");
    const auto number = [](std::int32_t value) { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
    says(refusal(replaced(two, "8\n" + number(1), "8\n" + number(3))), "the number 1 in four bytes is expected");
    const std::size_t nodes = two.find("$Nodes\n8\n") + 9;
    auto other = two;
    other.replace(nodes, 4, number(11));
    says(refusal(other), "byte " + std::to_string(nodes + 28) + ": a second node 11; the first is in byte " + std::to_string(nodes));
    other = two;
    other.replace(nodes + 4 + 6, 2, "\xf8\x7f"); // not a number
    says(refusal(other), "byte " + std::to_string(nodes + 4) + ": a node's coordinate, a finite number, is expected and nan was found");
    other = two;
    const std::size_t elements = two.find("$Elements\n2\n") + 12;
    other.replace(elements, 4, number(11));
    says(refusal(other), "byte " + std::to_string(elements) + ": a second-order tetrahedron");
    other.replace(elements, 8, number(3) + number(7));
    says(refusal(other), "a block of 7 elements where 2 are still expected");
    other.replace(elements, 8, number(3) + number(-7));
    says(refusal(other), "-7");
    for (const auto& text : {two, four}) {
        for (std::size_t k = 0; k < text.find("$EndElements"); ++k) {
            INFO(k);
            CHECK_FALSE(refusal(text.substr(0, k) + "\n").empty());
        }
        for (std::size_t k = 0; k < text.size(); ++k) {
            other = text;
            other[k] = static_cast<char>(other[k] ^ (1 << (k % 8)));
            CHECK_NOTHROW(refusal(other)); // message() lets nothing but std::runtime_error by
        }
    }
}
