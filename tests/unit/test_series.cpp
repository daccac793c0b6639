#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "lab/output_folder.hpp"
#include "lab/series/expand.hpp"
#include "lab/series/plan.hpp"
#include "lab/series/seed_groups.hpp"
#include "lab/series/series_report.hpp"
#include "lab/series/workers.hpp"
#include "reports/files.hpp"
#include "reports/html.hpp"
#include "tests/support.hpp"

using namespace proveta;
using input::Json;
using proveta::testing::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of(const Plan& plan) {
    std::vector<std::string> out;
    for (const auto& m : plan.members) {
        out.push_back(m.name);
    }
    return out;
}

input::Problems problems_of_plan(const std::vector<std::string>& files, const std::vector<std::string>& settings = {}) {
    try {
        read_plan(files, settings);
    } catch (const input::InputError& e) {
        return e.problems;
    }
    return {};
}

// A complete member with some results.
MemberResult tested(const Member& member, std::vector<report::Scalar> results) {
    MemberResult r;
    r.member = &member;
    r.status = "complete";
    r.results = std::move(results);
    r.badges = {{"Energy balance", true, "holds", {}}};
    r.curve = MainCurve{{{0.0, 1e-3, 2e-3}, {0.0, 1e7 * static_cast<double>(member.deck.specimen.seed), 0.0}},
                        {"axial_strain", "", "strain"},
                        {"axial_stress", "Pa", "stress"},
                        {"t", "axial strain [%]", "axial stress [MPa]", 100.0, 1e-6}};
    return r;
}

} // namespace

TEST_CASE("a deck with lists stands for their product, the pressures in the outer loop") {
    input::Problems problems;
    const Json deck =
        Json::parse(R"({"test": "triaxial", "loading": {"confining_pressure": ["0 MPa", 4.5e6]}, "specimen": {"seed": [1, 2]}})");
    REQUIRE(has_lists(deck));
    const auto decks = expand(deck, "d.json", problems);
    CHECK(problems.empty());
    REQUIRE(decks.size() == 4);
    CHECK(decks[0].label == "p_0MPa_seed_1");
    CHECK(decks[3].label == "p_4.5MPa_seed_2");
    CHECK(decks[3].json["loading"]["confining_pressure"] == 4.5e6);
    CHECK(decks[3].json["specimen"]["seed"] == 2);
    CHECK(decks[3].entries.at(0).index == 1);

    const Json plain = Json::parse(R"({"test": "ucs"})");
    CHECK_FALSE(has_lists(plain));
    REQUIRE(expand(plain, "d.json", problems).size() == 1);
    CHECK(expand(plain, "d.json", problems).front().json == plain);
}

TEST_CASE("lists that make no series are refused at the place of the entry") {
    const TemporaryFolder decks;
    const auto path_of = [&](const std::string& text) {
        const auto problems = problems_of_plan({decks.file("d.json", text)});
        REQUIRE(problems.size() == 1);
        return problems.front().path;
    };
    CHECK(path_of(R"({"test": "triaxial", "loading": {"confining_pressure": []}})") == "/loading/confining_pressure");
    CHECK(path_of(R"({"test": "triaxial", "loading": {"confining_pressure": ["1.5 MPa", "0 MPa", 1500000]}})") ==
          "/loading/confining_pressure/2");
    CHECK(path_of(R"({"test": "triaxial", "loading": {"confining_pressure": ["1 MPa", "-1 MPa"]}})") == "/loading/confining_pressure/1");
    CHECK(path_of(R"({"test": "triaxial", "loading": {"confining_pressure": ["1 MPa", ["2 MPa"]]}})") == "/loading/confining_pressure/1");
    CHECK(path_of(R"({"test": "ucs", "specimen": {"seed": [1, 2.5]}})") == "/specimen/seed/1");
    // A test without the key refuses the list as a whole, once.
    CHECK(path_of(R"({"test": "ucs", "loading": {"confining_pressure": ["1 MPa", "2 MPa"]}})") == "/loading/confining_pressure");
    // What is wrong with every member is said once.
    CHECK(path_of(R"({"test": "ucs", "specimen": {"seed": [1, 2, 3], "diameter": 0}})") == "/specimen/diameter");
}

