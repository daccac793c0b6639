// A scene in which everything comes, goes and moves, kept at many moments and gone on with from each in a scene set up anew: the same to
// the bit.
#include <catch2/catch.hpp>

#include "lab/scene/scene_play.hpp"
#include "lab/scene/scene_samples.hpp"
#include "tests/support.hpp"

using namespace proveta;
using namespace proveta::testing;

namespace {

constexpr const char* busy_scene = R"scene({
  "scene": "A tray that is shaken, filled, pressed and emptied",
  "materials": [{"name": "grain", "material": {"card": "custom", "density": 2500, "young_modulus": "2 MPa", "elasticity": "as-given",
                 "contact_law": "hertz", "contact_restitution": 0.5, "mu_d": 0.4, "rolling_friction": 0.02}}],
  "surfaces": [
    {"name": "tray", "shape": "box", "size": ["100 mm", "100 mm", "300 mm"], "position": [0, 0, "150 mm"],
     "motion": {"kind": "expression", "velocity_x": "0.1*sin(2*pi*20*t)", "spin_z": "0.5*t"}},
    {"name": "lid", "shape": "plane", "size": ["80 mm", "80 mm"], "position": [0, 0, "120 mm"],
     "motion": {"kind": "servo", "force": "2 N", "most_speed": "1 m/s", "begin": "0.1 s"}},
    {"name": "arm", "shape": "helix", "inner_radius": "5 mm", "radius": "20 mm", "pitch": "50 mm", "height": "100 mm", "sides": 12,
     "position": [0, 0, "10 mm"], "motion": {"kind": "table", "file": "turns.csv"}}],
  "bodies": [{"name": "cushion", "shape": "box", "size": ["30 mm", "30 mm", "20 mm"], "cells": [2, 2, 2], "position": ["30 mm", 0, "12 mm"],
              "holds": [{"from": ["10 mm", "-20 mm", "-1 mm"], "to": ["50 mm", "20 mm", "3 mm"]}],
              "young_modulus": "0.2 MPa", "density": 1200}],
  "particles": [
    {"name": "beads", "size": "9 mm", "deviation": 0.15, "count": 150, "rate": "900 1/s", "from": ["-45 mm", "-45 mm", "180 mm"],
     "to": ["45 mm", "45 mm", "260 mm"], "velocity": [0, 0, -1]},
    {"name": "stones", "form": "stone", "size": "16 mm", "spheres": 5, "forms": 3, "count": 40, "rate": "300 1/s", "begin": "0.02 s",
     "from": ["-45 mm", "-45 mm", "180 mm"], "to": ["45 mm", "45 mm", "260 mm"], "velocity": [0, 0, -1]}],
  "outlets": [{"name": "drain", "from": [-0.2, -0.2, 0], "to": [0, 0.2, "14 mm"]}],
  "stop": {"time": "1 s"},
  "numerics": {"time_step": "60 us", "above_bound": "keep"}
})scene";

struct AtTheEnd {
    std::uint64_t state;
    std::vector<double> curve, energy;
    std::vector<std::int64_t> who;
};

AtTheEnd at_the_end(const ScenePlay& play) {
    report::Table curve = empty_scene_curve(play.model());
    report::Table energy = empty_scene_energy();
    sample_scene(play.model(), play.feed(), curve, energy);
    return {play.model().state_hash(), curve.rows.front(), energy.rows.front(), play.model().spheres.id};
}

} // namespace

TEST_CASE("checkpoint: a scene goes on to the same bits from any moment, whoever came and went", "[checkpoint]") {
    const TemporaryFolder folder;
    folder.write("turns.csv", "t,z,wz\n0,0,0\n0.1,0.01,20\n0.3,0,20\n");
    const Scene scene = read_scene(folder.file("scene.json", busy_scene), {});
    constexpr int steps = 5500;
    // The first steps, a step that lets particles in and the one after, just behind the sort after 4096 steps, and any.
    const std::vector<int> moments{1, 2, 64, 65, 700, 1500, 2049, 3333, 4097, 5499};

    ScenePlay whole(scene);
    std::vector<std::size_t> there;
    int pressed = 0; // steps in which something lay on the cushion
    for (int k = 1; k <= steps; ++k) {
        whole.step(k == steps);
        pressed += whole.model().walls.bodies[0].sums.reaction.isZero() ? 0 : 1;
        if (std::find(moments.begin(), moments.end(), k) != moments.end()) {
            save_checkpoint(folder.file(std::to_string(k)), "scene", [&](StateVisitor& visit) { whole.visit_state(visit); });
            there.push_back(whole.model().spheres.size());
        }
    }
    const AtTheEnd end = at_the_end(whole);
    // What there is to lose was there: members came and went between the moments, everything moved and was touched.
    CHECK(whole.feed().finished());
    CHECK(whole.feed().taken()[0] > 5);
    CHECK(whole.model().clusters.size() > 20);
    CHECK(there.front() < there[5]);
    CHECK(pressed > 100);
    CHECK(whole.model().walls.surfaces[1].sums.reaction.norm() > 0.0);
    CHECK(std::fabs(whole.model().ledger().relative_residual()) < 0.02);

    for (const int moment : moments) {
        INFO("kept after step " << moment);
        ScenePlay other(scene);
        load_checkpoint(folder.file(std::to_string(moment)), "scene", [&](StateVisitor& visit) { other.visit_state(visit); });
        other.restored();
        CHECK(other.model().steps() == moment);
        for (int k = moment + 1; k <= steps; ++k) {
            other.step(k == steps);
        }
        const AtTheEnd again = at_the_end(other);
        CHECK(again.state == end.state);
        CHECK(again.curve == end.curve);
        CHECK(again.energy == end.energy);
        CHECK(again.who == end.who);
    }
}
