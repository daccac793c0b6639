#include "specimens/surface_import.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>
#include <stdexcept>

#include "core/input/words.hpp"
#include "specimens/memory.hpp"
#include "specimens/surface_content.hpp"
#include "specimens/vtk_cells.hpp"
#include "specimens/vtk_legacy.hpp"
#include "specimens/vtk_reading.hpp"
#include "specimens/vtk_xml_check.hpp"

namespace proveta {

namespace surface_files {

void add_strip(SurfaceMesh& mesh, const std::vector<std::uint32_t>& vertices) {
    for (std::size_t k = 0; k + 2 < vertices.size(); ++k) {
        const auto a = vertices[k + k % 2]; // every other one goes round the other way
        const auto b = vertices[k + 1 - k % 2];
        const auto c = vertices[k + 2];
        if (a != b && b != c && c != a) {
            mesh.add({a, b, c});
        }
    }
}

void refuse(const std::string& file, const std::vector<std::string>& problems) {
    if (!problems.empty()) {
        const std::string count = problems.size() > 5 ? fmt::format("{} problems: ", problems.size()) : "";
        throw std::runtime_error(fmt::format("{}: {}{}", file, count, input::first_few(problems, "; ")));
    }
}

} // namespace surface_files

namespace {

using surface_files::Faces;

// Sections of a VTK file, by the names of its legacy format.
void add_cells(Faces& faces, const std::string& section, const vtk::CellLists& cells) {
    if (section == "VERTICES" || section == "LINES") {
        if (cells.size() > 0) {
            faces.notes.push_back(fmt::format("{} {} were passed over", cells.size(), section == "LINES" ? "lines" : "points"));
        }
        return;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const std::vector<std::uint32_t> face(cells.point.begin() + static_cast<std::ptrdiff_t>(cells.first[k]),
                                              cells.point.begin() + static_cast<std::ptrdiff_t>(cells.first[k + 1]));
        if (section == "POLYGONS") {
            faces.mesh.add(face);
        } else if (section == "TRIANGLE_STRIPS") {
            surface_files::add_strip(faces.mesh, face);
        }
    }
}

Faces read_legacy_surface(const std::string& file) {
    vtk::Legacy legacy = vtk::read_legacy(file, "POLYDATA");
    Faces out;
    out.mesh.vertex = std::move(legacy.point);
    for (const auto& [section, cells] : legacy.cells) {
        add_cells(out, section, cells);
    }
    return out;
}

Faces read_xml_surface(const std::string& file) {
    vtk::check_xml(file);
    const auto [data, complaint] = vtk::read_xml_with<vtkXMLPolyDataReader>(file);
    if (data == nullptr || !complaint.empty()) {
        throw std::runtime_error(file + ": cannot be read (" + complaint + ")");
    }
    Faces out;
    for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k) {
        double x[3];
        data->GetPoint(k, x);
        out.mesh.vertex.emplace_back(x[0], x[1], x[2]);
    }
    for (const auto& [section, cells] : {std::pair{"VERTICES", data->GetVerts()},
                                         {"LINES", data->GetLines()},
                                         {"POLYGONS", data->GetPolys()},
                                         {"TRIANGLE_STRIPS", data->GetStrips()}}) {
        add_cells(out, section, vtk::cell_lists(*cells, out.mesh.vertex.size(), file));
    }
    return out;
}

Faces read_as(const std::string& type, const std::string& file) {
    require_file(file);
    if (type == ".stl") {
        return surface_files::read_stl(file);
    }
    if (type == ".obj") {
        return surface_files::read_obj(file);
    }
    if (type == ".ply") {
        return surface_files::read_ply(file);
    }
    if (type == ".vtk") {
        return read_legacy_surface(file);
    }
    if (type == ".vtp") {
        return read_xml_surface(file);
    }
    throw std::runtime_error(fmt::format("{}: surfaces are read from .stl, .obj, .ply, .vtk and .vtp files", file));
}

SurfaceMesh scaled(SurfaceMesh mesh, double scale, const std::string& file) {
    std::vector<std::string> problems;
    for (std::size_t k = 0; k < mesh.vertex.size(); ++k) {
        Vec3& v = mesh.vertex[k];
        v *= scale;
        if (!(v.array().abs() <= farthest_corner).all()) { // nor what is no number
            problems.push_back(fmt::format("point {} is at {:.4g} {:.4g} {:.4g} m", k + 1, v.x(), v.y(), v.z()));
        }
    }
    surface_files::refuse(file, problems);
    return mesh;
}

SurfaceMesh cut_into_triangles(const SurfaceMesh& mesh) {
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& v : mesh.vertex) {
        points->InsertNextPoint(v.data());
    }
    const vtkNew<vtkCellArray> faces;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        if (mesh.corners(f) < 3) {
            continue;
        }
        faces->InsertNextCell(static_cast<int>(mesh.corners(f)));
        for (auto k = mesh.first[f]; k < mesh.first[f + 1]; ++k) {
            faces->InsertCellPoint(mesh.corner[k]);
        }
    }
    const vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(faces);
    const vtkNew<vtkTriangleFilter> filter;
    filter->SetInputData(data);
    filter->Update();
    SurfaceMesh out;
    out.vertex = mesh.vertex;
    const vtkNew<vtkIdList> corners;
    for (auto* cut = filter->GetOutput()->GetPolys(); cut->GetNextCell(corners) != 0;) {
        std::vector<std::uint32_t> face;
        for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
            face.push_back(static_cast<std::uint32_t>(corners->GetId(k)));
        }
        out.add(face);
    }
    return out;
}

