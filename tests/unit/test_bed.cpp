#include <catch2/catch.hpp>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "specimens/bed.hpp"
#include "specimens/hdf5_file.hpp"
#include "specimens/import.hpp"
#include "specimens/statistics.hpp"
#include "specimens/storage.hpp"
#include "tests/support.hpp"

using namespace proveta;
using proveta::testing::TemporaryFolder;

namespace {

// A cylinder four to five stones wide.
SpecimenRecipe small_bed(double friction = 0.1) {
    SpecimenRecipe r = granular_recipe();
    r.diameter = 0.1;
    r.height = 0.1;
    r.particles.size = {0.022, ""};
    r.particles.deviation = 0.15;
    r.particles.spheres = 6;
    r.particles.forms = 3;
    r.particles.filling_friction = friction;
    return r;
}

const Specimen& dense_bed() {
    static const Specimen bed = make_specimen(small_bed());
    return bed;
}

bool equal(const Specimen& a, const Specimen& b) {
    return a.shape.height == b.shape.height &&
           std::equal(a.stones.begin(), a.stones.end(), b.stones.begin(), b.stones.end(), [](auto& p, auto& q) {
               return p.form == q.form && p.size == q.size && p.position == q.position && p.attitude.coeffs() == q.attitude.coeffs();
           });
}

// Paths of what a recipe's check complains about.
std::vector<std::string> complaints(const std::string& recipe) {
    SpecimenRecipe r = granular_recipe();
    input::Problems problems;
    input::read(input::Json::parse(recipe), r, "deck", "/specimen", problems);
    check_recipe(r, "deck", "/specimen", problems);
    std::vector<std::string> out;
    for (const auto& p : problems) {
        CHECK(!p.expected.empty());
        out.push_back(p.path);
    }
    return out;
}

} // namespace

TEST_CASE("grains are let down without touching each other or the cylinder") {
    FillingPlan plan;
    plan.diameter = 0.1;
    plan.height = 0.1;
    for (int k = 0; k < 200; ++k) {
        plan.grains.push_back({0.01 + 0.0001 * k, -1});
    }
    const auto centres = let_down(plan, 3);
    double top = 0.0;
    for (std::size_t i = 0; i < centres.size(); ++i) {
        const double r = 0.5 * plan.grains[i].size;
        CHECK(std::hypot(centres[i].x(), centres[i].y()) + r <= 0.05 * (1.0 + 1e-12));
        CHECK(centres[i].z() >= r);
        top = std::max(top, centres[i].z());
        for (std::size_t j = 0; j < i; ++j) {
            CHECK((centres[i] - centres[j]).norm() >= (r + 0.5 * plan.grains[j].size) * (1.0 - 1e-12));
        }
    }
    CHECK(top < 0.36); // fills three tenths of the space
    plan.grains.push_back({0.11, -1});
    CHECK_THROWS_AS(let_down(plan, 3), std::invalid_argument);
}

TEST_CASE("a bed of stones is inside its cylinder, dense and at rest under its pressure") {
    const Specimen& s = dense_bed();
    REQUIRE(s.spheres.radius.empty());
    CHECK(s.size() == s.stones.size());
    CHECK(s.forms.size() == 3);
    CHECK(s.shape.diameter == 0.1);
    CHECK(s.shape.height == Approx(0.1).epsilon(0.08)); // levelled by whole stones of a fifth of the height
    const auto st = statistics(s);
    CHECK(st.stones == s.size());
    CHECK(st.spheres == 6 * s.size());
    CHECK(st.mean_radius == Approx(0.011).epsilon(0.03));
    // In a cylinder five stones wide the sides loosen the bed.
    CHECK(st.porosity > 0.32);
    CHECK(st.porosity < 0.50);
    CHECK(st.touching > 3.5);
    CHECK(st.largest_overlap < 0.05);
    CHECK(st.on_lower_end > 0);
    CHECK(st.on_upper_end > 0);
    const SpheresInSpace all = spheres_in_space(s);
    for (std::size_t k = 0; k < all.spheres.radius.size(); ++k) {
        CHECK(s.shape.depth_below_surface(all.spheres.centre.at(k)) > 0.95 * all.spheres.radius[k]);
    }
    CHECK(s.recipe["filling"]["pressure"].get<double>() == Approx(10e3).epsilon(0.006));
    CHECK(s.recipe["filling"]["rms_speed"].get<double>() < 1e-3);
}

TEST_CASE("the same recipe gives the same bed for every number of threads, another seed another one") {
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Specimen one = make_specimen(small_bed());
    omp_set_num_threads(2);
    const Specimen two = make_specimen(small_bed());
    omp_set_num_threads(threads);
    CHECK(equal(one, two));
    auto other = small_bed();
    other.seed = 2;
    CHECK(!equal(make_specimen(other), one));
}

TEST_CASE("friction while filling makes a bed looser") {
    CHECK(statistics(make_specimen(small_bed(0.8))).porosity > statistics(dense_bed()).porosity + 0.03);
}

TEST_CASE("a bed of a given number of spheres has them all") {
    auto r = small_bed();
    r.particles.form = "sphere";
    r.particles.count = {80, ""};
    const Specimen s = make_specimen(r);
    CHECK(s.stones.empty());
    CHECK(s.size() == 80);
    CHECK(s.group.size() == 80);
    const auto st = statistics(s);
    CHECK(st.largest_overlap < 0.03);
    CHECK(st.porosity > 0.35);
    CHECK(st.porosity < 0.50);
    for (std::size_t k = 0; k < s.size(); ++k) {
        CHECK(s.shape.depth_below_surface(s.spheres.centre.at(k)) > 0.97 * s.spheres.radius[k]);
    }
}

