#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "lab/calibrate/calibrate_report.hpp"
#include "lab/calibrate/plausible.hpp"
#include "lab/calibrate/search.hpp"
#include "lab/trials/csv.hpp"
#include "lab/trials/decks.hpp"
#include "materials/measured.hpp"
#include "tests/support.hpp"

using namespace proveta;
using proveta::testing::TemporaryFolder;

namespace {

const std::string small_ucs =
    R"({"test": "ucs", "specimen": {"spheres": 300}, "material": {"card": "custom", "fracture_energy_tension": 0, "fracture_energy_shear": 0}})";

std::string calibration(const std::string& parameters, const std::string& targets, const std::string& more = "") {
    return R"({"tests": [{"name": "ucs", "deck": )" + small_ucs + R"(}], "parameters": [)" + parameters + R"(], "targets": [)" + targets +
           "]" + more + "}";
}

const std::string tau = R"({"path": "material.tau_f", "low": "10 MPa", "high": "20 MPa"})";
const std::string strength = R"({"test": "ucs", "result": "strength", "value": "30 MPa"})";

input::Problems problems_in(const std::string& file) {
    try {
        make_targets(read_calibration(file));
    } catch (const input::InputError& e) {
        return e.problems;
    }
    return {};
}

// Deviations from targets that depend on the parameters as strengths do on a card's: powers and products, and scatter that no model knows.
SearchPoint pretend(const std::vector<double>& u, double scatter) {
    const std::vector<double> truth{0.3, 0.7, 0.45, 0.6};
    const auto strengths = [](const std::vector<double>& p) {
        return std::vector<double>{std::pow(1 + p[0], 1.5) * (1 + 0.3 * p[2]), std::exp(0.8 * p[1]) + 0.2 * p[0] * p[3],
                                   1.0 / (0.5 + p[2]) + 0.1 * p[1] * p[1], std::sqrt(0.2 + p[3]) * (1.0 + 0.2 * p[0]), 1.0 + p[0] * p[1]};
    };
    const auto here = strengths(u);
    const auto wanted = strengths(truth);
    SearchPoint s{u, {}, true};
    for (std::size_t k = 0; k < here.size(); ++k) {
        // The same point gives the same scatter, as the same specimen and card do.
        const double noise = std::sin(1e4 * (u[0] + 2 * u[1] + 3 * u[2] + 5 * u[3]) + static_cast<double>(k));
        s.deviation.push_back((std::log(here[k] / wanted[k]) + scatter * noise) / 0.05 / std::sqrt(5.0));
    }
    return s;
}

std::vector<SearchPoint> searched(const std::string& method, std::size_t trials, double scatter, std::uint64_t seed) {
    std::vector<SearchPoint> samples;
    while (samples.size() < trials) {
        for (const auto& u : propose(samples, 4, 4, method, seed + samples.size())) {
            samples.push_back(pretend(u, scatter));
        }
    }
    return samples;
}

} // namespace

TEST_CASE("calibration: a search finds what made its targets from any start, and repeats itself") {
    for (const std::uint64_t seed : {1u, 20u, 300u}) {
        const auto samples = searched("mixed", 60, 0.01, seed);
        const SearchPoint& best = samples[best_sample(samples)];
        CHECK(chebyshev(best.u, {0.3, 0.7, 0.45, 0.6}) < 0.08);
        CHECK(best.score() < 0.5); // scatter alone gives 0.14
        const auto again = searched("mixed", 60, 0.01, seed);
        CHECK(again.back().u == samples.back().u);
    }
    CHECK(searched("mixed", 4, 0.01, 1).front().u != searched("mixed", 4, 0.01, 2).front().u);
    // dlib's search of the score alone is left behind by one that knows the single deviations.
    const auto global = searched("global", 60, 0.01, 1);
    const auto mixed = searched("mixed", 60, 0.01, 1);
    CHECK(mixed[best_sample(mixed)].score() < global[best_sample(global)].score());
}

