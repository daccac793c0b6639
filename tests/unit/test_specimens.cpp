#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "specimens/grading.hpp"
#include "specimens/hdf5_file.hpp"
#include "specimens/import.hpp"
#include "specimens/lattice.hpp"
#include "specimens/packing.hpp"
#include "specimens/statistics.hpp"
#include "specimens/storage.hpp"
#include "tests/support.hpp"

using namespace proveta;
using proveta::testing::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

SpecimenRecipe small_recipe() {
    SpecimenRecipe r;
    r.diameter = 0.05;
    r.height = 0.1;
    r.spheres = 600;
    return r;
}

} // namespace

TEST_CASE("normal radii have the asked moments and bounds") {
    const auto r = normal_radii(20000, 0.258, 0.4, 1.6, 7);
    const double mean = std::accumulate(r.begin(), r.end(), 0.0) / 20000.0;
    double variance = 0.0;
    for (const double x : r) {
        variance += (x - mean) * (x - mean) / 20000.0;
        CHECK((x >= 0.4 && x <= 1.6));
    }
    CHECK(mean == Approx(1.0).epsilon(1e-4));
    CHECK(std::sqrt(variance) == Approx(0.258).epsilon(1e-3));
    CHECK_THROWS_AS(normal_radii(10, 0.5, 0.9, 1.1, 0), std::invalid_argument);
    CHECK(normal_radii(5, 0.0, 0.4, 1.6, 0) == std::vector<double>(5, 1.0));
}

TEST_CASE("graded radii follow the sieve curve by mass") {
    const std::vector<SievePoint> curve{{0.004, 0.0}, {0.008, 0.4}, {0.016, 1.0}};
    const auto r = graded_radii(50000, curve, 1);
    double total = 0.0;
    double fine = 0.0;
    for (const double x : r) {
        total += x * x * x;
        fine += x < 0.004 ? x * x * x : 0.0;
    }
    CHECK(fine / total == Approx(0.4).epsilon(0.01));
}

TEST_CASE("a sieve curve may be a table, as laboratories write it") {
    const TemporaryFolder folder;
    const std::string where = std::filesystem::path(folder.file("s.csv")).parent_path().string();
    const auto read = [&](const std::string& table, input::Problems& problems) {
        (void)folder.file("s.csv", table);
        input::Json json = input::Json::parse(R"({"specimen": {"particles": [{"grading": "s.csv"}]}})");
        read_grading_files(json, where, "deck.json", "", problems);
        return json["specimen"]["particles"][0]["grading"];
    };
    input::Problems none;
    const auto ballast = read("Sieve (mm);Passing (%)\n63;100\n50;100\n40;72,5\n22,4;0\n16;0\n", none);
    CHECK(none.empty());
    REQUIRE(ballast.size() == 3);
    CHECK(ballast[0]["diameter"].get<double>() == Approx(0.0224));
    CHECK(ballast[0]["passing"] == 0.0);
    CHECK(ballast[1]["passing"].get<double>() == Approx(0.725));
    CHECK(ballast[2]["diameter"].get<double>() == Approx(0.050));
    CHECK(read("d_mm,finer\n2,0\n4,0.5\n8,1\n", none)[1]["passing"] == 0.5);
    CHECK(none.empty());
    const auto refusal = [&](const std::string& table) {
        input::Problems problems;
        (void)read(table, problems);
        REQUIRE(problems.size() == 1);
        CHECK(problems[0].path == "/specimen/particles/0/grading");
        return problems[0].suggestion;
    };
    CHECK_THAT(refusal("size,passing\n2,0\n4,1\n"), Catch::Contains("the sieve sizes have no unit"));
    CHECK_THAT(refusal("size_mm,retained\n2,0\n4,1\n"), Catch::Contains("no column of share passing"));
    CHECK_THAT(refusal("size_mm,passing\n2,0\n4,85\n"), Catch::Contains("neither 1 nor 100 per cent"));
    CHECK_THAT(refusal("size_mm,passing\n2,0\n4,\n8,1\n"), Catch::Contains("line 3: the share passing is missing"));
}

TEST_CASE("a packing is inside, dense as asked, and the same for every number of threads") {
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Specimen one = make_specimen(small_recipe());
    omp_set_num_threads(3);
    const Specimen three = make_specimen(small_recipe());
    omp_set_num_threads(threads);
    CHECK(one.spheres.centre.x == three.spheres.centre.x);
    CHECK(one.spheres.centre.z == three.spheres.centre.z);
    CHECK(one.spheres.radius == three.spheres.radius);
    const auto st = statistics(one);
    CHECK(st.outside == 0);
    CHECK(st.porosity == Approx(0.257).epsilon(1e-9));
    CHECK(st.largest_overlap < 0.4);
    auto other = small_recipe();
    other.seed = 2;
    CHECK(make_specimen(other).spheres.centre.x != one.spheres.centre.x);
}

