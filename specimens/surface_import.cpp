#include "specimens/surface_import.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "specimens/memory.hpp"
#include "specimens/obj_import.hpp"
#include "specimens/ply_import.hpp"
#include "specimens/stl_import.hpp"
#include "specimens/vtk_legacy.hpp"
#include "specimens/vtk_reading.hpp"
#include "specimens/vtk_xml_check.hpp"

namespace proveta {

namespace {

std::string ending(const std::string& file) {
    std::string out = std::filesystem::path(file).extension().string();
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

vtkSmartPointer<vtkPolyData> poly_data_of(const vtk::Legacy& legacy) {
    const auto array_of = [&](const char* section) {
        const vtkNew<vtkCellArray> out;
        if (const auto found = legacy.cells.find(section); found != legacy.cells.end()) {
            const vtk::CellLists& cells = found->second;
            for (std::size_t k = 0; k < cells.size(); ++k) {
                out->InsertNextCell(static_cast<int>(cells.points_of(k)));
                for (std::size_t p = cells.first[k]; p < cells.first[k + 1]; ++p) {
                    out->InsertCellPoint(cells.point[p]);
                }
            }
        }
        return vtkSmartPointer<vtkCellArray>(out);
    };
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : legacy.point) {
        points->InsertNextPoint(p.data());
    }
    auto out = vtkSmartPointer<vtkPolyData>::New();
    out->SetPoints(points);
    out->SetPolys(array_of("POLYGONS"));
    out->SetStrips(array_of("TRIANGLE_STRIPS"));
    return out;
}

vtk::Read<vtkPolyData> read_as(const std::string& type, const std::string& file) {
    if (type == ".stl") {
        return {read_stl(file), ""};
    }
    if (type == ".obj") {
        return {read_obj(file), ""};
    }
    if (type == ".ply") {
        return {read_ply(file), ""};
    }
    if (type == ".vtk") {
        return {poly_data_of(vtk::read_legacy(file, "POLYDATA")), ""};
    }
    if (type == ".vtp") {
        vtk::check_xml(file);
        return vtk::read_xml_with<vtkXMLPolyDataReader>(file);
    }
    throw std::runtime_error(fmt::format("{}: surfaces are read from .stl, .obj, .ply, .vtk and .vtp files", file));
}

vtkSmartPointer<vtkPolyData> read_surface_data(const std::string& file) {
    require_file(file);
    const auto [data, complaint] = read_as(ending(file), file);
    if (data == nullptr || data->GetNumberOfPolys() + data->GetNumberOfStrips() == 0) {
        throw std::runtime_error(file + ": holds no faces" + (complaint.empty() ? "" : " (" + complaint + ")"));
    }
    for (vtkCellArray* cells : {data->GetPolys(), data->GetStrips()}) {
        (void)vtk::cell_lists(*cells, static_cast<std::size_t>(data->GetNumberOfPoints()), file); // throws
    }
    return data;
}

SurfaceMesh mesh_of(vtkPolyData& data, double scale, const std::string& file) {
    SurfaceMesh mesh;
    for (vtkIdType k = 0; k < data.GetNumberOfPoints(); ++k) {
        double x[3];
        data.GetPoint(k, x);
        const Vec3 v = scale * Vec3(x[0], x[1], x[2]);
        if (!(v.array().abs() <= farthest_corner).all()) { // nor what is no number
            throw std::runtime_error(fmt::format("{}: point {} is at {:.4g} {:.4g} {:.4g} m", file, k + 1, v.x(), v.y(), v.z()));
        }
        mesh.vertex.push_back(v);
    }
    vtkNew<vtkIdList> corners;
    for (data.GetPolys()->InitTraversal(); data.GetPolys()->GetNextCell(corners) != 0;) {
        std::vector<std::uint32_t> face;
        for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
            face.push_back(static_cast<std::uint32_t>(corners->GetId(k)));
        }
        if (face.size() >= 3) {
            mesh.add(face);
        }
    }
    return mesh;
}

vtkSmartPointer<vtkPolyData> cut_into_triangles(vtkPolyData& data) {
    vtkNew<vtkTriangleFilter> filter;
    filter->SetInputData(&data);
    filter->PassLinesOff();
    filter->PassVertsOff();
    filter->Update();
    return filter->GetOutput();
}

} // namespace

ImportedSurface import_surface(const std::string& file, double scale) {
    auto data = read_surface_data(file);
    ImportedSurface out;
    if (data->GetNumberOfStrips() > 0) {
        data = cut_into_triangles(*data);
    }
    const SurfaceMesh raw = mesh_of(*data, scale, file);
    out.mesh = welded(raw);
    std::size_t gone = raw.faces() - out.mesh.faces();
    out.state = look_at(out.mesh);
    if (!out.state.usable()) {
        out.notes.push_back(
            fmt::format("{} bent and {} concave polygons: all faces were cut into triangles", out.state.bent, out.state.concave));
        const SurfaceMesh cut = mesh_of(*cut_into_triangles(*data), scale, file);
        out.mesh = welded(cut);
        gone = cut.faces() - out.mesh.faces();
        out.state = look_at(out.mesh);
    }
    if (out.mesh.faces() == 0) {
        throw std::runtime_error(file + ": no face has an area");
    }
    if (gone > 0) {
        out.notes.push_back(fmt::format("{} faces without area, or there twice, were left out", gone));
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
