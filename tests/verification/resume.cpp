// Every test of the laboratory, kept at many moments and gone on with from each on a bench set up anew: the same to the bit.
#include <catch2/catch.hpp>

#include "lab/test_run.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

struct Tried {
    TestData data;
    std::uint64_t state;
};

Deck deck_of(const std::string& test, const std::string& more) {
    input::Json json = {{"test", test}, {"output", {{"fields", 3}, {"samples", 60}}}};
    if (test != "granular-triaxial") {
        json["specimen"] = {{"diameter", "50 mm"}, {"height", "100 mm"}, {"spheres", 400}};
        json["material"] = verification::brittle_concrete();
    }
    json.merge_patch(input::Json::parse(more));
    return read_deck(json, "test.json");
}

Tried tried(const Deck& deck, const Specimen& specimen, TestHooks hooks) {
    Bench bench = set_up(deck, specimen);
    hooks.progress = [](const TestData&, double) {};
    hooks.fields = [] {};
    if (!hooks.interrupted) {
        hooks.interrupted = [] { return false; };
    }
    TestData data = run_protocol(deck, bench, hooks);
    return {std::move(data), bench.model->state_hash()};
}

void same(const report::Table& a, const report::Table& b) {
    REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
        CHECK(a.rows[k] == b.rows[k]);
    }
}

void same(const Tried& a, const Tried& b) {
    CHECK(a.state == b.state);
    CHECK(a.data.stopped_by == b.data.stopped_by);
    CHECK(a.data.stages == b.data.stages);
    same(a.data.curve, b.data.curve);
    same(a.data.energy, b.data.energy);
    REQUIRE(a.data.events.size() == b.data.events.size());
    for (std::size_t k = 0; k < a.data.events.size(); ++k) {
        const FailureEvent& one = a.data.events[k];
        const FailureEvent& other = b.data.events[k];
        CHECK((one.time == other.time && one.axial_strain == other.axial_strain && one.position == other.position &&
               one.mode == other.mode && one.energy == other.energy && one.area == other.area));
    }
    REQUIRE(a.data.pictures.size() == b.data.pictures.size());
    for (std::size_t k = 0; k < a.data.pictures.size(); ++k) {
        CHECK(a.data.pictures[k].title == b.data.pictures[k].title);
        CHECK(a.data.pictures[k].dots.size() == b.data.pictures[k].dots.size());
        CHECK(a.data.pictures[k].lines.size() == b.data.pictures[k].lines.size());
    }
}

// Keeps a test at up to `most` of its looks, spread over all of it, and where it must; then goes on from each of these.
void resumed_everywhere(const std::string& test, const std::string& more, std::size_t most, bool breaks) {
    INFO(test << " " << more);
    const TemporaryFolder folder;
    const Deck deck = deck_of(test, more);
    const Specimen specimen = obtain_specimen(deck.specimen, "", "test.json");
    int looks = 0;
    TestHooks counting;
    counting.keep = [&](const VisitState&, bool) { ++looks; };
    const Tried whole = tried(deck, specimen, counting);
    CHECK(whole.data.failure == "");
    CHECK((whole.data.events.size() > 0) == breaks);

    std::vector<std::string> files;
    int look = 0;
    TestHooks keeping;
    const int every = std::max(1, looks / static_cast<int>(most));
    keeping.keep = [&](const VisitState& state, bool must) {
        if (++look % every == 0 || must) {
            files.push_back(folder.file(std::to_string(look) + ".h5"));
            save_checkpoint(files.back(), "a test", state);
        }
    };
    same(tried(deck, specimen, keeping), whole); // keeping changes nothing
    REQUIRE(files.size() >= most / 2);
    for (const auto& file : files) {
        INFO(file);
        TestHooks going_on;
        going_on.restore = [&](const VisitState& state) { load_checkpoint(file, "a test", state); };
        same(tried(deck, specimen, going_on), whole);
    }
}

} // namespace

