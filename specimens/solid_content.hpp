// What the readers of meshes of deformable bodies share: elements as files hold them, before they are a mesh.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/vector_field.hpp"

namespace proveta::solid_files {

constexpr auto no_node = std::numeric_limits<std::uint32_t>::max();

enum class Kind { point, line, triangle, quadrilateral, tetrahedron, hexahedron };

std::size_t nodes_of(Kind kind);
int dimension_of(Kind kind);

struct Element {
    Kind kind = Kind::point;
    bool grouped = false;
    std::array<std::uint32_t, 8> node{}; // beyond the kind's own: no_node
    long long tag = 0;                   // its number in the file
    std::size_t place = 0;               // its line or byte
};

// What a file holds, before it is a mesh.
struct Content {
    using Name = std::pair<int, long long>; // dimension and number of a physical group
    std::vector<Vec3> node;                 // in units of the file
    std::vector<Element> elements;
    std::map<Name, std::vector<std::uint32_t>> group;
    std::map<Name, std::string> name;
    std::vector<std::string> notes;
};

/// The whole file. Throws std::runtime_error.
std::string bytes_of(const std::string& file);

/// The same as UTF-8 without a byte-order mark.
std::string text_of(const std::string& file);

template <class Number> bool parse(std::string_view text, Number& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
        text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// A Gmsh mesh, versions 2.2 and 4.1, ASCII or binary. Throws std::runtime_error.
Content read_gmsh(const std::string& file);

/// A VTK unstructured grid, legacy or XML. Throws std::runtime_error.
Content read_vtk(const std::string& file, bool legacy);

} // namespace proveta::solid_files
