// What the readers of surfaces share: faces as files have them, before they are fit for contact.
#pragma once

#include <string>
#include <vector>

#include "core/boundaries/surface_mesh.hpp"

namespace proveta::surface_files {

struct Faces {
    SurfaceMesh mesh;               ///< in units of the file; faces may have any number of corners
    std::vector<std::size_t> line;  ///< in which each face stands; empty where the file has no lines
    std::vector<std::string> notes; ///< what was passed over
};

/// A strip of triangles; those of the same vertex twice, which only turn a strip, are none.
void add_strip(SurfaceMesh& mesh, const std::vector<std::uint32_t>& vertices);

/// Throws std::runtime_error, naming the file, where anything is wrong with it.
void refuse(const std::string& file, const std::vector<std::string>& problems);

/// Each reads the faces of a file, text or binary as its bytes tell. Throws std::runtime_error with the file, the line or the number of
/// what is wrong, what is expected and what was found.
Faces read_stl(const std::string& file);
Faces read_obj(const std::string& file);
Faces read_ply(const std::string& file);

} // namespace proveta::surface_files