TEST_CASE("members are named after their lists, and after their decks among several") {
    const TemporaryFolder decks;
    const auto ucs = decks.file("ucs.json", R"({"test": "ucs"})");
    const auto confined = decks.file("confined.json", R"({"test": "triaxial", "loading": {"confining_pressure": ["1 MPa", "2.25 MPa"]}})");
    CHECK_FALSE(read_plan({ucs}, {}).series);
    CHECK(names_of(read_plan({confined}, {})) == std::vector<std::string>{"p_1MPa", "p_2.25MPa"});
    CHECK(names_of(read_plan({ucs, confined}, {})) == std::vector<std::string>{"ucs", "confined_p_1MPa", "confined_p_2.25MPa"});
    CHECK(names_of(read_plan({ucs}, {"specimen.seed=[7,8]"})) == std::vector<std::string>{"seed_7", "seed_8"});
    const auto one = read_plan({ucs}, {"specimen.seed=[7]"});
    CHECK(one.series);
    CHECK(one.members.size() == 1);
    // The same test twice says nothing new.
    const auto twice = problems_of_plan({ucs, ucs});
    REQUIRE(twice.size() == 1);
    CHECK(twice.front().found == "the same test as \"ucs\"");
}

TEST_CASE("the manifest of a series is the series") {
    const TemporaryFolder decks;
    const Plan plan = read_plan({decks.file("d.json", R"({"test": "ucs", "specimen": {"seed": [3, 4]}})")}, {});
    const Json manifest = series_manifest(plan, {"aa", "bb"}, "proveta run", "complete", "now", "f");
    const Plan again = read_plan({decks.file("manifest.json", manifest.dump())}, {});
    CHECK(again.series);
    CHECK(names_of(again) == names_of(plan));
    CHECK(again.members[1].deck.expected_specimen == "bb");
    CHECK(resolved(again.members[1].deck) == resolved(plan.members[1].deck));
    Json evil = manifest;
    evil["members"][0]["name"] = "../elsewhere";
    CHECK(problems_of_plan({decks.file("evil.json", evil.dump())}).at(0).path == "/members/0/name");
}

TEST_CASE("threads and memory say how many members run at once") {
    CHECK(members_at_once(8, 3, 1e9, 1e12) == 3);
    CHECK(members_at_once(2, 6, 1e9, 1e12) == 2);
    CHECK(members_at_once(8, 6, 1e9, 5e9) == 4); // four fifths of what is there
    CHECK(members_at_once(8, 6, 1e9, 1e6) == 1);
    CHECK(members_at_once(8, 6, 1e9, std::nullopt) == 6);
    CHECK(memory_of_test(1000000) > 100.0 * memory_of_test(1000));
    for (const std::size_t threads : {1, 2, 5, 8}) {
        for (const std::size_t workers : {1, 2, 3}) {
            int sum = 0;
            for (std::size_t k = 0; k < workers; ++k) {
                CHECK(threads_of_worker(k, workers, threads) >= 1);
                sum += threads_of_worker(k, workers, threads);
            }
            CHECK(sum == static_cast<int>(std::max(threads, workers)));
        }
    }
}

TEST_CASE("a member's name without its seed") {
    CHECK(name_without_seed("p_4.5MPa_seed_12") == "p_4.5MPa");
    CHECK(name_without_seed("seed_2") == "seeds");
    CHECK(name_without_seed("linseed_2") == "linseed_2");
    CHECK(name_without_seed("seed_") == "seed_");
    CHECK(name_without_seed("ucs") == "ucs");
}

