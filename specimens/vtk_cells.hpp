// Cells as VTK's files hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkCellArray;

namespace proveta::vtk {

/// Lists of points: those of cell k are point[first[k]] up to the one before point[first[k + 1]].
struct CellLists {
    std::vector<std::size_t> first; ///< one more than there are cells, or none
    std::vector<std::uint32_t> point;

    [[nodiscard]] std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
    [[nodiscard]] std::size_t points_of(std::size_t cell) const { return first[cell + 1] - first[cell]; }
};

/// Lists from numbers as a file gives them. Throws std::runtime_error, naming the file, for offsets that do not rise from 0 to the number
/// of points listed, and for points that are not among so many.
CellLists cell_lists(const std::vector<long long>& offset, const std::vector<long long>& listed, std::size_t points,
                     const std::string& file);

/// The cells of one of VTK's arrays. Throws std::runtime_error as above.
CellLists cell_lists(vtkCellArray& cells, std::size_t points, const std::string& file);

} // namespace proveta::vtk
