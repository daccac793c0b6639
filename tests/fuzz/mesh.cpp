// Meshes of deformable bodies and of spheres.
#include "core/input/words.hpp"
#include "specimens/import.hpp"
#include "specimens/solid_import.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_mesh_file(std::string_view bytes) {
    const auto spheres = [&](const char* name) {
        const std::string file = scratch_file(name, bytes);
        may_refuse([&] { (void)import_specimen(file, {}); });
    };
    const auto solid = [&](const char* name) {
        const std::string file = scratch_file(name, bytes);
        may_refuse([&] { (void)import_solid(file); });
    };
    const std::string begin = input::lower_case(input::trimmed(bytes, "\xEF\xBB\xBF \t\r\n").substr(0, 5));
    if (begin.starts_with("$")) {
        solid("mesh.msh");
    } else if (bytes.starts_with("# vtk")) {
        solid("mesh.vtk");
    } else if (bytes.starts_with("<")) {
        solid("mesh.vtu");
    } else if (begin == "begin") {
        spheres("mesh.mdpa");
    } else if (begin.starts_with("mesh") || bytes.starts_with(std::string_view("\3\0\0\0\11", 5))) { // GiD's, as text or as bytes
        spheres("mesh.msh");
    } else {
        spheres("mesh.csv");
    }
}

} // namespace proveta::fuzz
