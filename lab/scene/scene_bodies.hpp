// From the bodies that a scene describes to those of the calculation.
#pragma once

#include <string>
#include <vector>

#include "core/coupling/deformable.hpp"
#include "lab/scene/scene.hpp"

namespace proveta {

/// The bodies of a scene, in its order. notes: what was mended in files. Throws InputError with every problem.
std::vector<Deformable> make_bodies(const Scene& scene, const std::vector<Material>& materials, std::vector<std::string>& notes);

/// Sets what bodies are under at a time: pressures on their ramps.
void drive_bodies(const Scene& scene, double time, std::vector<Deformable>& bodies);

/// Whether a body is still held with a velocity, brought under pressure or moving faster than the scene calls rest. number: in the scene.
bool still_driven(const Deformable& body, double time, const Scene& scene, std::size_t number);

/// What a body's keys contradict. at: its path.
void check_body(const BodyInput& body, const std::string& source, const std::string& at, input::Problems& problems);

} // namespace proveta