TEST_CASE("a series finds its envelope, its ratios and its groups") {
    const TemporaryFolder decks;
    const auto confined = decks.file(
        "t.json",
        R"({"test": "triaxial", "loading": {"confining_pressure": [0, 1e7]}, "specimen": {"seed": [1, 2]}, "material": {"card": "custom"}})");
    const auto splitting = decks.file("b.json", R"({"test": "brazilian"})");
    const Plan plan = read_plan({confined, splitting}, {});
    REQUIRE(plan.members.size() == 5);
    std::vector<MemberResult> members;
    for (const auto& m : plan.members) { // sigma_1 = 30 MPa + 4 sigma_3, the same for both seeds
        const bool high = m.name.find("10MPa") != std::string::npos;
        members.push_back(m.deck.test == "brazilian" ? tested(m, {{"splitting_strength", "Splitting", 3e6, "Pa", ""}})
                                                     : tested(m, {{"confining_pressure", "Pressure", high ? 1e7 : 0.0, "Pa", ""},
                                                                  {"strength", "Strength", high ? 70e6 : 30e6, "Pa", ""}}));
    }
    const SeriesResults r = evaluate(members);
    REQUIRE(r.envelope);
    CHECK(r.envelope->points.size() == 5);
    REQUIRE(r.envelope->mohr_coulomb);
    CHECK(r.envelope->mohr_coulomb->line.slope == Approx(4.0));
    CHECK(*r.envelope->fc == Approx(30e6));
    CHECK(r.envelope->thesis);
    REQUIRE(r.groups.size() == 2);
    CHECK(r.groups[1].name == "t_p_10MPa");
    CHECK(r.groups[1].members == std::vector<std::size_t>{2, 3});
    REQUIRE(r.groups[0].mean);
    CHECK(*std::max_element(r.groups[0].mean->mean.begin(), r.groups[0].mean->mean.end()) == Approx(1.5e7).epsilon(1e-3));
    const auto ratio = std::find_if(r.scalars.begin(), r.scalars.end(), [](const auto& s) { return s.name == "compressive_to_splitting"; });
    REQUIRE(ratio != r.scalars.end());
    CHECK(*ratio->value == Approx(10.0));
    CHECK(r.status == "complete");
    CHECK(ending(r) == "5 tests: 5 complete");

    const report::Record record = series_record(plan, r);
    const std::string page = report::to_html(record);
    CHECK(page.find("<a href=\"t_p_0MPa_seed_1/report.html\">") != std::string::npos);
    const report::TextTable table = series_table(r);
    CHECK(table.rows.size() == 6);
    CHECK(table.rows[0][2] == "confining_pressure_Pa");
    CHECK(table.rows[5].size() == table.rows[0].size());
    CHECK(series_summary(record, r)["groups"][0]["statistics"]["strength"]["n"] == 2);

    // Warnings that differ in their figures alone stand together.
    auto warned = members;
    for (std::size_t k = 0; k < warned.size(); ++k) {
        warned[k].warnings = {"Every test has this."};
        if (k < 3) {
            warned[k].warnings.push_back("Off by 0." + std::to_string(k) + " of it.");
        }
    }
    const auto told = series_record(plan, evaluate(warned)).warnings;
    REQUIRE(told.size() == 2);
    CHECK(told[0] == "Every test has this. (all tests)");
    CHECK(told[1] == "Off by 0.0 of it. (t_p_0MPa_seed_1; with other figures t_p_0MPa_seed_2, t_p_10MPa_seed_1)");

    // What has failed takes no part in what is derived.
    members[0].status = members[1].status = "failed";
    const SeriesResults partial = evaluate(members);
    CHECK_FALSE(partial.envelope);
    CHECK(partial.status == "failed");
    CHECK_FALSE(partial.groups[0].mean);
    members[2].status = "not run";
    CHECK(evaluate(members).status == "interrupted");
    members[2].status = "interrupted";
    CHECK(evaluate(members).status == "interrupted");
}

