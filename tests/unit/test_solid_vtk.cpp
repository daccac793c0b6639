// Meshes of deformable bodies from VTK's files.
#include <catch2/catch.hpp>

#include "specimens/solid_import.hpp"
#include "tests/solid_shells.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

const std::string vtk = R"(# vtk DataFile Version 3.0
a cube and a tetrahedron on it
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 9 double
0 0 0 1 0 0 1 1 0 0 1 0
0 0 1 1 0 1 1 1 1 0 1 1
0 0 2
CELLS 3 17
8 0 1 2 3 4 5 6 7
4 4 5 7 8
2 0 1
CELL_TYPES 3
12
10
3
CELL_DATA 3
SCALARS material int 1
LOOKUP_TABLE default
1 2 3
)";

const std::string vtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData Scalars="s"><DataArray type="Float64" Name="s" format="ascii">1 2 3 4</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
)";

} // namespace

TEST_CASE("VTK's unstructured grids, legacy and XML") {
    const TemporaryFolder folder;
    const auto in = import_solid(folder.file("a.vtk", vtk));
    CHECK(in.mesh.hexahedra.size() == 1);
    CHECK(in.mesh.tetrahedra.size() == 1);
    CHECK(volume_of(in.mesh) == Approx(1.0 + 1.0 / 6.0));
    CHECK(in.mesh.groups.empty());
    const auto xml = import_solid(folder.file("a.vtu", vtu), 2.0);
    CHECK(volume_of(xml.mesh) == Approx(8.0 / 6.0));
    CHECK(xml.notes.empty());
    const auto sheet_only = import_solid(folder.file(
        "s.vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0 1 1 0 0 1 0 7 7 7\n"
                 "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n"));
    CHECK(sheet_only.mesh.membranes.size() == 2);
    CHECK(shell_of(sheet_only.mesh).area == Approx(1.0));
    CHECK(any_has(sheet_only.notes, "1 nodes of no element"));
    const std::string offsets =
        replaced(vtk, "CELLS 3 17\n8 0 1 2 3 4 5 6 7\n4 4 5 7 8\n2 0 1\n",
                 "CELLS 4 14\nOFFSETS vtktypeint64\n0 8 12 14\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7 4 5 7 8 0 1\n");
    const auto newer = import_solid(folder.file("n.vtk", replaced(offsets, "Version 3.0", "Version 5.1")));
    CHECK(newer.mesh.hexahedra == in.mesh.hexahedra);
    CHECK(newer.mesh.tetrahedra == in.mesh.tetrahedra);
}

