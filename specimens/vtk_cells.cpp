#include "specimens/vtk_cells.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>

#include <stdexcept>

namespace proveta::vtk {

namespace {

std::vector<long long> numbers_of(vtkDataArray& array) {
    std::vector<long long> out;
    for (vtkIdType k = 0; k < array.GetNumberOfValues(); ++k) {
        out.push_back(static_cast<long long>(array.GetComponent(k, 0)));
    }
    return out;
}

} // namespace

CellLists cell_lists(const std::vector<long long>& offset, const std::vector<long long>& listed, std::size_t points,
                     const std::string& file) {
    CellLists out;
    const auto last = static_cast<long long>(listed.size());
    for (std::size_t k = 0; k < offset.size(); ++k) {
        const bool start = k == 0;
        if (offset[k] < (start ? 0 : offset[k - 1]) || offset[k] > last || (start && offset[k] != 0)) {
            throw std::runtime_error(fmt::format("{}: offset {} of the cells is {}; {} points are listed", file, k + 1, offset[k], last));
        }
        out.first.push_back(static_cast<std::size_t>(offset[k]));
    }
    for (std::size_t cell = 0; cell < out.size(); ++cell) {
        for (std::size_t k = out.first[cell]; k < out.first[cell + 1]; ++k) {
            if (listed[k] < 0 || listed[k] >= static_cast<long long>(points)) {
                throw std::runtime_error(fmt::format("{}: cell {} has point {}, and there are {}", file, cell + 1, listed[k], points));
            }
            out.point.push_back(static_cast<std::uint32_t>(listed[k]));
        }
    }
    return out;
}

CellLists cell_lists(vtkCellArray& cells, std::size_t points, const std::string& file) {
    return cell_lists(numbers_of(*cells.GetOffsetsArray()), numbers_of(*cells.GetConnectivityArray()), points, file);
}

} // namespace proveta::vtk