TEST_CASE("a cell with a comma or a quote stays one cell") {
    CHECK(report::to_csv(report::TextTable{"", {{"a,b", "c"}, {"say \"x\"", "1"}}}) == "\"a,b\",c\n\"say \"\"x\"\"\",1\n");
}

TEST_CASE("a folder gives up the members of the series that it held, and nothing else") {
    const TemporaryFolder decks;
    const fs::path folder = decks.path() / "out";
    fs::create_directories(folder / "p_1MPa");
    fs::create_directories(folder / "mine");
    std::ofstream(folder / "p_1MPa" / "manifest.json") << R"({"proveta_manifest": 1})";
    std::ofstream(folder / "mine" / "notes.txt") << "x";
    std::ofstream(folder / "manifest.json")
        << R"({"proveta_series_manifest": 1, "members": [{"name": "p_1MPa"}, {"name": "mine"}, {"name": "../out/mine"}, {"name": ".."}, {"name": "."}, 3]})";
    std::ofstream(decks.path() / "manifest.json") << R"({"proveta_manifest": 1})"; // around it, and none of its members
    OutputFolder out(folder);
    CHECK(fs::exists(folder / "p_1MPa"));
    out.begin();
    CHECK_FALSE(fs::exists(folder / "p_1MPa"));
    CHECK(input::text_at(input::load_json((folder / "manifest.json").string()), "status") == "cleared");
    CHECK(fs::exists(folder / "mine" / "notes.txt"));
    CHECK(fs::exists(decks.path() / "manifest.json"));
}

TEST_CASE("a folder is an earlier result by its own manifest or ledger, and by nothing else") {
    const TemporaryFolder place;
    const auto usable = [&](const char* name, const char* file, const std::string& text) {
        fs::create_directories(place.path() / name);
        std::ofstream(place.path() / name / file) << text;
        try {
            const OutputFolder out(place.path() / name);
            return true;
        } catch (const input::InputError&) {
            return false;
        }
    };
    CHECK_FALSE(usable("app", "manifest.json", R"({"name": "my web app"})"));
    CHECK_FALSE(usable("list", "manifest.json", "[1, 2]"));
    CHECK_FALSE(usable("text", "ledger.jsonl", "Some other ledger\n"));
    CHECK(usable("run", "manifest.json", R"({"proveta_manifest": 1})"));
    CHECK(usable("sweep", "manifest.json", R"({"proveta_sweep_manifest": 1})"));
    CHECK(usable("trials", "ledger.jsonl", R"({"trial":"a","values":[],"jobs":[]})"));
    CHECK(usable("begun", "ledger.jsonl", ""));
    CHECK(usable("killed", "manifest.json.partial", "{"));
    CHECK_FALSE(usable("films", "film.mp4.partial", "x"));
    fs::create_directories(place.path() / "series" / "seed_1"); // of a series that was killed before its tests
    CHECK(usable("series", "manifest.json.partial", "{"));
    fs::create_directories(place.path() / "shared" / "pictures");
    std::ofstream(place.path() / "shared" / "pictures" / "cat.png") << "x";
    CHECK_FALSE(usable("shared", "ledger.jsonl", ""));
    CHECK_FALSE(usable("short", "ledger.jsonl", "abc"));
}

TEST_CASE("a folder that is not begun goes, but not what others have put there") {
    const TemporaryFolder place;
    {
        const OutputFolder out(place.path() / "a" / "b" / "c");
        CHECK(fs::exists(place.path() / "a" / "b" / "c"));
    }
    CHECK_FALSE(fs::exists(place.path() / "a"));
    {
        const OutputFolder out(place.path() / "a" / "b" / "c");
        std::ofstream(place.path() / "a" / "thesis.txt") << "x";
    }
    CHECK(fs::exists(place.path() / "a" / "thesis.txt"));
    CHECK_FALSE(fs::exists(place.path() / "a" / "b"));
    fs::create_symlink(place.path() / "nowhere", place.path() / "link");
    CHECK_THROWS_AS(OutputFolder(place.path() / "link"), input::InputError);
    CHECK(fs::is_symlink(place.path() / "link"));
    { const OutputFolder out(place.path() / "q" / ".." / "w"); }
    CHECK_FALSE(fs::exists(place.path() / "q"));
    CHECK_FALSE(fs::exists(place.path() / "w"));
}

