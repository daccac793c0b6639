// Everything rigid that spheres meet: platens and surfaces.
#pragma once

#include <vector>

#include "core/boundaries/platen.hpp"
#include "core/boundaries/surface.hpp"

namespace proveta {

struct Walls {
    std::vector<Platen> platens;
    std::vector<Surface> surfaces;

    Walls() = default;
    // Implicit: a specimen between platens has no other walls.
    Walls(std::vector<Platen> only) : platens(std::move(only)) {}
    Walls(std::vector<Platen> forms, std::vector<Surface> meshes) : platens(std::move(forms)), surfaces(std::move(meshes)) {}
};

/// Fills in what follows from the listed spheres, for all of them.
inline void set_up_walls(const Spheres& spheres, const std::vector<Material>& materials, Walls& walls) {
    for (auto& platen : walls.platens) {
        set_up_platen(spheres, materials, platen);
    }
    for (auto& surface : walls.surfaces) {
        set_up_surface(spheres, materials, surface);
    }
}

} // namespace proveta
