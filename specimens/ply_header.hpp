// What a PLY file says of itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace proveta::surface_files {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool list = false;
    PlyType count = PlyType::uint8; ///< of a list
    std::optional<int> axis;        ///< of the coordinate that it is
    bool vertices = false;          ///< a list of a face's or a strip's vertices
};

struct PlyElement {
    std::string name; ///< in lower case
    std::size_t number = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    bool binary = false;
    bool turned = false; ///< bytes are in the other order than this machine's
    std::vector<PlyElement> elements;
    std::size_t vertices = 0;
    std::size_t end = 0;   ///< where what it announces begins
    std::size_t lines = 0; ///< its own
};

/// Reads a header. Throws std::runtime_error, naming the file and the line, also where vertices have no place and where nothing lists the
/// vertices of faces or strips.
PlyHeader read_ply_header(std::string_view text, const std::string& file);

} // namespace proveta::surface_files