TEST_CASE("a result is not ended in another folder than it began in") {
    const TemporaryFolder place;
    const fs::path path = place.path() / "out";
    OutputFolder out(path);
    out.begin();
    out.write_manifest({{"status", "running"}});
    fs::rename(path, place.path() / "moved");
    CHECK_THROWS_AS(make_folder(out.file("pictures")), FolderGone);
    CHECK_THROWS_AS(make_folder(path / "pictures"), FileError);
    CHECK_FALSE(fs::exists(path));
    CHECK_THROWS_AS(out.write_manifest({{"status", "complete"}}), FileError);
    fs::create_directory(path); // a new one of the same name is another all the same
    CHECK_THROWS_AS(out.write_manifest({{"status", "complete"}}), FileError);
    CHECK(fs::is_empty(path));
    CHECK(input::text_at(input::load_json((place.path() / "moved" / "manifest.json").string()), "status") == "running");
}

TEST_CASE("a member's folder that its series clears stays with it, that of another goes") {
    const TemporaryFolder place;
    for (const char* name : {"ucs", "old"}) {
        fs::create_directories(place.path() / "out" / name / "fields");
        std::ofstream(place.path() / "out" / name / "manifest.json") << R"({"proveta_manifest": 1})";
    }
    std::ofstream(place.path() / "out" / "manifest.json")
        << R"({"proveta_series_manifest": 1, "members": [{"name": "ucs"}, {"name": "old"}]})";
    OutputFolder series(place.path() / "out");
    OutputFolder member(place.path() / "out" / "ucs");
    series.begin({"ucs"});
    CHECK_FALSE(fs::exists(place.path() / "out" / "old"));
    CHECK(fs::is_empty(place.path() / "out" / "ucs"));
    member.begin();
    member.write_manifest({{"status", "running"}});
    CHECK_THROWS_AS(OutputFolder(place.path() / "out" / "ucs"), input::InputError);
}

TEST_CASE("what others put in the place of a claimed folder is not cleared") {
    const TemporaryFolder place;
    OutputFolder out(place.path() / "out");
    fs::rename(place.path() / "out", place.path() / "moved");
    fs::create_directories(place.path() / "out" / "pictures");
    std::ofstream(place.path() / "out" / "curve.csv") << "x";
    CHECK_THROWS_AS(out.begin(), FolderGone);
    CHECK_THROWS_AS(out.file("curve.csv"), FolderGone);
    CHECK(fs::exists(place.path() / "out" / "pictures"));
    CHECK(fs::exists(place.path() / "out" / "curve.csv"));
}

TEST_CASE("names of members are names of folders that are none of the results' own files") {
    for (const char* good : {"p_1MPa", "ucs", "a b", "1"}) {
        CHECK(is_member_name(good));
    }
    for (const std::string bad : {"", ".", "..", ".hidden", "a/b", "/a", "report.html", "manifest.json", "fields", "trials"}) {
        INFO(bad);
        CHECK_FALSE(is_member_name(bad));
    }
    CHECK_FALSE(is_member_name(std::string(300, 'x')));
    CHECK(result_name("some/where/my.deck.json", "ucs") == "my.deck");
    CHECK(result_name("...json", "ucs") == "ucs");
    CHECK(result_name("manifest.json", "ucs") == "ucs");
    CHECK(result_name("report.html.json", "ucs") == "ucs");
}
