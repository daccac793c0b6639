// The surfaces of a scene, made and put into place.
#pragma once

#include <string>
#include <vector>

#include "core/boundaries/surface.hpp"
#include "lab/scene/scene.hpp"

namespace proveta {

/// The surfaces as the physics wants them. notes: what a user should know of those from files. Throws InputError, with every problem,
/// for files that cannot be used.
std::vector<Surface> make_surfaces(const Scene& scene, const std::vector<Material>& materials, std::vector<std::string>& notes);

/// The form of a particle that a closed surface from a file gives. Throws InputError; path: where the scene names it.
SurfaceMesh closed_surface(const Scene& scene, const std::string& file, const std::string& path);

} // namespace proveta
