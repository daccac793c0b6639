// Running a scene to a folder of results.
#pragma once

#include "lab/run.hpp"
#include "lab/scene/scene.hpp"

namespace proveta {

/// Plays the scene, or plays on from the checkpoint of its folder, writes the folder, prints the results on stdout. Throws InputError
/// before anything is written when the scene is wrong, or when the checkpoints are not of it, and FileError.
RunStatus run_scene(const Scene& scene, const RunOptions& options);

/// Looks at what only the making tells: files, forms, room. Says, on stderr, what the user should know of them. Throws InputError.
void try_scene(const Scene& scene);

} // namespace proveta
