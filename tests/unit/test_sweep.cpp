#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lab/sweep/sweep_report.hpp"
#include "lab/trials/verdicts.hpp"
#include "reports/html.hpp"
#include "reports/svg.hpp"
#include "specimens/hdf5_file.hpp"
#include "tests/support.hpp"

using namespace proveta;
using proveta::testing::TemporaryFolder;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// A function of each point.
template <class F> std::vector<double> over(const std::vector<Point>& points, const F& f) {
    std::vector<double> out;
    for (const auto& p : points) {
        out.push_back(f(p));
    }
    return out;
}

std::vector<double> coordinates(const std::vector<Point>& points, std::size_t k) {
    return over(points, [k](const Point& p) { return p[k]; });
}

std::string sweep_text(const std::string& more) {
    return R"({"tests": [{"name": "press", "deck": {"test": "ucs", "material": {"card": "custom"}}}],
               "parameters": [{"path": "material.tau_f", "low": "10 MPa", "high": "20 MPa"},
                              {"path": "material.sigma_f", "low": 0.1, "high": 0.3, "times": "tau_f"}])" +
           more + "}";
}

input::Problems problems_of_sweep(const std::string& file) {
    try {
        read_sweep(file);
    } catch (const input::InputError& e) {
        return e.problems;
    }
    return {};
}

// A trial of a sweep of the test "press" that came to a strength.
TrialResult tested(const Sweep& sweep, std::size_t point, double strength) {
    JobResult job{"press", "press", "complete", "", {{"strength", strength}}, true, 1.0, 1.0, {{"strength", "Pa"}}};
    return {"key", sweep.values[point], {job}};
}

} // namespace

TEST_CASE("a grid is the product of its levels") {
    const auto points = grid({{0.0, 1.0}, {0.0, 0.5, 1.0}});
    REQUIRE(points.size() == 6);
    CHECK(points[0] == Point{0.0, 0.0});
    CHECK(points[1] == Point{0.0, 0.5});
    CHECK(points[5] == Point{1.0, 1.0});
}

TEST_CASE("a Latin hypercube has one point in every stratum of every parameter") {
    const std::size_t n = 50;
    const auto points = latin_hypercube(n, 3, 7);
    for (std::size_t k = 0; k < 3; ++k) {
        std::set<int> strata;
        for (const auto& p : points) {
            CHECK(p[k] >= 0.0);
            CHECK(p[k] < 1.0);
            strata.insert(static_cast<int>(p[k] * static_cast<double>(n)));
        }
        CHECK(strata.size() == n);
    }
    CHECK(points == latin_hypercube(n, 3, 7));
    CHECK(points != latin_hypercube(n, 3, 8));
    CHECK(coordinates(points, 0) != coordinates(points, 1));
}

TEST_CASE("Sobol's sequence begins after the origin") {
    const auto points = sobol(7, 2);
    const std::vector<Point> known{{0.5, 0.5}, {0.75, 0.25}, {0.25, 0.75}, {0.375, 0.375}, {0.875, 0.875}, {0.625, 0.125}, {0.125, 0.625}};
    CHECK(points == known);
    // Of 2^m - 1 points and the origin, each 2^m-th of each parameter's range holds one.
    const auto many = sobol(63, 5);
    for (std::size_t k = 0; k < 5; ++k) {
        std::set<int> strata{0};
        for (const auto& p : many) {
            strata.insert(static_cast<int>(p[k] * 64.0));
        }
        CHECK(strata.size() == 64);
    }
    CHECK_THROWS_AS(sobol(1, 4000), std::invalid_argument);
}

TEST_CASE("each step of a Morris trajectory changes one parameter, and each parameter changes once") {
    const std::size_t k = 5;
    const auto points = morris(20, k, 4, 3);
    REQUIRE(points.size() == 20 * (k + 1));
    for (std::size_t t = 0; t < 20; ++t) {
        std::set<std::size_t> moved;
        for (std::size_t i = 0; i < k; ++i) {
            const auto& a = points[t * (k + 1) + i];
            const auto& b = points[t * (k + 1) + i + 1];
            int changes = 0;
            for (std::size_t j = 0; j < k; ++j) {
                if (a[j] != b[j]) {
                    ++changes;
                    moved.insert(j);
                    CHECK(std::fabs(b[j] - a[j]) == Approx(2.0 / 3.0)); // p / (2 (p - 1))
                }
                CHECK(std::fabs(3.0 * b[j] - std::round(3.0 * b[j])) < 1e-12);
                CHECK((b[j] >= 0.0 && b[j] <= 1.0));
            }
            CHECK(changes == 1);
        }
        CHECK(moved.size() == k);
    }
    CHECK(points == morris(20, k, 4, 3));
    CHECK(points != morris(20, k, 4, 4));
    CHECK_THROWS_AS(morris(1, 2, 3, 1), std::invalid_argument);
}

