// Surfaces of faces.
#include "core/input/words.hpp"
#include "specimens/surface_import.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_surface_file(std::string_view bytes) {
    const std::string begin = input::lower_case(input::trimmed(bytes, "\xEF\xBB\xBF \t\r\n").substr(0, 5));
    const char* name = begin.starts_with("ply")                                                           ? "surface.ply"
                       : begin.starts_with("# vtk")                                                       ? "surface.vtk"
                       : begin.starts_with("<")                                                           ? "surface.vtp"
                       : begin.starts_with("v ") || begin.starts_with("# obj") || begin.starts_with("o ") ? "surface.obj"
                                                                                                          : "surface.stl";
    const std::string file = scratch_file(name, bytes);
    may_refuse([&] { (void)import_surface(file, 1e-3); });
}

} // namespace proveta::fuzz