TEST_CASE("resume: compression, at the rate it leads itself, with cycles, and led by the girth") {
    resumed_everywhere("ucs", "{}", 6, true);
    resumed_everywhere("ucs", R"({"loading": {"cycles": [{"axial_strain": 0.0004}, {"axial_stress": "12 MPa"}]}})", 8, true);
    resumed_everywhere("ucs", R"({"loading": {"control": "girth", "stop": {"axial_strain": 0.003}}})", 6, true);
    resumed_everywhere("ucs", R"({"loading": {"rate": "0.2 m/s"}})", 4, true);
}

TEST_CASE("resume: triaxial compression, by a pressure and by a membrane") {
    resumed_everywhere("triaxial", R"({"loading": {"confining_pressure": "2 MPa"}})", 6, true);
    resumed_everywhere("triaxial",
                       R"({"loading": {"confining_pressure": "2 MPa", "confinement": "membrane", "rate": "0.5 m/s",
                           "stop": {"axial_strain": 0.004}}})",
                       4, true);
}

TEST_CASE("resume: splitting, tension, oedometric and hydrostatic tests") {
    resumed_everywhere("brazilian", R"({"specimen": {"shape": "disc", "diameter": "50 mm", "height": "25 mm"}})", 6, true);
    resumed_everywhere("direct-tension", "{}", 6, true);
    resumed_everywhere("oedometric", R"({"loading": {"stop": {"axial_strain": 0.004}}})", 4, true);
    resumed_everywhere("hydrostatic", R"({"loading": {"pressure": "40 MPa"}})", 4, false);
}

TEST_CASE("resume: facets, with the strain around them, through cycles and a release of pressure") {
    resumed_everywhere("ucs", R"({"material": null, "loading": {"cycles": [{"axial_strain": 0.001, "unload_to": 0.2}]}})", 6, true);
    resumed_everywhere("hydrostatic", R"({"material": null, "loading": {"pressure": "60 MPa", "unload_to": 0.3}})", 4, false);
    resumed_everywhere("ucs", R"({"material": null, "loading": {"rate": "0.3 m/s"}, "specimen": {"seed": 2}})", 4, true);
}

TEST_CASE("resume: a bed of stones in its membrane") {
    resumed_everywhere("granular-triaxial",
                       R"({"specimen": {"diameter": "120 mm", "height": "240 mm",
                                        "particles": {"form": "stone", "size": "30 mm", "spheres": 5, "forms": 4}, "seed": 3},
                           "loading": {"confining_pressure": "60 kPa", "rate": "0.4 m/s", "stop": {"axial_strain": 0.02}}})",
                       4, false);
}

TEST_CASE("resume: an interrupted test is kept where it stopped, and an ended one stays ended") {
    const TemporaryFolder folder;
    const Deck deck = deck_of("ucs", "{}");
    const Specimen specimen = obtain_specimen(deck.specimen, "", "test.json");
    const Tried whole = tried(deck, specimen, {});
    const std::string file = folder.file("kept.h5");
    TestHooks stopped;
    int looks = 0;
    stopped.interrupted = [&] { return ++looks > 20; };
    stopped.keep = [&](const VisitState& state, bool must) {
        if (must) {
            save_checkpoint(file, "a test", state);
        }
    };
    const Tried part = tried(deck, specimen, stopped);
    CHECK(part.data.interrupted);
    CHECK(part.data.curve.rows.size() < whole.data.curve.rows.size());
    TestHooks going_on;
    int fields = 0;
    going_on.restore = [&](const VisitState& state) { load_checkpoint(file, "a test", state); };
    going_on.keep = [&](const VisitState& state, bool must) {
        if (must) {
            save_checkpoint(file, "a test", state);
        }
    };
    same(tried(deck, specimen, going_on), whole);

    Bench bench = set_up(deck, specimen);
    going_on.progress = [](const TestData&, double) {};
    going_on.fields = [&] { ++fields; };
    going_on.interrupted = [] { return false; };
    const TestData ended = run_protocol(deck, bench, going_on);
    CHECK(bench.model->state_hash() == whole.state);
    CHECK(ended.curve.rows == whole.data.curve.rows);
    CHECK(fields == 0);
}