TEST_CASE("equal values share the mean of their ranks") {
    CHECK(ranks({3.0, 1.0, 3.0, 2.0}) == std::vector<double>{3.5, 1.0, 3.5, 2.0});
    // By hand: ranks 1 2 3 4 and 1 3 2 4, so 1 - 6 * 2 / (4 * 15).
    CHECK(*rank_correlation({1, 2, 3, 4}, {1, 9, 4, 16}) == Approx(0.8));
}

TEST_CASE("a monotone function has rank correlation 1 or -1, another parameter next to none") {
    const auto points = sobol(255, 2);
    const auto x = coordinates(points, 0);
    const auto up = over(points, [](const Point& p) { return std::exp(5.0 * p[0]); });
    const auto down = over(points, [](const Point& p) { return 1.0 / (0.1 + p[0]); });
    CHECK(*rank_correlation(x, up) == Approx(1.0).epsilon(1e-14));
    CHECK(*rank_correlation(x, down) == Approx(-1.0).epsilon(1e-14));
    CHECK(std::fabs(*rank_correlation(coordinates(points, 1), up)) < 0.02);
    CHECK_FALSE(rank_correlation(x, std::vector<double>(x.size(), 1.0)));
    // What has failed does not count.
    CHECK(*rank_correlation({1, 2, 3, 4}, {1, 2, none, 4}) == Approx(1.0));
    CHECK_FALSE(rank_correlation({1, 2, 3, 4}, {1, none, none, 4}));
}

TEST_CASE("chance stays within the bound nineteen times in twenty") {
    int beyond = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const auto points = latin_hypercube(20, 2, seed);
        beyond += std::fabs(*rank_correlation(coordinates(points, 0), coordinates(points, 1))) > significant_correlation(20) ? 1 : 0;
    }
    CHECK(beyond > 8); // 20 expected, deviation 4.4
    CHECK(beyond < 34);
    CHECK(significant_correlation(20) == Approx(0.4438).epsilon(1e-3)); // Pearson's tables for 18 degrees of freedom
    CHECK(significant_correlation(3) == 1.0);
}

TEST_CASE("elementary effects of a linear function are its slopes, without scatter") {
    const auto points = morris(6, 3, 4, 1);
    auto y = over(points, [](const Point& p) { return 7.0 + 2.0 * p[0] - 5.0 * p[1]; });
    auto effects = elementary_effects(points, y);
    REQUIRE(effects.size() == 3);
    const double slopes[] = {2.0, -5.0, 0.0};
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(effects[k].n == 6);
        CHECK(effects[k].mu == Approx(slopes[k]).margin(1e-12));
        CHECK(effects[k].mu_star == Approx(std::fabs(slopes[k])).margin(1e-12));
        CHECK(effects[k].sigma == Approx(0.0).margin(1e-12));
    }
    y[1] = none; // takes the effects to and from it away
    effects = elementary_effects(points, y);
    CHECK(effects[0].n + effects[1].n + effects[2].n == 16);
    // An interaction scatters; effects of both signs cancel in mu, not in mu*.
    const auto bent = over(points, [](const Point& p) { return (p[0] - 0.5) * (p[1] - 0.5); });
    effects = elementary_effects(points, bent);
    CHECK(effects[0].sigma > 0.1);
    CHECK(effects[0].mu_star > std::fabs(effects[0].mu));
}

