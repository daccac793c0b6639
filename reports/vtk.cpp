#include "reports/vtk.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <stdexcept>

#include "core/files/whole_file.hpp"

namespace proveta::report {

std::vector<double> interleaved(const VectorField& f) {
    std::vector<double> out;
    out.reserve(3 * f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
        out.insert(out.end(), {f.x[k], f.y[k], f.z[k]});
    }
    return out;
}

namespace {

void add_arrays(vtkFieldData* target, const std::vector<FieldArray>& arrays) {
    for (const auto& a : arrays) {
        vtkNew<vtkFloatArray> out;
        out->SetName(a.name.c_str());
        out->SetNumberOfComponents(a.components);
        out->SetNumberOfTuples(static_cast<vtkIdType>(a.values.size()) / a.components);
        for (std::size_t k = 0; k < a.values.size(); ++k) {
            out->SetValue(static_cast<vtkIdType>(k), static_cast<float>(a.values[k]));
        }
        target->AddArray(out);
    }
}

} // namespace

void write_vtp(const std::string& file, const Geometry& g) {
    vtkObject::GlobalWarningDisplayOff(); // failures are reported by the exception below
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(g.points.size()));
    for (std::size_t k = 0; k < g.points.size(); ++k) {
        points->SetPoint(static_cast<vtkIdType>(k), g.points.x[k], g.points.y[k], g.points.z[k]);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkCellArray> polygons;
    if (g.cells.empty()) {
        for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k) {
            vertices->InsertNextCell(1, &k);
        }
        data->SetVerts(vertices);
    }
    for (const auto& cell : g.cells) {
        const std::vector<vtkIdType> ids(cell.begin(), cell.end());
        (ids.size() == 2 ? lines : polygons)->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    }
    if (!g.cells.empty()) {
        data->SetLines(lines);
        data->SetPolys(polygons);
    }
    add_arrays(data->GetPointData(), g.point_arrays);
    add_arrays(data->GetCellData(), g.cell_arrays);

    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->WriteToOutputStringOn();
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    if (writer->Write() == 0) {
        throw std::runtime_error(file + ": VTK could not make it");
    }
    const std::string text = writer->GetOutputString();
    write_whole(file, text.data(), text.size());
}

std::string to_pvd(const std::vector<SeriesEntry>& entries) {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const auto& e : entries) {
        out += fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", e.time,
                           e.part == "spheres" ? 0 : (e.part == "bonds" ? 1 : 2), e.part, e.file);
    }
    return out + "  </Collection>\n</VTKFile>\n";
}

} // namespace proveta::report