TEST_CASE("specimens survive storage, and what is not one is refused") {
    const TemporaryFolder folder;
    const Specimen s = make_specimen(small_recipe());
    save_specimen(s, folder.file("s.h5"));
    const Specimen back = load_specimen(folder.file("s.h5"));
    CHECK(back.spheres.centre.y == s.spheres.centre.y);
    CHECK(back.spheres.radius == s.spheres.radius);
    CHECK(back.group == s.group);
    CHECK(back.shape.height == s.shape.height);
    CHECK(back.recipe["spheres"] == 600);
    CHECK_THROWS(load_specimen(folder.file("none.h5")));
    CHECK_THROWS(load_specimen(folder.file("text.h5", "not HDF5")));
    {
        Hdf5File h(folder.file("other.h5"), Hdf5File::Mode::create);
        h.put("x", 1.0);
    }
    CHECK_THROWS(load_specimen(folder.file("other.h5")));
    fs::resize_file(folder.file("s.h5"), fs::file_size(folder.file("s.h5")) / 2);
    CHECK_THROWS(load_specimen(folder.file("s.h5")));
}

TEST_CASE("a plate is flat, stored as a plate, and a lattice is regular") {
    const TemporaryFolder folder;
    SpecimenRecipe r;
    r.shape = "plate";
    r.width = 0.05;
    r.height = 0.1;
    r.spheres = 200;
    const Specimen s = make_specimen(r);
    CHECK(s.spheres.centre.y == std::vector<double>(200, 0.0));
    CHECK(statistics(s).porosity == Approx(0.10));
    CHECK(statistics(s).fabric_deviator < 0.1);
    save_specimen(s, folder.file("plate.h5"));
    CHECK(load_specimen(folder.file("plate.h5")).shape.planar());
    CHECK(s.shape.section() == 0.05);
    CHECK(s.shape.inner(0.5, 0.5).volume() == Approx(0.25 * 0.005));
    const Specimen hexagonal = hexagonal_lattice(4, 3, 0.5);
    CHECK(hexagonal.size() == 11);
    CHECK(statistics(hexagonal).outside == 0);
    CHECK(statistics(square_lattice(13, 25, 0.002)).porosity == Approx(1.0 - 0.25 * 3.14159265358979));
}

TEST_CASE("sphere meshes of other programs are read, with any axis") {
    const TemporaryFolder folder;
    const auto csv = folder.file("a.csv", "x,y,z,r\n0,0,0,0.5\n# a comment\n0,2,0,0.5\n0,1,0,0.4\n");
    const Specimen a = import_specimen(csv, {.axis = 'y'}).specimen;
    CHECK(a.size() == 3);
    CHECK(a.shape.height == Approx(3.0));
    CHECK(a.spheres.centre.z[0] == Approx(0.5));
    CHECK(a.spheres.centre.z[1] == Approx(2.5));

    const auto mdpa = folder.file("b.mdpa", "Begin Nodes\n 7 0 0 0\n 3 0 0 2\nEnd Nodes\nBegin Elements X// c\n1 0 7\nEnd Elements\n"
                                            "Begin NodalData RADIUS // c\n 7 0 0.5\n 3 0 0.25\nEnd NodalData\n"
                                            "Begin NodalData COHESIVE_GROUP\n 7 0 1\n 3 0 2\nEnd NodalData\n");
    const Specimen b = import_specimen(mdpa, {}).specimen;
    REQUIRE(b.size() == 2);
    CHECK(b.group == std::vector<int>{2, 1});
    CHECK(b.spheres.radius[0] == 0.25);

    const auto msh = folder.file("c.msh", "MESH dimension 3 ElemType Sphere Nnode 1\nCoordinates\n1 0 0 0\n2 0 0 1\nEnd Coordinates\n"
                                          "Elements\n1 1 0.5\n2 2 0.5\nEnd Elements\n");
    CHECK(import_specimen(msh, {}).specimen.shape.height == Approx(2.0));
}

