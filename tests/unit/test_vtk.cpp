#include <catch2/catch.hpp>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>

#include "lab/fields.hpp"
#include "lab/fragments.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

TEST_CASE("field files are read back by VTK with their arrays") {
    const Deck deck = small_deck(300);
    Bench bench = set_up(deck, make_specimen(deck.specimen));
    for (int k = 0; k < 200; ++k) {
        bench.model->step({0.05, -0.05}, k == 199);
    }
    const auto file = (std::filesystem::temp_directory_path() / ("proveta_vtk_" + std::to_string(::getpid()) + ".vtp")).string();
    const auto read = [&](const report::Geometry& geometry) {
        report::write_vtp(file, geometry);
        vtkNew<vtkXMLPolyDataReader> reader;
        reader->SetFileName(file.c_str());
        reader->Update();
        return vtkSmartPointer<vtkPolyData>(reader->GetOutput());
    };
    const auto spheres = read(sphere_fields(bench));
    REQUIRE(spheres->GetNumberOfPoints() == 300);
    CHECK(spheres->GetNumberOfVerts() == 300);
    for (const char* name : {"radius", "displacement", "velocity", "stress", "damage", "fragment", "group", "material"}) {
        INFO(name);
        CHECK(spheres->GetPointData()->GetArray(name) != nullptr);
    }
    CHECK(spheres->GetPoint(7)[2] == bench.model->spheres.position.z[7]);
    CHECK(spheres->GetPointData()->GetArray("radius")->GetTuple1(7) == Approx(bench.model->spheres.radius[7]).epsilon(1e-6));

    const auto bonds = read(bond_fields(bench));
    CHECK(bonds->GetNumberOfLines() == static_cast<vtkIdType>(bench.model->bonds.size()));
    CHECK(bonds->GetCellData()->GetArray("normal_force")->GetTuple1(11) == Approx(bench.model->bonds.normal[11]).epsilon(1e-6));
    const auto platens = read(platen_fields(bench));
    CHECK(platens->GetNumberOfPolys() == 2);
    std::filesystem::remove(file);
    CHECK(fragments(*bench.model) == std::vector<int>(300, 0));
    CHECK_THROWS(report::write_vtp("/proc/nowhere/x.vtp", platen_fields(bench)));
}