TEST_CASE("calibration: failed trials are no end, and no model is told by them") {
    std::vector<SearchPoint> samples;
    while (samples.size() < 48) {
        for (const auto& u : propose(samples, 4, 4, "mixed", 7 + samples.size())) {
            samples.push_back(pretend(u, 0.0));
            if (u[0] > 0.5) { // half of the cube gives nothing
                samples.back() = {u, std::vector<double>(5, missing_deviation), false};
            }
        }
    }
    const SearchPoint& best = samples[best_sample(samples)];
    CHECK(best.complete);
    CHECK(chebyshev(best.u, {0.3, 0.7, 0.45, 0.6}) < 0.08);
    CHECK(best_sample({{{0.0}, {1.0}, false}}) == 1);
}

TEST_CASE("calibration: errors of a linear problem are those of least squares") {
    Confidence c;
    c.jacobian.resize(3, 2);
    c.jacobian << 2.0, 0.0, 0.0, 4.0, 1.0, 1.0;
    const double sigma = 0.3;
    analyse_errors(c, sigma * sigma * Eigen::Matrix3d::Identity());
    const Eigen::Matrix2d expected = sigma * sigma * (c.jacobian.transpose() * c.jacobian).inverse();
    CHECK(c.standard_error[0] == Approx(std::sqrt(expected(0, 0))));
    CHECK(c.standard_error[1] == Approx(std::sqrt(expected(1, 1))));
    CHECK(c.correlation(0, 1) == Approx(expected(0, 1) / std::sqrt(expected(0, 0) * expected(1, 1))));
    // A parameter that no target sees is as uncertain as its whole range: uniform, 1/sqrt(12).
    c.jacobian.col(1).setZero();
    analyse_errors(c, sigma * sigma * Eigen::Matrix3d::Identity());
    CHECK(c.standard_error[1] == Approx(1.0 / std::sqrt(12.0)));
    CHECK(c.correlation(0, 1) == Approx(0.0).margin(1e-12));
}

TEST_CASE("calibration: multiples keep an order, scales and integers are kept") {
    const TemporaryFolder folder;
    const auto file =
        folder.file("c.json", calibration(R"({"name": "LCS1", "path": "material.lcs.0", "low": "20 MPa", "high": "80 MPa", "scale": "log"},
        {"name": "ratio", "path": "material.lcs.1", "times": "LCS1", "low": 1.5, "high": 2.5},
        {"path": "material.lcs.2", "times": "ratio", "low": 1.5, "high": 2.5},
        {"name": "G", "path": "material.fracture_energy_shear", "times": "LCS1", "power": 2, "low": 1e-13, "high": 3e-13})",
                                          strength));
    const CalibrationPlan plan = read_calibration(file);
    CHECK(plan.space[0].at(0.5) == Approx(40e6));
    CHECK(plan.space[0].position(40e6) == Approx(0.5));
    CHECK(plan.space[2].name == "material.lcs.2");
    CHECK(plan.space[0].unit == "Pa");
    input::Json deck = plan.tests[0].deck;
    plan.space.apply(deck, plan.space.values({0.5, 0.5, 1.0, 0.5}));
    CHECK(deck["material"]["lcs"][1].get<double>() == Approx(80e6));
    CHECK(deck["material"]["lcs"][2].get<double>() == Approx(200e6));
    CHECK(deck["material"]["fracture_energy_shear"].get<double>() == Approx(2e-13 * 40e6 * 40e6));
    CHECK(deck_for(plan.tests[0], 5, 0.5)["specimen"]["spheres"] == 150);
    CHECK(deck_for(plan.tests[0], 5, 0.5)["specimen"]["seed"] == 5);
}