TEST_CASE("a curve tells which parameter shapes which part of it") {
    // Stiffness by the first parameter up to x = 1, then a plateau at a height of the second.
    const auto design = GENERATE(false, true);
    const auto points = design ? morris(10, 2, 4, 1) : sobol(31, 2);
    std::vector<SampledCurve> curves;
    for (const auto& p : points) {
        SampledCurve c;
        for (int i = 0; i <= 200; ++i) {
            const double x = 0.01 * i;
            c.x.push_back(x);
            c.y.push_back(x < 1.0 ? (1.0 + p[0]) * x : 3.0 + p[1]);
        }
        curves.push_back(std::move(c));
    }
    curves[3] = {}; // failed
    const auto s = curve_sensitivity(points, curves, design);
    REQUIRE(s);
    CHECK(s->n == points.size() - 1);
    CHECK(s->x.front() == 0.0);
    CHECK(s->x.back() == 2.0);
    REQUIRE(s->x.size() == 101);
    CHECK(s->x[25] == Approx(0.5));
    if (design) {
        CHECK(s->s[0][25] == Approx(0.5)); // slope 0.5 there, the largest anywhere is 1
        CHECK(s->s[1][25] == Approx(0.0).margin(1e-12));
        CHECK(s->s[1][90] == Approx(1.0));
    } else {
        CHECK(s->s[0][25] == Approx(1.0));
        CHECK(std::fabs(s->s[1][25]) < 0.15);
        CHECK(s->s[1][90] == Approx(1.0));
        CHECK(std::isnan(s->s[0][0])); // nothing varies at x = 0
    }
    CHECK_FALSE(curve_sensitivity(points, std::vector<SampledCurve>(points.size()), design));
}

TEST_CASE("a sweep is read with its decks, and its manifest is the same sweep") {
    const TemporaryFolder folder;
    const Sweep sweep = read_sweep(folder.file("s.json", sweep_text(R"(, "design": "latin_hypercube", "points": 5, "seed": 3)")));
    CHECK(sweep.input.title == "s");
    REQUIRE(sweep.points.size() == 5);
    const auto trials = trials_of(sweep);
    const auto& deck = trials[2].jobs[0].deck;
    CHECK(trials[2].jobs[0].name == "press_seed_1");
    CHECK(deck["material"]["tau_f"] == 10e6 + 10e6 * sweep.points[2][0]);
    CHECK(deck["material"]["sigma_f"].get<double>() == Approx(sweep.values[2][1] * sweep.values[2][0])); // a multiple
    const input::Json manifest{{"proveta_sweep_manifest", 1}, {"sweep", resolved(sweep)}};
    const Sweep again = read_sweep(folder.file("manifest.json", manifest.dump()));
    const auto same = trials_of(again);
    REQUIRE(same.size() == trials.size());
    for (std::size_t i = 0; i < trials.size(); ++i) {
        CHECK(same[i].key == trials[i].key);
    }
}

TEST_CASE("levels of a grid are taken as they are") {
    const TemporaryFolder folder;
    const Sweep sweep = read_sweep(
        folder.file("s.json", R"({"tests": [{"name": "press", "deck": {"test": "ucs", "material": {"card": "custom"}}}], "design": "grid",
        "parameters": [{"path": "material.tau_f", "values": ["11 MPa", "13.7 MPa"]},
                       {"path": "material.mu_s", "low": 0.1, "high": 0.9, "levels": 3}]})"));
    REQUIRE(sweep.values.size() == 6);
    CHECK(sweep.values[0] == std::vector<double>{11e6, 0.1});
    CHECK(sweep.values[3] == std::vector<double>{13.7e6, 0.1});
    CHECK(sweep.values[4][1] == Approx(0.5));
    CHECK(sweep.points[5] == Point{1.0, 1.0});
}

TEST_CASE("what is wrong with a sweep is said at its place") {
    const TemporaryFolder folder;
    const auto path_of = [&](const std::string& more) {
        const auto problems = problems_of_sweep(folder.file("s.json", sweep_text(more)));
        REQUIRE(problems.size() == 1);
        return problems.front().path;
    };
    CHECK(path_of(R"(, "results": ["strength", 1])") == "/results");
    CHECK(path_of(R"(, "results": ["strength", "strenth"])") == "/results/1");
    CHECK(path_of(R"(, "design": "morris", "levels": 5)") == "/levels");
    CHECK(path_of(R"(, "design": "morris", "points": 50000)") == "/points");
    CHECK(path_of(R"(, "design": "random")") == "/design");
    const auto law = problems_of_sweep(folder.file("l.json", R"({"tests": [{"name": "press", "deck": {"test": "ucs"}}],
        "parameters": [{"path": "material.tau_f", "low": 1e6, "high": 2e6}]})"));
    REQUIRE(law.size() == 1); // said as a deck says it
    CHECK(law.front().suggestion.find("it belongs to law") != std::string::npos);
    CHECK(path_of(R"(, "design": "sobol", "seed": 3)") == "/seed");
    CHECK(path_of(R"(, "design": "latin_hypercube", "levels": 4)") == "/levels");
    const auto text = problems_of_sweep(folder.file("t.json", R"({"tests": [{"name": "press", "deck": {"test": "ucs"}}],
        "parameters": [{"path": "material.card", "low": 1, "high": 2}, {"path": "material/density", "low": 2000, "high": 2500}]})"));
    REQUIRE(text.size() == 2);
    CHECK(text[0].path == "/parameters/0/path");
    CHECK(text[0].suggestion == "it takes a text");
    CHECK(text[1].path == "/parameters/1/path");
    const auto beyond =
        problems_of_sweep(folder.file("b.json", R"({"tests": [{"name": "press", "deck": {"test": "ucs", "material": {"card": "custom"}}}],
        "parameters": [{"path": "material.tau_f", "low": -1, "high": "9 MPa"}, {"path": "material.mu_s", "values": [0.1, 0.2]}]})"));
    REQUIRE(beyond.size() == 1);
    CHECK(beyond.front().path == "/parameters/1/values");
    const auto bounds =
        problems_of_sweep(folder.file("c.json", R"({"tests": [{"name": "press", "deck": {"test": "ucs", "material": {"card": "custom"}}}],
        "parameters": [{"path": "material.tau_f", "low": -1, "high": "9 MPa"}]})"));
    REQUIRE(bounds.size() == 1);
    CHECK(bounds.front().path == "/parameters/0/low");
    CHECK(bounds.front().found.find("tau_f = -1") != std::string::npos);
}