TEST_CASE("the faces of an imported mesh are where its skin lies, not where one sphere stands out") {
    const TemporaryFolder folder;
    // A cylinder of 60 mm between faces 40 mm apart, its spheres moved by up to a tenth of a radius and one standing out by half of one.
    SpecimenRecipe recipe;
    recipe.shape = "cylinder";
    recipe.diameter = 0.06;
    recipe.height = 0.04;
    recipe.spheres = 1500;
    const Specimen smooth = make_specimen(recipe);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(-0.1, 0.1);
    std::string table = "x,y,z,r\n";
    std::size_t lowest = 0;
    for (std::size_t k = 0; k < smooth.size(); ++k) {
        const auto& c = smooth.spheres.centre;
        lowest = c.z[k] - smooth.spheres.radius[k] < c.z[lowest] - smooth.spheres.radius[lowest] ? k : lowest;
    }
    for (std::size_t k = 0; k < smooth.size(); ++k) {
        const Vec3 p = smooth.spheres.centre.at(k);
        const double r = smooth.spheres.radius[k];
        const double out = k == lowest ? -0.5 * r : 0.0;
        table += fmt::format("{},{},{},{}\n", p.x() + part(random) * r, p.y() + part(random) * r, p.z() + part(random) * r + out, r);
    }
    const double grain = statistics(smooth).mean_radius;
    const Imported fitted = import_specimen(folder.file("relaxed.csv", table), {});
    CHECK(std::fabs(fitted.specimen.shape.height - 0.04) < 0.1 * grain);
    CHECK(std::fabs(fitted.specimen.shape.diameter - 0.06) < 0.1 * grain);
    CHECK(fitted.warnings.empty());
    const Imported said = import_specimen(folder.file("relaxed.csv", table), {.height = 0.042});
    REQUIRE(said.warnings.size() == 1);
    CHECK(said.warnings[0].find("height of 42 mm where the spheres take") != std::string::npos);

    // What was cut out of a larger mesh has no face: it ends at its farthest sphere.
    std::string cut = "x,y,z,r\n";
    double low = 1.0;
    double high = 0.0;
    for (std::size_t k = 0; k < smooth.size(); ++k) {
        const Vec3 p = smooth.spheres.centre.at(k);
        const double r = smooth.spheres.radius[k];
        if (std::hypot(p.x(), p.y()) < 0.02 && std::fabs(p.z() - 0.02) < 0.01) {
            cut += fmt::format("{},{},{},{}\n", p.x(), p.y(), p.z(), r);
            low = std::min(low, p.z() - r);
            high = std::max(high, p.z() + r);
        }
    }
    CHECK(import_specimen(folder.file("cut.csv", cut), {}).specimen.shape.height == Approx(high - low));
}

TEST_CASE("broken sphere meshes are refused with file and line") {
    const TemporaryFolder folder;
    const auto message = [&](const char* name, const char* text) {
        try {
            import_specimen(folder.file(name, text), {});
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    CHECK(message("a.csv", "0,0,0,0.5\n0,0,2,-1\n").find("a.csv: line 2: radius -1 is not positive") != std::string::npos);
    CHECK(message("b.csv", "0,0,0,0.5\n0,0,nan,1\n").find("b.csv: line 2: a place or a size is missing") != std::string::npos);
    const auto bad = message("m.csv", "x,y,z,r\n0,0,0,0.5\n1,0,0,-1\n0,,1,0.5\n0,1,0,0\n1,1,1,x\n0,0,1,0.5\n2,1,1,0.5\n3,1,1,0.5\n");
    for (const char* part : {"line 6: \"x\" is no number", "line 3: radius -1 is not positive", "line 4: a place or a size is missing",
                             "line 5: radius 0 is not positive"}) {
        CHECK(bad.find(part) != std::string::npos);
    }
    CHECK(message("p.csv", "1 0.1 0.2 0.3 0.05\n2 0.2 0.3 0.1 0.05\n3 0.5 0.1 0.2 0.05\n").find("the first column counts the rows") !=
          std::string::npos);
    CHECK(message("c.csv", "0,0,0,0.5\n0,0,1\n").find("c.csv: line 2: 3 cells where the other rows have 4") != std::string::npos);
    CHECK(message("d.csv", "0,0,0,0.5\n").find("at least 2") != std::string::npos);
    CHECK(message("e.stl", "solid\n").find("unknown ending") != std::string::npos);
    CHECK(message("f.mdpa", "Begin Nodes\n1 0 0 0\n2 0 0 1\nEnd Nodes\n").find("2 of 2 nodes have no radius: 1, 2") != std::string::npos);
}

TEST_CASE("packing: spheres know their place in the list of radii, and relaxing ends with overlaps that are small enough") {
    Shape box;
    box.kind = ShapeKind::prism;
    box.width = box.depth = box.height = 0.1;
    std::vector<double> radii;
    for (int k = 0; k < 300; ++k) {
        radii.push_back(0.006 + 1e-5 * k); // no two alike; they fill half of the box
    }
    Relaxation report;
    const Packing packing = pack(box, radii, 1, 1e-6, report, {}, 0.02);
    REQUIRE(report.number.size() == radii.size());
    bool sorted = true;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        CHECK(packing.radius[k] == radii[report.number[k]]);
        sorted = sorted && report.number[k] == k;
    }
    CHECK_FALSE(sorted);
    double deepest = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        for (std::size_t j = i + 1; j < radii.size(); ++j) {
            const double overlap = packing.radius[i] + packing.radius[j] - (packing.centre.at(i) - packing.centre.at(j)).norm();
            deepest = std::max(deepest, overlap / std::min(packing.radius[i], packing.radius[j]));
        }
    }
    CHECK(report.largest_overlap <= 0.02);
    CHECK(deepest == Approx(report.largest_overlap).margin(1e-12));
}
