// Legacy files of VTK: what its own writers write is read, and what is damaged is refused.
#include <catch2/catch.hpp>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>

#include "specimens/vtk_legacy.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

// Data that have no place in a mesh: numbers of the points and cells, called like sections, and a field of numbers and words.
template <class Data> void add_arrays(Data& data) {
    for (auto [name, of] : {std::pair<const char*, vtkFieldData*>{"cells", data.GetPointData()}, {"points", data.GetCellData()}}) {
        const vtkNew<vtkDoubleArray> array;
        array->SetName(name);
        for (vtkIdType k = 0; k < (of == data.GetCellData() ? data.GetNumberOfCells() : data.GetNumberOfPoints()); ++k) {
            array->InsertNextValue(0.5 * static_cast<double>(k));
        }
        of->AddArray(array);
    }
    const vtkNew<vtkStringArray> words;
    words->SetName("note");
    words->InsertNextValue("POINTS of view");
    data.GetFieldData()->AddArray(words);
    words->InsertNextValue(std::string(300, 'x')); // whose length takes two bytes
    for (const char* name : {"TIME", "lines", "CELLS", "cell_data"}) {
        const vtkNew<vtkDoubleArray> array;
        array->SetName(name);
        array->InsertNextValue(0.25);
        array->InsertNextValue(1e300);
        data.GetFieldData()->AddArray(array);
    }
    const vtkNew<vtkBitArray> bits;
    bits->SetName("bits");
    for (int k = 0; k < 11; ++k) {
        bits->InsertNextValue(k % 2);
    }
    data.GetFieldData()->AddArray(bits);
}

template <class Writer, class Data> std::string written(Data& data, int version, bool binary, const TemporaryFolder& folder) {
    const vtkNew<Writer> writer;
    const std::string file = folder.file("written.vtk");
    writer->SetFileName(file.c_str());
    writer->SetFileVersion(version);
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    writer->SetInputData(&data);
    REQUIRE(writer->Write() == 1);
    return file;
}

vtkNew<vtkPoints> corners(int type) {
    vtkNew<vtkPoints> out;
    out->SetDataType(type);
    for (const auto& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0.125), Vec3(-2.5, 3, 1e-3)}) {
        out->InsertNextPoint(p.data());
    }
    return out;
}

} // namespace

TEST_CASE("VTK's legacy files as VTK writes them, old and new, text and binary") {
    const TemporaryFolder folder;
    for (const int version : {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
        for (const bool binary : {false, true}) {
            for (const int type : {VTK_FLOAT, VTK_DOUBLE, VTK_SHORT, VTK_UNSIGNED_CHAR, VTK_ID_TYPE}) {
                INFO("version " << version << ", binary " << binary << ", type " << type);
                const vtkNew<vtkUnstructuredGrid> grid;
                grid->SetPoints(corners(type));
                const vtkIdType tetrahedron[] = {0, 1, 2, 3};
                const vtkIdType triangle[] = {4, 2, 1};
                grid->InsertNextCell(VTK_TETRA, 4, tetrahedron);
                grid->InsertNextCell(VTK_TRIANGLE, 3, triangle);
                add_arrays(*grid.Get());
                const auto in = proveta::vtk::read_legacy(written<vtkUnstructuredGridWriter>(*grid.Get(), version, binary, folder),
                                                          "UNSTRUCTURED_GRID");
                REQUIRE(in.point.size() == 5);
                CHECK(in.point[1] == Vec3(1, 0, 0));
                if (type == VTK_FLOAT || type == VTK_DOUBLE) {
                    CHECK(in.point[3].z() == 0.125);
                    CHECK(in.point[4].z() == Approx(1e-3).epsilon(1e-7));
                } else if (type != VTK_UNSIGNED_CHAR) {
                    CHECK(in.point[4] == Vec3(-2, 3, 0));
                }
                CHECK(in.type == std::vector<long long>{VTK_TETRA, VTK_TRIANGLE});
                CHECK(in.cells.at("CELLS").first == std::vector<std::size_t>{0, 4, 7});
                CHECK(in.cells.at("CELLS").point == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 2, 1});

                const vtkNew<vtkPolyData> faces;
                faces->SetPoints(corners(type));
                const vtkNew<vtkCellArray> polygons;
                polygons->InsertNextCell(4, tetrahedron);
                polygons->InsertNextCell(3, triangle);
                faces->SetPolys(polygons);
                const vtkNew<vtkCellArray> lines;
                lines->InsertNextCell(2, triangle);
                faces->SetLines(lines);
                add_arrays(*faces.Get());
                const auto surface =
                    proveta::vtk::read_legacy(written<vtkPolyDataWriter>(*faces.Get(), version, binary, folder), "POLYDATA");
                CHECK(surface.point.size() == 5);
                CHECK(surface.cells.at("POLYGONS").point == in.cells.at("CELLS").point);
                CHECK(surface.cells.at("LINES").first == std::vector<std::size_t>{0, 2});
            }
        }
    }
}

TEST_CASE("VTK's legacy files that are damaged are refused with what is wrong") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& body, const std::string& head = "# vtk DataFile Version 5.1\nt\nASCII\n") {
        try {
            proveta::vtk::read_legacy(folder.file("bad.vtk", head + "DATASET POLYDATA\n" + body), "POLYDATA");
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    const std::string points = "POINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
    const auto polygons = [&](const std::string& offsets, const std::string& listed) {
        return points + "POLYGONS 2 3\nOFFSETS vtktypeint64\n" + offsets + "\nCONNECTIVITY vtktypeint64\n" + listed + "\n";
    };
    using Catch::Contains;
    CHECK(refusal(polygons("0 3", "0 1 2")).empty());
    CHECK_THAT(refusal(polygons("1 3", "0 1 2")), Contains("offset 1 of the cells is 1"));
    CHECK_THAT(refusal(polygons("0 4", "0 1 2")), Contains("the last offset is 4"));
    CHECK_THAT(refusal(polygons("3 0", "0 1 2")), Contains("the last offset is 0"));
    CHECK_THAT(refusal(polygons("0 3", "0 1 3")), Contains("cell 1 has point 3, and there are 3"));
    CHECK_THAT(refusal(polygons("0 3", "0 1 1.5")), Contains("number 3 is \"1.5\""));
    CHECK_THAT(refusal(polygons("0 3", "0 1")), Contains("missing: the file ends"));
    CHECK_THAT(refusal(points + "POLYGONS 2 99999\n"), Contains("99999"));
    CHECK_THAT(refusal(points + points), Contains("a second section POINTS"));
    CHECK(refusal(points + "LINES 0 0\nPOLYGONS 0 0\nOFFSETS int\nCONNECTIVITY int\n").empty());
    CHECK_THAT(refusal("FIELD data 1\nx 1 5 double\n1 2 3 4\n"), Contains("missing: the file ends"));
    CHECK_THAT(refusal("FIELD data 1\nx 1 5 what\n1 2 3 4\n"), Contains("\"what\""));
    CHECK_THAT(refusal(points + "GONS 1 4\n"), Contains("GONS"));
    CHECK_THAT(refusal("POINTS 1 text\n0 0 0\n"), Contains("the type is \"text\""));
    CHECK_THAT(refusal(points, "# vtk DataFile Version 5.1\nt\nBINARIES\n"), Contains("ASCII or BINARY"));
    CHECK_THAT(refusal("POINTS 3 float\n0123456789", "# vtk DataFile Version 3.0\nt\nBINARY\n"), Contains("POINTS"));
}
