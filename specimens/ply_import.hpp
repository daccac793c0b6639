// Surfaces of PLY files. VTK has a reader of them, which frees what it has not allocated when a header is not as it expects.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace proveta {

/// Reads vertices and faces of a PLY file, text or binary; other elements and properties are passed over. Throws std::runtime_error, naming
/// the file and what is wrong with it.
vtkSmartPointer<vtkPolyData> read_ply(const std::string& file);

} // namespace proveta