TEST_CASE("bad VTK files are refused with the reason") {
    const TemporaryFolder folder;
    const auto legacy = [&](const std::string& text) { return message(folder.file("bad.vtk", text)); };
    const auto xml = [&](const std::string& text) { return message(folder.file("bad.vtu", text)); };
    says(legacy("this is nothing\n"), "cannot be read");
    says(legacy(replaced(vtk, "UNSTRUCTURED_GRID", "POLYDATA")), "UNSTRUCTURED_GRID is expected in the fourth line and \"POLYDATA\"");
    says(legacy(replaced(vtk, "POINTS 9", "POINTS 9000000000000")), "\"9000000000000\" are announced");
    says(legacy(replaced(vtk, "0 0 2\n", "0 zero 2\n")), "POINTS: 27 numbers are expected and number 26 is \"zero\"");
    says(legacy(replaced(vtk, "8 0 1 2 3", "9 0 1 2 3")), "CELLS");
    says(legacy(replaced(vtk, "8 0 1 2 3", "8000 0 1 2 3")), "cell 1 has more points");
    says(legacy(replaced(vtk, "8 0 1 2 3", "8 0 1 2 33")), "cell 1 has point 33");
    says(legacy(replaced(vtk, "8 0 1 2 3", "8 0 1 2 -3")), "cell 1 has point -3");
    says(legacy(replaced(vtk, "CELLS 3 17", "CELLS 3 16")), "CELLS");
    says(legacy(replaced(vtk, "12\n10\n", "25\n10\n")), "vtkQuadraticHexahedron");
    says(legacy(replaced(vtk, "12\n10\n", "12\n42\n")), "vtkPolyhedron");
    says(legacy(replaced(vtk, "12\n10\n", "12\n250\n")), "cell 2 is of type 250");
    says(legacy(replaced(vtk, "12\n10\n", "12\n12\n")), "cell 2 has 4 points where 8");
    says(legacy(vtk.substr(0, vtk.find("CELL_TYPES"))), "3 cells and 0 types");
    says(legacy(vtk.substr(0, vtk.find("CELLS"))), "holds no tetrahedra");
    says(legacy(replaced(vtk, "CELL_TYPES 3\n12\n", "CELL_TYPES 2\n")), "3 cells and 2 types");
    says(legacy(replaced(vtk, "CELL_TYPES 3", "CELL_TYPES 2")), "a section, such as POINTS or CELLS, is expected and \"3\"");
    says(legacy(replaced(vtk, "0 0 2\n", "0 0 1\n")), "no volume");
    says(legacy(replaced(vtk, "Version 3.0", "Version= 3.0")), "Version is expected");
    says(legacy(replaced(vtk, "Version 3.0", "Version 30.0")), "\"30.0\"");
    says(legacy(replaced(vtk, "POINTS 9", "POINTS 18446744073709551615")), "18446744073709551615");
    CHECK(legacy(replaced(vtk, "SCALARS material", "SCALARS cells")).empty());
    says(legacy(replaced(vtk, "CELLS 3", "CELLS-3 1")), "\"CELLS-3\"");
    says(legacy(replaced(vtk, "CELL_DATA", "CELLS 1 5\n4 0 1 2 3\nCELL_DATA")), "a second section CELLS");

    says(xml("<VTKFile"), "cannot be read");
    says(xml(vtu.substr(0, vtu.size() / 2)), "cannot be read");
    says(xml(replaced(vtu, "NumberOfPoints=\"4\"", "NumberOfPoints=\"40000000000000\"")), "40000000000000");
    says(xml(replaced(vtu, "NumberOfCells=\"1\"", "NumberOfCells=\"-1\"")), "-1");
    says(xml(replaced(vtu, ">0 1 2 3<", ">0 1 2 9<")), "cell 1 has point 9");
    says(xml(replaced(vtu, ">4<", ">400<")), "bad.vtu");
    says(xml(replaced(vtu, ">10<", ">24<")), "vtkQuadraticTetra");
    says(xml(replaced(vtu, ">0 0 0 1 0 0 0 1 0 0 0 1<", ">0 0 0 1 0 0 0 1 0 0 0<")), "cannot be read");
    says(xml(replaced(vtu, "0 0 0 1<", "0 0 0 nan<")), "bad.vtu");
    says(xml(replaced(vtu, ">4<", ">300000000 4<")), "last offset is 300000000");
    says(xml(replaced(vtu, ">4<", ">300000000x 4<")), "last offset is 300000000");
    says(xml(vtk), "cannot be read");
    says(legacy(vtu), "cannot be read");

    // What VTK's readers would see in another way than the look before them.
    CHECK(xml(replaced(vtu, "<PointData", "<!-- <DataArray format=\"x\" > --><PointData")).empty());
    says(xml(replaced(vtu, "<VTKFile", "<!DOCTYPE VTKFile><VTKFile")), "cannot be read (it has a document type");
    says(xml(replaced(vtu, "<Points>", "<![CDATA[ <AppendedData> ]]><Points>")), "CDATA");
    const std::string encoded = replaced(vtu, "Name=\"offsets\"", "Name=\"&#111;ffsets\"");
    CHECK(xml(encoded).empty());
    says(xml(replaced(encoded, ">4<", ">400000000<")), "last offset is 400000000");
    says(xml(replaced(vtu, "Name=\"offsets\" format=\"ascii\"", "Name=\"offsets\" format=\"&#97;scii\"")), "format is");
    CHECK(xml(replaced(vtu, "Name=\"s\"", "Name=\"s &gt; 0 &#181;m &amp; > 1\"")).empty());
    CHECK(xml(replaced(vtu, ">4<", " A=\"9\">4<")).empty());
    says(xml(replaced(vtu, ">4<", " A=\"> 999999999 <\">4<")), "bad.vtu"); // which VTK's reader takes for what it holds
    says(xml(replaced(vtu, "Name=\"offsets\" format=\"ascii\"", "Name=\"offsets\" offset=\"0\" format=\"ascii\"")),
         "an array with an offset");
    says(xml(replaced(vtu, "Name=\"offsets\" format=\"ascii\"", "Name=\"offsets\" format=\"Binary\"")), "\"Binary\"");
    const std::string appended = replaced(vtu, "format=\"ascii\">4<", "format=\"appended\" offset=\"0\"><");
    says(xml(appended), "an array with an offset");
    const auto with = [&](const std::string& data) { return xml(replaced(appended, "</VTKFile>", data + "</VTKFile>")); };
    CHECK(with("<AppendedData encoding=\"base64\"> _CAAAAAQAAAAAAAAA</AppendedData>").empty()); // 8 bytes, and 4 in them
    says(with("<AppendedData encoding=\"base64\">CAAAAAQAAAAAAAAA</AppendedData>"), "begin with an underscore");
    says(with("<AppendedDatas/><AppendedData encoding=\"base64\">_CAAAAAQAAAAAAAAA</AppendedData>"), "an array with an offset");
    says(with("<AppendedData encoding=\"base38\">_CAAAAAQAAAAAAAAA</AppendedData>"), "to be raw or base64");
    says(with("<AppendedData encoding=\"base64\">_CAAAAAQAAAD///8A</AppendedData>"), "last offset is");
}
