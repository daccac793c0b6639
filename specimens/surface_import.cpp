#include "specimens/surface_import.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace proveta {

namespace {

std::string ending(const std::string& file) {
    std::string out = std::filesystem::path(file).extension().string();
    std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

// Runs a reader; what it complains about ends up in `error` instead of on the screen.
template <class Reader> vtkSmartPointer<vtkPolyData> read_with(const std::string& file, std::string& error) {
    vtkNew<Reader> reader;
    vtkNew<vtkCallbackCommand> watch;
    watch->SetClientData(&error);
    watch->SetCallback([](vtkObject*, unsigned long, void* kept, void* text) {
        auto& out = *static_cast<std::string*>(kept);
        if (out.empty() && text != nullptr) {
            out = static_cast<const char*>(text);
        }
    });
    reader->AddObserver(vtkCommand::ErrorEvent, watch);
    reader->AddObserver(vtkCommand::WarningEvent, watch);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, watch); // says again that the reader failed
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> read(const std::string& file) {
    if (!std::filesystem::is_regular_file(file)) {
        throw std::runtime_error(file + ": no such file");
    }
    const std::string type = ending(file);
    std::string error;
    vtkSmartPointer<vtkPolyData> data;
    if (type == ".stl") {
        data = read_with<vtkSTLReader>(file, error);
    } else if (type == ".obj") {
        data = read_with<vtkOBJReader>(file, error);
    } else if (type == ".ply") {
        data = read_with<vtkPLYReader>(file, error);
    } else if (type == ".vtk") {
        data = read_with<vtkPolyDataReader>(file, error);
    } else if (type == ".vtp") {
        data = read_with<vtkXMLPolyDataReader>(file, error);
    } else {
        throw std::runtime_error(fmt::format("{}: surfaces are read from .stl, .obj, .ply, .vtk and .vtp files", file));
    }
    if (data == nullptr || data->GetNumberOfPolys() + data->GetNumberOfStrips() == 0) {
        // VTK's own words come as "ERROR: In file, line n\nclass (address): what".
        const auto said = error.substr(0, error.find_last_not_of(" \n") + 1);
        const auto what = said.rfind("): ");
        throw std::runtime_error(file + ": holds no faces" + (what == std::string::npos ? "" : " (" + said.substr(what + 3) + ")"));
    }
    return data;
}

SurfaceMesh mesh_of(vtkPolyData& data, double scale, const std::string& file) {
    SurfaceMesh mesh;
    for (vtkIdType k = 0; k < data.GetNumberOfPoints(); ++k) {
        double x[3];
        data.GetPoint(k, x);
        const Vec3 v = scale * Vec3(x[0], x[1], x[2]);
        if (!v.allFinite()) {
            throw std::runtime_error(fmt::format("{}: point {} is not finite", file, k + 1));
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
    auto data = read(file);
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