TEST_CASE("calibration: every problem at once, at its place") {
    const TemporaryFolder folder;
    const auto problems = problems_in(folder.file(
        "c.json",
        calibration(R"({"path": "material.tau", "low": 2, "high": 1}, {"path": "material.mu_s", "low": 0, "high": 1, "scale": "log"})",
                    R"({"test": "ucss", "result": "strength", "value": "30 MPa"}, {"test": "ucs"}, {"test": "ucs", "curve": "x.csv"},
                                 {"test": "ucs", "result": "strength", "value": 1, "use": "fitted"})",
                    R"(, "search": {"trials": 0}, "finnish": {})")));
    std::vector<std::string> paths;
    for (const auto& p : problems) {
        paths.push_back(p.path);
    }
    for (const auto* path : {"/parameters/0/path", "/parameters/0", "/parameters/1/low", "/targets/0/test", "/targets/1", "/targets/2/y",
                             "/targets/3/use", "/search/trials", "/finnish"}) {
        INFO(path);
        CHECK(std::find(paths.begin(), paths.end(), path) != paths.end());
    }
    // Bounds that make a deck that cannot be: the second corner of the envelope below the first.
    const auto bounds =
        problems_in(folder.file("b.json", calibration(R"({"path": "material.lcs.0", "low": "20 MPa", "high": "60 MPa"})", strength)));
    REQUIRE(bounds.size() == 1);
    CHECK(bounds[0].path == "/parameters/0/high");
    // What could not be read is said once, not called missing as well; a curve that is not there is told with the rest.
    const auto once = problems_in(folder.file("o.json", calibration(tau, R"({"test": "ucs", "curve": "x.csv", "y": "stress"},
                                                                             {"test": "ucs", "result": "strength", "value": "30 bananas"})")));
    REQUIRE(once.size() == 3);
    CHECK(once[0].path == "/targets/0/y");
    CHECK(once[1].path == "/targets/1/value");
    CHECK(once[2].path == "/targets/0/curve");
    CHECK(problems_in(folder.file("n.json", calibration("", strength))).at(0).path == "/parameters");
    CHECK(problems_in(folder.file("t.json", R"({"tests": [], "parameters": []})")).at(0).path == "/tests");
    CHECK(problems_in(folder.file("m.json", calibration(tau, R"({"test": "ucs", "curve": "none.csv", "y": "total_stress"})"))).at(0).path ==
          "/targets/0/curve");
}

TEST_CASE("calibration: measured curves are put in order, scaled, shifted and freed of their toe") {
    const TemporaryFolder folder;
    // A straight line of 20 GPa that starts after a toe of 0.0005, compression negative, rows from the end; then a fall.
    std::string rows;
    for (int k = 40; k >= 0; --k) {
        const double strain = 5e-5 * k;
        const double stress = strain < 0.0005 ? 0.0 : strain <= 0.0015 ? 20e3 * (strain - 0.0005) : 10.0;
        rows += std::to_string(-100.0 * strain) + " " + std::to_string(-stress) + "\n";
    }
    folder.write("curve.txt", rows);
    const auto load = [&](const std::string& more) {
        const auto file =
            folder.file("c.json", calibration(tau, R"({"test": "ucs", "curve": "curve.txt", "y": "total_stress", "x_factor": -0.01,
            "y_factor": -1e6)" + more + "}"));
        return make_targets(read_calibration(file)).at(0).file.compared;
    };
    const SampledCurve whole = load("");
    CHECK(whole.x.size() == 41);
    CHECK(whole.x.front() == Approx(0.0).margin(1e-12));
    CHECK(whole.y.back() == Approx(10e6));
    const SampledCurve shifted = load(R"(, "x_offset": 0.0005, "from": 0, "to": 0.001)");
    CHECK(shifted.x.front() == Approx(0.0).margin(1e-9));
    CHECK(shifted.y.back() == Approx(20e6));
    const SampledCurve freed = load(R"(, "toe": "removed", "from": 0)");
    CHECK(freed.x.front() == Approx(0.0).margin(6e-5));
    CHECK(freed.x.back() == Approx(0.0015).epsilon(0.02));
}

TEST_CASE("calibration: an experiment's file says whether its stress is total, and an empty slot is no curve") {
    const TemporaryFolder folder;
    const std::string heading = "# source\nconfinement_MPa,axial_strain,lateral_strain,axial_stress_MPa,kind\n";
    const auto filled = folder.file("p.csv", heading + "4.5,0,0,0,deviatoric\n4.5,0.001,-0.0002,20,deviatoric\n4.5,0.002,,30,deviatoric\n");
    const MeasuredCurve curve = load_measured_curve(filled);
    CHECK(curve.confinement == 4.5e6);
    CHECK_FALSE(curve.total);
    CHECK(std::isnan(curve.lateral_strain[2]));
    const auto target = [&](const std::string& more) {
        const auto file = folder.file("c.json", calibration(tau, R"({"test": "ucs", "curve": "p.csv")" + more + "}"));
        return make_targets(read_calibration(file)).at(0).file.compared;
    };
    CHECK(target(R"(, "y": "total_stress")").y.back() == Approx(34.5e6));
    CHECK(target(R"(, "y": "deviatoric_stress")").y.back() == Approx(30e6));
    CHECK_THROWS_AS(target(R"(, "y": "circumferential_strain")"), input::InputError); // two points only
    CHECK(load_measured_curve(folder.file("e.csv", heading)).empty());
    CHECK_THROWS(load_measured_curve(folder.file("k.csv", heading + "4.5,0,0,0,both\n")));
    CHECK_THROWS(load_measured_curve(folder.file("m.csv", heading + "4.5,0,0,0,total\n9,0,0,0,total\n")));
    CHECK_FALSE(is_measured_curve(folder.file("o.csv", "a,b\n1,2\n")));
}

TEST_CASE("calibration: targets and bounds of another size, sign or unit than theirs are refused with what may be meant") {
    const TemporaryFolder folder;
    const auto problem = [&](const std::string& parameter, const std::string& target) {
        try {
            (void)make_targets(read_calibration(folder.file("c.json", calibration(parameter, R"({"test": "ucs", )" + target + "}"))));
        } catch (const input::InputError& error) {
            REQUIRE(error.problems.size() == 1);
            return error.problems.front();
        }
        return input::Problem{};
    };
    const auto target = [&](const std::string& text) { return problem(tau, R"("result": )" + text); };
    CHECK(target(R"("strength", "value": 32.8)").suggestion == "did you mean \"32.8 MPa\"?");
    CHECK(target(R"("young_modulus", "value": 28000)").suggestion == "did you mean \"28 GPa\"?");
    CHECK(target(R"("poisson_ratio", "value": 20)").suggestion == "did you mean 0.2?");
    CHECK(target(R"("strain_at_peak", "value": 0.2)").path == "/targets/0/value");
    CHECK_FALSE(plausible_result({"strain_ratio", "", {}, "", ""}, "hydrostatic")); // near 1: of strains, and none itself
    CHECK(target(R"("post_peak_slope", "value": "9 GPa")").expected.find("negative") != std::string::npos);
    CHECK(target(R"("strength", "value": "30 MPa", "tolerance": 5)").path == "/targets/0/tolerance");
    CHECK(problem(R"({"path": "material.mu_s", "low": "10 deg", "high": 0.9})", R"("result": "strength", "value": "30 MPa")").path ==
          "/parameters/0/low");

    CHECK(target(R"("poisson_ratio", "value": 0.6)").suggestion.empty());
    CHECK(target(R"("young_modulus", "value": "28 MPa")").expected.find("28 GPa") != std::string::npos);
    CHECK(target(R"("strain_at_peak", "value": "3 %")").expected.find("where the test ends") != std::string::npos);
    const auto factor = problems_in(folder.file(
        "f.json", calibration(tau + R"(, {"path": "material.sigma_f", "low": "1 MPa", "high": "3 MPa", "times": "tau_f"})", strength)));
    REQUIRE(factor.size() == 2);
    CHECK(factor[0].path == "/parameters/1/low");
    CHECK(factor[0].expected.find("a factor for material.sigma_f, which has no unit") != std::string::npos);

    folder.write("mille.csv",
                 "0,0\n0.1,2.8\n0.2,5.6\n0.3,8.4\n0.5,14\n1,28\n1.2,29\n1.4,28\n1.5,27\n"); // per mille: a hundredth would do, and be a
                                                                                            // tenth as stiff
    CHECK(problem(tau, R"("curve": "mille.csv", "y": "total_stress", "y_factor": 1e6)").found.find("\"x_factor\": 0.001") !=
          std::string::npos);
    folder.write("spike.csv", "0,0\n0.0001,2.8\n0.0005,14\n0.001,-9999\n0.0012,29\n0.0014,28\n0.0015,27\n");
    CHECK(problem(tau, R"("curve": "spike.csv", "y": "total_stress", "y_factor": 1e6)").found.find("a missing value, or a spike") !=
          std::string::npos);
    folder.write("late.csv", "0.01,0\n0.0101,2.8\n0.0105,14\n0.011,28\n0.0112,29\n0.0114,28\n");
    const auto late =
        folder.file("l.json", calibration(tau, R"({"test": "ucs", "curve": "late.csv", "y": "total_stress", "y_factor": 1e6})"));
    CHECK(make_targets(read_calibration(late)).at(0).file.warnings.at(0).find("the curve begins at") != std::string::npos);

    const auto twice = problems_in(folder.file("2.json", calibration(tau, strength + ", " + strength)));
    REQUIRE(twice.size() == 1);
    CHECK(twice[0].path == "/targets/1/result");
    const auto broken =
        problems_in(folder.file("b.json", R"({"tests": [{"name": "ucs", "deck": {"test": "ucs", "loading": {"rate": "1 m"}}}],
        "parameters": [)" + tau + R"(], "targets": [)" +
                                              strength + R"(, {"test": "usc", "result": "strength", "value": "3 MPa"}]})"));
    REQUIRE(broken.size() == 2); // the test that is there, if wrong, is known by its name
    CHECK(broken[0].path == "/tests/0/deck/loading/rate");
    CHECK(broken[1].path == "/targets/1/test");

    folder.write("swapped.csv", "0,0\n15e6,0.0005\n30e6,0.001\n");
    const auto swapped = problem(tau, R"("curve": "swapped.csv", "y": "total_stress")");
    CHECK(swapped.found.find("is x_column the stress") != std::string::npos);
    folder.write("kilo.csv",
                 "0,0\n0.0001,2.8e3\n0.0002,5.6e3\n0.0003,8.4e3\n0.001,28e3\n0.0011,29e3\n"); // kPa: 28 MPa where the card has 28 GPa
    const auto file = folder.file("c.json", calibration(tau, R"({"test": "ucs", "curve": "kilo.csv", "y": "total_stress"})"));
    CHECK(make_targets(read_calibration(file)).at(0).file.warnings.at(0).find("are the units right") != std::string::npos);
}

TEST_CASE("calibration: a test ends where its targets end") {
    const TemporaryFolder folder;
    folder.write("curve.csv", "0,0\n0.001,20\n0.002,30\n");
    const auto shortened = [&](const std::string& targets, const std::string& deck) {
        const auto file = folder.file("c.json", R"({"tests": [{"name": "t", "deck": )" + deck + R"(}], "parameters": [)" + tau +
                                                    R"(], "targets": [)" + targets + "]}");
        const CalibrationPlan plan = read_calibration(file);
        TrialTest test = plan.tests[0];
        shorten(test, make_targets(plan));
        return test.deck["loading"]["stop"];
    };
    const std::string peak = R"({"test": "t", "result": "strength", "value": "30 MPa"})";
    const std::string curve = R"({"test": "t", "curve": "curve.csv", "y": "total_stress", "y_factor": 1e6})";
    CHECK(shortened(peak, R"({"test": "ucs", "material": {"card": "custom"}})")["post_peak_drop"] == 0.1);
    CHECK(shortened(peak,
                    R"({"test": "ucs", "material": {"card": "custom"}, "loading": {"stop": {"post_peak_drop": 0.4}}})")["post_peak_drop"] ==
          0.4);
    CHECK(shortened(curve, R"({"test": "ucs", "material": {"card": "custom"}})")["axial_strain"].get<double>() == Approx(0.0021));
    CHECK(shortened(peak + ", " + curve, R"({"test": "ucs", "material": {"card": "custom"}})")["axial_strain"].get<double>() ==
          Approx(0.0042)); // peaks come later, too
    CHECK(shortened(R"({"test": "t", "result": "post_peak_slope", "value": -1})",
                    R"({"test": "ucs", "material": {"card": "custom"}})")["post_peak_drop"] == 0.6);
}

TEST_CASE("CSV of others: separators, headings, comments, and what is wrong where") {
    const TemporaryFolder folder;
    const auto table = read_csv(folder.file("a.csv", "# c\nstrain; stress\n0; 1\n\n0.5;+2e1\r\n"));
    CHECK(table.columns[1].name == "stress");
    CHECK(table.rows[1] == std::vector<double>{0.5, 20.0});
    CHECK(read_csv(folder.file("b.csv", "1 2\n3\t4\n5   6\n")).rows.size() == 3);
    CHECK_THROWS_WITH(read_csv(folder.file("d.csv", "1,2\n3\n")), Catch::Contains("line 2"));
    CHECK_THROWS_WITH(read_csv(folder.file("e.csv", "a,b\n1,x\n")), Catch::Contains("\"x\""));
    CHECK_THROWS(read_csv(folder.file("f.csv", "a,b\n")));
    CHECK_THROWS(read_csv("none.csv"));
}

TEST_CASE("ledger: half a line of a killed process is cut off, a second process is refused") {
    const TemporaryFolder folder;
    const std::string line =
        R"({"trial":"aa","values":[1.5],"jobs":[{"job":"ucs","test":"ucs","status":"complete","reason":"","quasi_static":true,)"
        R"("sense":1.0,"seconds":2.0,"results":{"strength":3.0},"units":{"strength":"Pa"},"physics":")" +
        std::string(physics_revision()) + "\"}]}";
    folder.write("ledger.jsonl", line + "\n" + line.substr(0, 40));
    {
        const TrialBook book(folder.path(), BookMode::run, 1, true);
        CHECK(book.known() == 1);
        CHECK(book.of_other_physics().empty());
        CHECK_THROWS_AS(TrialBook(folder.path(), BookMode::run, 1, true), input::InputError);
    }
    const auto trials = TrialBook::read(folder.path());
    REQUIRE(trials.size() == 1);
    CHECK(trials[0].mean("ucs", "strength") == 3.0);
    CHECK_FALSE(trials[0].mean("ucs", "none"));
    CHECK_FALSE(trials[0].mean("bts", "strength"));
    CHECK(std::filesystem::file_size(folder.path() / "ledger.jsonl") == line.size() + 1);
    folder.write("ledger.jsonl", line.substr(0, line.find(",\"physics")) + "}]}\n"); // of a program from before there was a revision
    {
        const TrialBook book(folder.path(), BookMode::run, 1, true);
        CHECK(book.known() == 0);
        CHECK(book.of_other_physics().find("1 trial in the ledger computed by a version without physics revision") == 0);
    }
    folder.write("ledger.jsonl", "{}\n");
    CHECK_THROWS_AS(TrialBook(folder.path(), BookMode::run, 1, true), input::InputError);
}

