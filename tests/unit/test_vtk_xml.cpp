// XML files of VTK: what its own writers write passes the look before its readers, in whatever way it is written.
#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <functional>

#include "specimens/solid_import.hpp"
#include "specimens/surface_import.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// The ways of VTK's writers, one after the other. check: is given the written file.
template <class Writer, class Data> void each_way(Data& data, const std::string& file, const std::function<void()>& check) {
    const vtkNew<Writer> writer;
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
            for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
                for (const bool other : {false, true}) { // byte order, and appended bytes as they are
                    INFO("mode " << mode << ", compressor " << compressor << ", header " << header << ", other " << other);
                    writer->SetFileName(file.c_str());
                    writer->SetInputData(&data);
                    writer->SetDataMode(mode);
                    writer->SetCompressorType(compressor);
                    writer->SetBlockSize(4096);
                    writer->SetHeaderType(header);
                    writer->SetEncodeAppendedData(other ? 0 : 1);
                    other ? writer->SetByteOrderToBigEndian() : writer->SetByteOrderToLittleEndian();
                    REQUIRE(writer->Write() == 1);
                    check();
                }
            }
        }
    }
}

// Numbers of points and cells that have no place in a mesh, under a name that could be taken for the end of a tag.
template <class Data> void add_data(Data& data) {
    for (auto* of : {static_cast<vtkDataSetAttributes*>(data.GetPointData()), static_cast<vtkDataSetAttributes*>(data.GetCellData())}) {
        const vtkNew<vtkDoubleArray> array;
        array->SetName("stress > 1 MPa");
        const bool cells = of == static_cast<vtkDataSetAttributes*>(data.GetCellData());
        for (vtkIdType k = 0; k < (cells ? data.GetNumberOfCells() : data.GetNumberOfPoints()); ++k) {
            array->InsertNextValue(1e9 + static_cast<double>(k));
        }
        of->AddArray(array);
    }
}

constexpr int side = 12; // cells along the edge of the block: some arrays take several blocks of a compressor

} // namespace

TEST_CASE("VTK's unstructured grids in XML as VTK writes them") {
    const TemporaryFolder folder;
    const vtkNew<vtkUnstructuredGrid> grid;
    const vtkNew<vtkPoints> points;
    for (int k = 0; k < (side + 1) * (side + 1) * (side + 1); ++k) {
        points->InsertNextPoint(k % (side + 1), k / (side + 1) % (side + 1), k / ((side + 1) * (side + 1)));
    }
    grid->SetPoints(points);
    for (int k = 0; k < side * side * side; ++k) {
        const vtkIdType n = side + 1;
        const vtkIdType at = k % side + n * (k / side % side) + n * n * (k / (side * side));
        const vtkIdType corner[] = {at, at + 1, at + 1 + n, at + n, at + n * n, at + 1 + n * n, at + 1 + n + n * n, at + n + n * n};
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, corner);
    }
    add_data(*grid.Get());
    const std::string file = (folder.path() / "written.vtu").string();
    each_way<vtkXMLUnstructuredGridWriter>(*grid.Get(), file, [&] {
        const auto in = import_solid(file, 0.5);
        CHECK(in.mesh.node.size() == (side + 1) * (side + 1) * (side + 1));
        CHECK(volume_of(in.mesh) == Approx(side * side * side / 8.0));
    });
}

TEST_CASE("VTK's faces in XML as VTK writes them") {
    const TemporaryFolder folder;
    const vtkNew<vtkPolyData> sheet;
    const vtkNew<vtkPoints> points;
    const vtkNew<vtkCellArray> faces;
    for (int k = 0; k < (side + 1) * (side + 1); ++k) {
        points->InsertNextPoint(k % (side + 1), k / (side + 1), 0.0);
    }
    for (int k = 0; k < side * side; ++k) {
        const vtkIdType at = k % side + (side + 1) * (k / side);
        const vtkIdType corner[] = {at, at + 1, at + side + 2, at + side + 1};
        faces->InsertNextCell(4, corner);
    }
    sheet->SetPoints(points);
    sheet->SetPolys(faces);
    add_data(*sheet.Get());
    const std::string file = (folder.path() / "written.vtp").string();
    each_way<vtkXMLPolyDataWriter>(*sheet.Get(), file, [&] { CHECK(import_surface(file, 1.0).mesh.faces() == side * side); });
}
