// Unstructured grids of VTK.
#include <fmt/format.h>
#include <vtkCellTypes.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <stdexcept>

#include "specimens/solid_content.hpp"
#include "specimens/vtk_cells.hpp"
#include "specimens/vtk_legacy.hpp"
#include "specimens/vtk_reading.hpp"
#include "specimens/vtk_xml_check.hpp"

namespace proveta::solid_files {

namespace {

Kind vtk_kind_of(long long type, std::size_t cell, const std::string& file) {
    switch (type) {
    case VTK_VERTEX:
    case VTK_POLY_VERTEX: return Kind::point;
    case VTK_LINE:
    case VTK_POLY_LINE: return Kind::line;
    case VTK_TRIANGLE: return Kind::triangle;
    case VTK_QUAD: return Kind::quadrilateral;
    case VTK_TETRA: return Kind::tetrahedron;
    case VTK_HEXAHEDRON: return Kind::hexahedron;
    default: break;
    }
    const char* name =
        type >= 0 && type < VTK_NUMBER_OF_CELL_TYPES ? vtkCellTypes::GetClassNameFromTypeId(static_cast<int>(type)) : nullptr;
    throw std::runtime_error(fmt::format("{}: cell {} is of type {} ({}); bodies are made of linear tetrahedra and hexahedra, membranes of "
                                         "linear triangles and quadrilaterals",
                                         file, cell + 1, type, name == nullptr ? "unknown" : name));
}

// Before there are elements of it: what a file holds.
struct Grid {
    std::vector<Vec3> point;
    vtk::CellLists cells;
    std::vector<long long> type;
};

Grid read_legacy_grid(const std::string& file) {
    vtk::Legacy legacy = vtk::read_legacy(file, "UNSTRUCTURED_GRID");
    return {std::move(legacy.point), std::move(legacy.cells["CELLS"]), std::move(legacy.type)};
}

Grid read_xml_grid(const std::string& file) {
    vtk::check_xml(file);
    const auto [grid, complaint] = vtk::read_xml_with<vtkXMLUnstructuredGridReader>(file);
    if (!complaint.empty() || grid == nullptr) {
        throw std::runtime_error(file + ": cannot be read (" + complaint + ")");
    }
    if (grid->GetNumberOfPoints() >= static_cast<vtkIdType>(no_node)) {
        throw std::runtime_error(file + ": too many points");
    }
    Grid out;
    for (vtkIdType k = 0; grid->GetPoints() != nullptr && k < grid->GetNumberOfPoints(); ++k) {
        double x[3];
        grid->GetPoint(k, x);
        out.point.emplace_back(x[0], x[1], x[2]);
    }
    if (grid->GetCells() != nullptr && grid->GetCellTypesArray() != nullptr) {
        out.cells = vtk::cell_lists(*grid->GetCells(), out.point.size(), file);
        for (vtkIdType k = 0; k < grid->GetCellTypesArray()->GetNumberOfValues(); ++k) {
            out.type.push_back(grid->GetCellTypesArray()->GetValue(k));
        }
    }
    return out;
}

} // namespace

Content read_vtk(const std::string& file, bool legacy) {
    Grid grid = legacy ? read_legacy_grid(file) : read_xml_grid(file);
    if (grid.type.size() != grid.cells.size()) {
        throw std::runtime_error(fmt::format("{}: {} cells and {} types of cells", file, grid.cells.size(), grid.type.size()));
    }
    for (std::size_t k = 0; k < grid.point.size(); ++k) {
        if (const Vec3& x = grid.point[k]; !x.allFinite()) {
            throw std::runtime_error(fmt::format("{}: point {} is at {} {} {}", file, k + 1, x.x(), x.y(), x.z()));
        }
    }
    Content out;
    out.node = std::move(grid.point);
    for (std::size_t k = 0; k < grid.cells.size(); ++k) {
        Element element;
        element.kind = vtk_kind_of(grid.type[k], k, file);
        element.node.fill(no_node);
        if (const std::size_t points = grid.cells.points_of(k); dimension_of(element.kind) >= 2) { // others are of no use
            if (points != nodes_of(element.kind)) {
                throw std::runtime_error(
                    fmt::format("{}: cell {} has {} points where {} are expected", file, k + 1, points, nodes_of(element.kind)));
            }
            std::copy_n(grid.cells.point.begin() + static_cast<std::ptrdiff_t>(grid.cells.first[k]), points, element.node.begin());
        }
        out.elements.push_back(element);
    }
    return out;
}

} // namespace proveta::solid_files
