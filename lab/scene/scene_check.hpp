// What a scene contradicts, beyond single values.
#pragma once

#include "lab/scene/scene.hpp"

namespace proveta {

/// Appends everything wrong with the scene as a whole: names, boxes, forms, motions, materials.
void check_scene(const Scene& scene, input::Problems& problems);

} // namespace proveta
