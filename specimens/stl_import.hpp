// Surfaces of STL files. VTK's reader of them makes room for as many faces as four bytes say, which text may be taken for.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace proveta {

/// Reads the faces of an STL file, text or binary. Throws std::runtime_error, naming the file and what is wrong with it.
vtkSmartPointer<vtkPolyData> read_stl(const std::string& file);

} // namespace proveta
