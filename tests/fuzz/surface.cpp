// Surfaces of faces.
#include "specimens/surface_import.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_surface_file(std::string_view bytes) {
    const char* name = bytes.starts_with("ply")                                                           ? "surface.ply"
                       : bytes.starts_with("# vtk")                                                       ? "surface.vtk"
                       : bytes.starts_with("<")                                                           ? "surface.vtp"
                       : bytes.starts_with("v ") || bytes.starts_with("# obj") || bytes.starts_with("o ") ? "surface.obj"
                                                                                                          : "surface.stl";
    const std::string file = scratch_file(name, bytes);
    may_refuse([&] { (void)import_surface(file, 1e-3); });
}

} // namespace proveta::fuzz