TEST_CASE("a calibration's page says what keeps its card from being taken at its word") {
    const TemporaryFolder folder;
    const CalibrationPlan plan = read_calibration(folder.file("c.json", calibration(tau, strength)));
    const auto targets = make_targets(plan);
    // A card with tau_f at the place u between its bounds that gives a strength; noise: floor of the score.
    const auto warned = [&](double u, double found, double score, double noise, double error) {
        JobResult job{"ucs_seed_1", "ucs", "complete", "", {{"strength", found}}, true, 1.0, 1.0, {{"strength", "Pa"}}};
        CalibrationOutcome outcome;
        outcome.trials = {{"finish", true, {u}, {"key", plan.space.values({u}), {job}}, {{score}, true}}};
        Confidence sure;
        sure.noise_of_score = noise;
        sure.standard_error = {error};
        sure.correlation = Eigen::MatrixXd::Identity(1, 1);
        outcome.confidence = sure;
        return calibration_record(plan, targets, outcome, TrialFolders(folder.path())).warnings;
    };
    CHECK(warned(0.5, 30.5e6, 0.3, 0.1, 0.1).empty());
    const auto missed = warned(0.5, 20e6, 7.0, 0.1, 0.1);
    REQUIRE(missed.size() == 1);
    CHECK(missed[0] == "Target missed, ucs strength: 20 MPa where 30 MPa is wanted (-33.3 %); its tolerance is 5 %.");
    const auto bound = warned(1.0, 30e6, 0.3, 0.1, 0.1);
    REQUIRE(bound.size() == 1);
    CHECK(bound[0] == "tau_f = 20 MPa is at a bound of 10 MPa to 20 MPa: the best may lie beyond; widen it.");
    const auto noisy = warned(0.5, 30e6, 0.1, 0.4, 0.1);
    REQUIRE(noisy.size() == 1);
    CHECK(noisy[0].find("score of 0.100 lies below its noise floor of 0.400") != std::string::npos);
    const auto vague = warned(0.5, 30e6, 0.3, 0.1, 2.0);
    REQUIRE(vague.size() == 1);
    CHECK(vague[0] == "tau_f = 15 MPa is hardly told by these targets: its standard error is more than its whole range.");
}