TEST_CASE("what all tests of a sweep share is wrong once, where it is written") {
    const TemporaryFolder folder;
    const auto problems = problems_of_sweep(folder.file("s.json", R"({"deck": {"specimen": {"seed": [1, 2]}, "output": {"pictures": 9000}},
        "tests": [{"name": "press", "deck": {"test": "ucs", "loading": {"rte": 1}}}, {"name": "split", "deck": {"test": "brazilian"}}],
        "parameters": [{"path": "material.density", "low": 2000, "high": 2500}]})"));
    std::vector<std::string> paths;
    for (const auto& p : problems) {
        paths.push_back(p.path);
    }
    std::sort(paths.begin(), paths.end());
    CHECK(paths == std::vector<std::string>{"/deck/output/pictures", "/deck/specimen/seed", "/tests/0/deck/loading/rte"});
}

TEST_CASE("table, sensitivities and page of a sweep") {
    const TemporaryFolder folder;
    const bool trajectories = GENERATE(false, true);
    const Sweep sweep =
        read_sweep(folder.file("s.json", sweep_text(trajectories ? R"(, "design": "morris", "points": 5)"
                                                                 : R"(, "points": 15, "results": ["strength", "strain_at_peak"])")));
    SweepOutcome o;
    std::vector<TrialResult> trials;
    for (std::size_t i = 0; i < sweep.values.size(); ++i) {
        trials.push_back(tested(sweep, i, 2.0 * sweep.values[i][0]));
    }
    trials[4].jobs[0].status = "failed";
    trials[4].jobs[0].reason = "a reason, with a comma";
    o.table = make_table(sweep, trials);
    o.sensitivities = sensitivities(sweep, o.table);
    CHECK(o.table.failed() == 1);

    const auto rows = rows_of(sweep, o.table).rows;
    REQUIRE(rows.size() == sweep.values.size() + 1);
    CHECK(rows[0] == std::vector<std::string>{"point", "trial", "tau_f_Pa", "sigma_f_Pa", "status", "quasi_static", "press.strength_Pa"});
    CHECK(std::stod(rows[1][3]) == Approx(sweep.values[0][0] * sweep.values[0][1]));
    CHECK(rows[5][4] == "failed");
    CHECK(rows[5][6].empty());
    CHECK(failures_of(o.table).rows[1] == std::vector<std::string>{"5", "key", "press", "a reason, with a comma"});
    write_hdf5(sweep, o.table, folder.file("table.h5"));
    const Hdf5File stored(folder.file("table.h5"), Hdf5File::Mode::read);
    std::vector<double> strength;
    stored.get("press.strength_Pa", strength);
    REQUIRE(strength.size() == sweep.values.size());
    CHECK(strength[0] == o.table.results[0].mean[0]);
    CHECK(std::isnan(strength[4]));

    const auto& s = o.sensitivities[0];
    CHECK(by_influence(s) == std::vector<std::size_t>{0, 1});
    CHECK(s[0].value == Approx(1.0));
    if (trajectories) {
        CHECK(s[0].effects.mu == Approx(2.0 * 10e6)); // per full range
        CHECK(s[1].effects.mu_star == Approx(0.0).margin(1e-3));
    } else {
        CHECK(s[0].n == 14);
        CHECK(unknown_results(sweep, o.table).size() == 1);
    }
    const auto record = sweep_record(sweep, o);
    const std::string page = report::to_html(record);
    CHECK(page.find("a reason, with a comma") != std::string::npos);
    CHECK(page.find(trajectories ? "mu*" : "rank correlation") != std::string::npos);
    CHECK(sweep_summary(sweep, o, record)["failed"] == 1);
}

