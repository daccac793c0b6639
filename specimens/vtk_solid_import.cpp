// Unstructured grids of VTK.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <stdexcept>

#include "specimens/solid_content.hpp"
#include "specimens/vtk_check.hpp"
#include "specimens/vtk_reading.hpp"

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

// Where each cell's points begin among all; one more than there are cells.
std::vector<std::size_t> offsets_of(vtkCellArray& cells, const std::string& file) {
    vtkDataArray* offsets = cells.GetOffsetsArray();
    const auto points = static_cast<double>(cells.GetConnectivityArray()->GetNumberOfValues());
    std::vector<std::size_t> out;
    double last = 0.0;
    for (vtkIdType k = 0; k < offsets->GetNumberOfValues(); ++k) {
        const double offset = offsets->GetComponent(k, 0);
        if (offset < last || offset > points || (k == 0 && offset != 0.0)) {
            throw std::runtime_error(fmt::format("{}: offset {} of the cells is {}; {} points are listed", file, k + 1, offset, points));
        }
        last = offset;
        out.push_back(static_cast<std::size_t>(offset));
    }
    return out;
}

void add_points(vtkUnstructuredGrid& grid, Content& out) {
    const vtkIdType n = grid.GetPoints() == nullptr ? 0 : grid.GetNumberOfPoints();
    for (vtkIdType k = 0; k < n; ++k) {
        double x[3];
        grid.GetPoint(k, x);
        out.node.emplace_back(x[0], x[1], x[2]);
    }
}

void add_cells(vtkUnstructuredGrid& grid, const std::string& file, Content& out) {
    vtkCellArray* cells = grid.GetCells();
    vtkUnsignedCharArray* types = grid.GetCellTypesArray();
    if (cells == nullptr || types == nullptr) {
        return;
    }
    const auto first = offsets_of(*cells, file);
    const std::size_t n = first.empty() ? 0 : first.size() - 1;
    if (types->GetNumberOfValues() != static_cast<vtkIdType>(n)) {
        throw std::runtime_error(fmt::format("{}: {} cells and {} types of cells", file, n, types->GetNumberOfValues()));
    }
    vtkDataArray* point = cells->GetConnectivityArray();
    for (std::size_t k = 0; k < n; ++k) {
        Element element;
        element.kind = vtk_kind_of(types->GetValue(static_cast<vtkIdType>(k)), k, file);
        element.node.fill(no_node);
        if (dimension_of(element.kind) < 2) { // of any number of points, and of no use
            out.elements.push_back(element);
            continue;
        }
        if (first[k + 1] - first[k] != nodes_of(element.kind)) {
            throw std::runtime_error(fmt::format("{}: cell {} has {} points where {} are expected", file, k + 1, first[k + 1] - first[k],
                                                 nodes_of(element.kind)));
        }
        for (std::size_t c = 0; c < nodes_of(element.kind); ++c) {
            const std::size_t at = first[k] + c;
            const double id = point->GetComponent(static_cast<vtkIdType>(at), 0);
            if (!(id >= 0.0 && id < static_cast<double>(out.node.size()))) {
                throw std::runtime_error(fmt::format("{}: cell {} has point {}, and there are {}", file, k + 1, id, out.node.size()));
            }
            element.node[c] = static_cast<std::uint32_t>(id);
        }
        out.elements.push_back(element);
    }
}

} // namespace

Content read_vtk(const std::string& file, bool legacy) {
    vtk::Read<vtkUnstructuredGrid> read;
    if (legacy) {
        const auto check = [&](long long type, std::size_t cell) { (void)vtk_kind_of(type, cell, file); };
        read = vtk::read_text_with<vtkUnstructuredGridReader>(file, vtk::checked_grid(file, check));
    } else {
        vtk::check_xml(file);
        read = vtk::read_xml_with<vtkXMLUnstructuredGridReader>(file);
    }
    vtkUnstructuredGrid* grid = read.data;
    if (!read.complaint.empty() || grid == nullptr) {
        throw std::runtime_error(file + ": cannot be read (" + read.complaint + ")");
    }
    if (grid->GetNumberOfPoints() >= static_cast<vtkIdType>(no_node)) {
        throw std::runtime_error(file + ": too many points");
    }
    Content out;
    add_points(*grid, out);
    add_cells(*grid, file, out);
    return out;
}

} // namespace proveta::solid_files
