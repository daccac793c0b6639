// Meshes of deformable bodies and of spheres.
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
    if (bytes.starts_with("$")) {
        solid("mesh.msh");
    } else if (bytes.starts_with("# vtk")) {
        solid("mesh.vtk");
    } else if (bytes.starts_with("<")) {
        solid("mesh.vtu");
    } else if (bytes.starts_with("Begin")) {
        spheres("mesh.mdpa");
    } else if (bytes.starts_with("MESH")) {
        spheres("mesh.msh");
    } else {
        spheres("mesh.csv");
    }
}

} // namespace proveta::fuzz
