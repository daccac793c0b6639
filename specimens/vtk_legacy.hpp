// VTK's legacy files. VTK has readers of them, which trust every count and reach beyond their memory on a damaged file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/geometry/vector_field.hpp"
#include "specimens/vtk_cells.hpp"

namespace proveta::vtk {

/// Points and cells of a file.
struct Legacy {
    std::vector<Vec3> point;
    std::map<std::string, CellLists> cells; ///< by the names of their sections, in capitals
    std::vector<long long> type;            ///< of the cells of a grid
};

/// Reads the geometry of a legacy file, versions 1.0 to 5.1, text or binary, of one kind of dataset: UNSTRUCTURED_GRID or POLYDATA. Fields
/// and data of points and cells are passed over. Throws std::runtime_error, naming the file and what is wrong with it.
Legacy read_legacy(const std::string& file, const std::string& dataset);

} // namespace proveta::vtk