TEST_CASE("a trial whose specimen cannot be made fails with the reason, and by itself") {
    const TemporaryFolder folder;
    const Sweep sweep = read_sweep(folder.file("s.json", sweep_text(R"(, "points": 1)")));
    Trial trial = trials_of(sweep).front();
    trial.jobs[0].deck["specimen"]["spheres"] = -5; // as no bound of a parameter has shown
    const TrialFolders folders(folder.path());
    REQUIRE(folders.write(trial));
    REQUIRE(run_job(folders.trial(trial.key) / "press_seed_1"));
    const auto done = folders.finished(trial.key);
    REQUIRE(done.size() == 1);
    CHECK(done[0].status == "failed");
    CHECK(done[0].reason.find("/specimen/spheres") != std::string::npos);
}

TEST_CASE("trials and specimens of another physics have other keys") {
    const TemporaryFolder folder;
    const Trial trial = trials_of(read_sweep(folder.file("s.json", sweep_text(R"(, "points": 1)")))).front();
    CHECK(keyed(trial).key == trial.key);
    CHECK(keyed(trial, "0123456789ab").key != trial.key);
    const auto& recipe = trial.jobs[0].deck["specimen"];
    CHECK(specimen_key(recipe) == specimen_key(recipe, physics_revision()));
    CHECK(specimen_key(recipe, "0123456789ab") != specimen_key(recipe));
}

TEST_CASE("what the tests of a sweep say of themselves") {
    JobResult good{"a", "press", "complete", "", {}, true};
    good.verdict = "yes";
    good.rate_difference = 0.01;
    JobResult bad = good;
    bad.quasi_static = false;
    bad.verdict = "no";
    bad.rate_difference = 0.2;
    JobResult unchecked{"b", "split", "complete", "", {}, true};
    unchecked.verdict = "yes; not checked";
    JobResult failed = bad;
    failed.status = "failed";
    const auto v = verdicts_of({{"1", {}, {good, unchecked}}, {"2", {}, {failed}}, {"3", {}, {bad, good}}});
    CHECK(v["press"].dump() == R"({"good":false,"verdict":"no","tests":3,"good_tests":2,"rate_checked":3,"largest_rate_difference":0.2})");
    CHECK(v["split"]["good"] == true);
    CHECK(v["split"]["largest_rate_difference"].is_null());
}

TEST_CASE("a plot of rows names them instead of a y axis") {
    report::Plot plot{"t", "influence", "", {{"", {0.0, 0.5}, {-1.0, -1.0}}, {"", {0.0, -0.5}, {-2.0, -2.0}}}, {}};
    plot.rows = {"first & best", "second"};
    const std::string svg = report::to_svg(plot);
    CHECK(svg.find("first &amp; best") < svg.find("second"));
    CHECK(svg.find(">-1<") == std::string::npos);
}

TEST_CASE("influences that chance would give as well are no influences on the page of a sweep") {
    const TemporaryFolder folder;
    const Sweep sweep = read_sweep(folder.file("s.json", sweep_text(R"(, "points": 15)")));
    const auto page_of = [&](bool follows) {
        std::vector<TrialResult> trials;
        for (std::size_t i = 0; i < sweep.values.size(); ++i) {
            trials.push_back(tested(sweep, i, follows ? 2.0 * sweep.values[i][0] : 30e6 + 1e6 * static_cast<double>(i * 7919 % 5)));
        }
        SweepOutcome o;
        o.table = make_table(sweep, trials);
        o.sensitivities = sensitivities(sweep, o.table);
        return sweep_record(sweep, o);
    };
    const auto real = page_of(true);
    CHECK(real.warnings.empty());
    CHECK(real.key_figures.at(1).value == "tau_f");
    const auto chance = page_of(false);
    REQUIRE(chance.warnings.size() == 1);
    CHECK(chance.warnings[0].find("No influence beyond chance on press.strength (") == 0);
    CHECK(chance.key_figures.at(1).value == "none");
}
