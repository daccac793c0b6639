// A look at files of VTK before its readers, which trust the counts and lists in them and would reach beyond their memory otherwise.
#pragma once

#include <functional>
#include <string>

class vtkCellArray;

namespace proveta::vtk {

/// Takes a cell's type and number, and throws for one that is not wanted.
using CheckType = std::function<void(long long type, std::size_t cell)>;

/// The text of a legacy file of an unstructured grid: points, cells and their types only. Throws std::runtime_error, naming the file, for
/// counts that a file of its size cannot hold and for lists of cells that do not end where they should.
std::string checked_grid(const std::string& file, const CheckType& check);
/// The same of polygonal data.
std::string checked_polygons(const std::string& file);

/// Throws std::runtime_error for counts in an XML file that are none, or that no file of this size could hold, even compressed.
void check_xml(const std::string& file);

/// Throws std::runtime_error for cells that do not follow each other in the list of their points, or have points that are not there.
void check_cells(vtkCellArray& cells, long long points, const std::string& file);

} // namespace proveta::vtk
