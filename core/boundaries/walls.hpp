// Everything that spheres meet besides each other: platens, surfaces, deformable bodies.
#pragma once

#include <vector>

#include "core/boundaries/platen.hpp"
#include "core/boundaries/surface.hpp"
#include "core/coupling/deformable.hpp"

namespace proveta {

struct Walls {
    std::vector<Platen> platens;
    std::vector<Surface> surfaces;
    std::vector<Deformable> bodies;

    Walls() = default;
    // Implicit: a specimen between platens has no other walls.
    Walls(std::vector<Platen> only) : platens(std::move(only)) {}
    Walls(std::vector<Platen> forms, std::vector<Surface> meshes, std::vector<Deformable> deformables = {})
        : platens(std::move(forms)), surfaces(std::move(meshes)), bodies(std::move(deformables)) {}
};

/// Fills in what follows from the listed spheres, for all of them.
inline void set_up_walls(const Spheres& spheres, const std::vector<Material>& materials, Walls& walls) {
    for (auto& platen : walls.platens) {
        set_up_platen(spheres, materials, platen);
    }
    for (auto& surface : walls.surfaces) {
        set_up_surface(spheres, materials, surface);
    }
    for (auto& body : walls.bodies) {
        set_up_deformable(spheres, materials, body);
    }
}

} // namespace proveta
