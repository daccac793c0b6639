// The memory that a calculation needs, and the memory that is there: what cannot go well is refused before it begins.
#pragma once

#include <cstdint>
#include <string>

#include "specimens/specimen.hpp"

namespace proveta {

/// Memory that this process can still take, bytes: the least of what the machine has to give (MemAvailable), what is left of each control
/// group's limit (cgroup v2; cached files do not count) and what is left of the limit on its addresses (RLIMIT_AS). The greatest number
/// where none of them is known. root: where /proc and /sys are, for tests.
std::uint64_t available_memory(const std::string& root = "/");

/// Memory at the peak of a test, bytes: from packing, or loading, to the run. coordination: bonds that end at a sphere, on average.
std::uint64_t memory_needed(std::uint64_t spheres, double coordination);

/// Throws InputError where so many spheres need more memory than there is. path: of what sets their number; found: what it is.
void require_memory(std::uint64_t spheres, const std::string& source, const std::string& path, const std::string& found);

/// The same for the spheres or stones that a recipe asks for. path: of the recipe. A stored specimen is not looked at.
void require_memory(const SpecimenRecipe& recipe, const std::string& source, const std::string& path);

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30; ///< of a mesh or a surface, bytes: tens of millions of nodes

/// Throws std::runtime_error, naming the file, where it is none, is larger than `largest_file`, or would take more memory to read than
/// there is: some `growth` bytes for each of its own.
void require_file(const std::string& file, double growth = 12.0);

} // namespace proveta