TEST_CASE("stones survive storage, and malformed ones are refused") {
    const TemporaryFolder folder;
    const Specimen& s = dense_bed();
    save_specimen(s, folder.file("s.h5"));
    const Specimen back = load_specimen(folder.file("s.h5"));
    CHECK(equal(back, s));
    REQUIRE(back.forms.size() == s.forms.size());
    CHECK(back.forms[1].centre == s.forms[1].centre);
    CHECK(back.forms[1].radius == s.forms[1].radius);
    CHECK(back.forms[1].inertia == s.forms[1].inertia);
    CHECK(back.recipe["particles"]["forms"] == 3);
    CHECK(statistics(back).porosity == statistics(s).porosity);
    export_csv(back, folder.file("s.csv"));

    SpecimenRecipe bonded;
    bonded.file = folder.file("s.h5");
    CHECK_THROWS_AS(obtain_specimen(bonded, ".", "deck"), input::InputError);
    bonded.matter = "granular";
    CHECK(equal(obtain_specimen(bonded, ".", "deck"), s));
}

TEST_CASE("files with malformed stones are refused") {
    const TemporaryFolder folder;
    using Doubles = std::vector<double>;
    // One stone of one form of two spheres, with one array changed.
    const auto loads = [&](const std::string& changed, const Doubles& values) {
        {
            Hdf5File h(folder.file("s.h5"), Hdf5File::Mode::create);
            h.put_text("format", "proveta specimen 1");
            h.put_text("recipe", "{}");
            for (const auto* name : {"x", "y", "z", "radius"}) {
                h.put(name, Doubles{});
            }
            h.put("group", std::vector<std::int32_t>{});
            std::map<std::string, Doubles> arrays{{"shape", {0.0, 0.1, 0.0, 0.0, 0.1}},
                                                  {"form_centre", {-0.1, 0.0, 0.0, 0.1, 0.0, 0.0}},
                                                  {"form_radius", {0.4, 0.4}},
                                                  {"form_volume", {0.5}},
                                                  {"form_inertia", {0.05, 0.05, 0.05}},
                                                  {"stone_size", {0.02}},
                                                  {"stone_position", {0.0, 0.0, 0.05}},
                                                  {"stone_attitude", {1.0, 0.0, 0.0, 0.0}},
                                                  {"stone_form", {0.0}},
                                                  {"form_spheres", {2.0}}};
            arrays[changed] = values;
            for (const auto& [name, array] : arrays) {
                if (name == "stone_form" || name == "form_spheres") {
                    h.put(name, std::vector<std::int32_t>(array.begin(), array.end()));
                } else if (!name.empty()) {
                    h.put(name, array);
                }
            }
            h.close();
        }
        try {
            return load_specimen(folder.file("s.h5")).size() == 1;
        } catch (const std::runtime_error&) {
            return false;
        }
    };
    CHECK(loads("", {}));
    CHECK(!loads("form_centre", {0.0, 0.0, 0.0}));
    CHECK(!loads("form_radius", {0.4, -0.4}));
    CHECK(!loads("form_volume", {0.0}));
    CHECK(!loads("form_inertia", {0.05, 0.05, 0.0}));
    CHECK(!loads("form_spheres", {0.0}));
    CHECK(!loads("form_spheres", {1.0}));
    CHECK(!loads("stone_form", {1.0}));
    CHECK(!loads("stone_form", {-1.0}));
    CHECK(!loads("stone_form", {}));
    CHECK(!loads("stone_size", {-0.02}));
    CHECK(!loads("stone_position", {0.0, std::nan(""), 0.05}));
    CHECK(!loads("stone_attitude", {1.0, 0.1, 0.0, 0.0}));
    CHECK(!loads("shape", {0.0, 0.1, 0.0, 0.0, -0.1}));
}

TEST_CASE("granular recipes show their own keys, and say what is wrong with them") {
    using Paths = std::vector<std::string>;
    CHECK(complaints("{}").empty());
    CHECK(complaints(R"({"diameter": "300 mm", "height": "600 mm", "particles": {"form": "sphere"}})").empty());
    CHECK(complaints(R"({"spheres": 1000})") == Paths{"/specimen/spheres"});
    CHECK(complaints(R"({"diameter": "80 mm"})") == Paths{"/specimen/particles/grading/5/diameter"});
    CHECK(complaints(R"({"particles": {"size": "110 mm"}})") == Paths{"/specimen/particles/size"});
    CHECK(complaints(R"({"particles": {"grading": []}})") == Paths{"/specimen/particles/grading"});
    CHECK(complaints(R"({"particles": {"grading": [{"diameter": "20 mm", "passing": 0.1}, {"diameter": "30 mm", "passing": 1}]}})") ==
          Paths{"/specimen/particles/grading/0"});
    CHECK(complaints(R"({"particles": {"size": "20 mm", "deviation": 0.9}})") == Paths{"/specimen/particles/deviation"});
    CHECK(complaints(R"({"particles": {"count": 5000}})") == Paths{"/specimen/particles/count"});
    CHECK(complaints(R"({"particles": {"count": 10.5}})") == Paths{"/specimen/particles/count"});
    CHECK(complaints(R"({"particles": {"size": "0.5 mm"}})") == Paths{"/specimen/particles/size"});
    CHECK(complaints(R"({"particles": {"seating_pressure": "10 MPa"}})") == Paths{"/specimen/particles/seating_pressure"});
    const input::Json shown = input::write(granular_recipe());
    CHECK(shown.size() == 5);
    CHECK(shown["particles"]["grading"].size() == 6);
    CHECK(!input::write(SpecimenRecipe{}).contains("particles"));
}
