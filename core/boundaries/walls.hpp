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

} // namespace proveta