// "3 faces without area were left out: 13 (line 93), ...".
void note_faces(const std::vector<std::size_t>& numbers, const char* what, const Faces& faces, std::vector<std::string>& notes) {
    std::vector<std::string> which;
    for (const std::size_t f : numbers) {
        which.push_back(faces.line.empty() ? fmt::format("{}", f + 1) : fmt::format("{} (line {})", f + 1, faces.line[f]));
    }
    if (!which.empty()) {
        notes.push_back(fmt::format("{} faces {}: {}", which.size(), what, input::first_few(which)));
    }
}

} // namespace

ImportedSurface import_surface(const std::string& file, double scale) {
    Faces faces = read_as(input::lower_case(std::filesystem::path(file).extension().string()), file);
    if (faces.mesh.faces() == 0) {
        throw std::runtime_error(
            fmt::format("{}: holds no faces{}{}", file, faces.notes.empty() ? "" : "; ", input::first_few(faces.notes)));
    }
    ImportedSurface out;
    out.notes = std::move(faces.notes);
    WeldedSurface found = welded(scaled(faces.mesh, scale, file));
    note_faces(found.flat, "without area were left out", faces, out.notes);
    note_faces(found.repeated, "that are there twice were taken once", faces, out.notes);
    out.mesh = std::move(found.mesh);
    out.state = look_at(out.mesh);
    if (!out.state.usable()) {
        out.notes.push_back(
            fmt::format("{} bent and {} concave polygons: all faces were cut into triangles", out.state.bent, out.state.concave));
        out.mesh = welded(scaled(cut_into_triangles(faces.mesh), scale, file)).mesh;
        out.state = look_at(out.mesh);
    }
    if (out.mesh.faces() == 0) {
        throw std::runtime_error(file + ": no face has an area");
    }
    if (out.state.open_edges > 0) {
        out.notes.push_back(fmt::format("open: {} edges belong to one face only ({})", out.state.open_edges, out.state.notes.front()));
    }
    if (out.state.turned_edges > 0) {
        out.notes.push_back(fmt::format("normals contradict each other across {} edges; spheres meet both sides of a face all the same",
                                        out.state.turned_edges));
    }
    if (out.state.closed() && out.mesh.volume() < 0.0) {
        out.notes.emplace_back("normals point inwards; spheres meet both sides of a face all the same");
    }
    return out;
}

} // namespace proveta
