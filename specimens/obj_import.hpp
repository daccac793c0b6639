// Surfaces of OBJ files. VTK's reader of them ends the program when a face has a vertex that is not there.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace proveta {

/// Reads vertices and faces of an OBJ file; normals, textures, lines, groups and materials are passed over. Throws std::runtime_error,
/// naming file, line and what is wrong with it.
vtkSmartPointer<vtkPolyData> read_obj(const std::string& file);

} // namespace proveta
