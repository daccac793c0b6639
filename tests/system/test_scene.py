#!/usr/bin/env python3
"""The program from outside: particles that fall, pour and flow, surfaces that move, bad input."""
import json
import math
import pathlib
import re

from case import Case, main

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"

GRAIN = {"name": "grain", "material": {"card": "custom", "density": 2500, "young_modulus": "10 MPa", "elasticity": "as-given",
                                       "contact_law": "hertz", "contact_restitution": 0.4, "mu_d": 0.4, "rolling_friction": 0.02}}
BOX = {"name": "box", "shape": "box", "size": ["100 mm", "100 mm", "400 mm"], "position": [0, 0, "200 mm"]}
FALL = {"name": "grains", "size": "12 mm", "count": 60, "from": ["-49 mm", "-49 mm", "5 mm"], "to": ["49 mm", "49 mm", "390 mm"]}


def scene(**changes):
    out = {"scene": "a test", "materials": [GRAIN], "surfaces": [BOX], "particles": [FALL], "stop": {"time": 1.0, "rest": "1 mm/s"},
           "output": {"fields": 2, "samples": 50}}
    out.update(changes)
    return out


class Scenes(Case):
    def run_scene(self, content, *arguments, out="out", code=0):
        file = self.deck(content, "scene.json") if isinstance(content, dict) else content
        done = self.run_program("scene", file, "--out", out, "--quiet", *arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def text(self, name, content):
        (self.folder / name).write_text(content)

    def result(self, out="out"):
        return json.loads((self.folder / out / "summary.json").read_text())

    def curve(self, name="curve.csv", out="out"):
        return self.rows(self.folder / out / name)

    def test_spheres_come_to_rest_and_weigh_what_they_should(self):
        self.run_scene(scene(stop={"time": 2.0, "rest": "2 mm/s"}))
        summary = self.result()
        self.assertTrue(summary["stopped_by"].startswith("at rest"), summary["stopped_by"])
        self.assertEqual(summary["results"]["particles"]["value"], 60)
        mass = summary["results"]["mass"]["value"]
        self.assertAlmostEqual(mass, 60 * 2500 * math.pi / 6 * 0.012**3, delta=1e-9)
        # At rest the box carries the weight: what still moves is worth less than a hundredth of it.
        last = self.curve()[-1]
        self.assertAlmostEqual(float(last["box_force_z_N"]), -9.81 * mass, delta=0.02 * 9.81 * mass)
        self.assertTrue(summary["verdicts"]["Energy balance"]["good"], summary["verdicts"])
        for file in ("manifest.json", "energy.csv", "particles.csv", "report.html", "series.pvd", "fields/particles_0000.vtp",
                     "fields/surfaces_0000.vtp"):
            self.assertTrue((self.folder / "out" / file).is_file(), file)

    def test_bodies_may_be_alone_and_particles_no_faster_than_the_step(self):
        body = {"name": "block", "shape": "box", "size": ["50 mm", "50 mm", "50 mm"], "cells": [1, 1, 1], "young_modulus": "1 MPa", "density": 1000}
        late = dict(FALL, count=1, begin="0.8 ms")
        self.run_scene(scene(surfaces=[], bodies=[body], particles=[late], gravity=[0, 0, 0], stop={"time": 0.001}))
        self.assertEqual(self.result()["status"], "complete")
        done = self.run_scene(scene(particles=[dict(FALL, velocity=[0, 0, "-2000 m/s"])]), "--check", code=2)
        self.assertIn("/particles/0/velocity: found 2e+03 m/s", done.stderr)

    def test_same_bits_whatever_the_threads_and_from_the_manifest(self):
        stones = dict(FALL, name="stones", form="stone", count=20, size="20 mm", spheres=6, forms=3)
        content = scene(particles=[FALL, stones], stop={"time": 0.12})
        self.run_scene(content, "--threads", "1")
        self.run_scene(content, "--threads", "2", out="two")
        self.run_scene("out/manifest.json", out="again")
        hashes = {self.result(out=out)["final_state_hash"] for out in ("out", "two", "again")}
        self.assertEqual(len(hashes), 1)
        self.run_scene(content, "--set", "seed=2", out="other")
        self.assertNotIn(self.result(out="other")["final_state_hash"], hashes)

    def test_what_is_poured_arrives_and_what_reaches_the_outlet_goes(self):
        pour = {"name": "grains", "size": "10 mm", "count": 90, "rate": 200, "velocity": [0, 0, -1],
                "from": ["-40 mm", "-40 mm", "150 mm"], "to": ["40 mm", "40 mm", "200 mm"]}
        out = {"name": "floor", "from": [-0.1, -0.1, -0.1], "to": [0.1, 0.1, 0.01]}
        self.run_scene(scene(surfaces=[], particles=[pour], outlets=[out], stop={"time": 0.8}))
        rows = self.curve()
        early = [r for r in rows if 0.2 <= float(r["time_s"]) <= 0.3]
        # 200 a second come in, and each is on its way for (sqrt(1 + 2 g 0.165) - 1)/g = 0.107 s or so.
        for r in early:
            self.assertAlmostEqual(float(r["particles"]) + float(r["taken_out"]), 200 * float(r["time_s"]) + 1, delta=6)
            self.assertAlmostEqual(float(r["particles"]), 200 * 0.107, delta=9)
        self.assertEqual(self.result()["results"]["taken_floor"]["value"], 90)
        self.assertEqual(float(rows[-1]["particles"]), 0)
        self.assertTrue(self.result()["verdicts"]["Energy balance"]["good"])

    def test_a_servo_keeps_its_force_and_carries_no_more(self):
        plate = {"name": "plate", "shape": "plane", "size": ["99 mm", "99 mm"], "position": [0, 0, "395 mm"],
                 "motion": {"kind": "servo", "force": "30 N", "along": [0, 0, -2], "most_speed": "2 m/s", "begin": "0.25 s"}}
        self.run_scene(scene(surfaces=[BOX, plate], particles=[dict(FALL, count=120)], stop={"time": 0.9}))
        last = self.curve()[-5:]
        for r in last:
            self.assertAlmostEqual(float(r["plate_force_z_N"]), 30.0, delta=0.6)
        weight = 9.81 * self.result()["results"]["mass"]["value"]
        self.assertAlmostEqual(float(last[-1]["box_force_z_N"]), -30.0 - weight, delta=0.7)

    def test_surfaces_move_as_they_are_told(self):
        self.text("way.csv", "t,x,z\n0,0,0\n0.1,0.02,0\n0.2,0.02,-0.05\n")
        told = {
            "steady": {"kind": "velocity", "velocity": ["0.1 m/s", 0, 0]},
            "late": {"kind": "velocity", "velocity": ["0.1 m/s", 0, 0], "begin": "0.1 s", "end": "0.15 s"},
            "swings": {"kind": "expression", "velocity_y": "0.05*2*pi*10*cos(2*pi*10*t)"},
            "listed": {"kind": "table", "file": "way.csv"},
            "spun": {"kind": "velocity", "spin": [0, 0, "60 rpm"], "about": "point", "pivot": [0, 1, 5]},
        }
        far = [{"name": name, "shape": "plane", "size": [0.1, 0.1], "position": [0, 0, 5], "motion": motion} for name, motion in told.items()]
        self.run_scene(scene(surfaces=[BOX, *far], particles=[dict(FALL, count=3)], stop={"time": 0.225}))
        last = self.curve()[-1]
        at = {name: [float(last[f"{name}_at_{c}_m"]) for c in "xyz"] for name in told}
        t = float(last["time_s"])
        # A step, over which a surface keeps its velocity, is some 1e-5 s.
        self.assertAlmostEqual(at["steady"][0], 0.1 * t, delta=1e-5)
        self.assertAlmostEqual(at["late"][0], 0.005, delta=1e-5)
        self.assertAlmostEqual(at["swings"][1], 0.05, delta=2e-4)  # sin(2 pi 2.25) = 1
        self.assertAlmostEqual(at["listed"][0], 0.02, delta=1e-12)
        self.assertAlmostEqual(at["listed"][2], 5 - 0.05, delta=1e-12)
        self.assertEqual(at["spun"], [0, 1, 5])

    def test_stones_of_a_file_fill_a_box(self):
        # A tetrahedron.
        faces = ["0 2 1", "0 1 3", "1 2 3", "0 3 2"]
        self.text("stone.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" +
                   "".join("f " + " ".join(str(int(c) + 1) for c in f.split()) + "\n" for f in faces))
        stones = dict(FALL, form="file", file="stone.obj", size="20 mm", count=25, spheres=8)
        self.run_scene(scene(particles=[stones], stop={"time": 0.4}))
        self.assertEqual(self.result()["results"]["particles"]["value"], 25)
        self.assertEqual(len({r["particle"] for r in self.curve("particles.csv")}), 25)
        self.assertGreater(len(self.curve("particles.csv")), 25 * 4)
        mass = self.result()["results"]["mass"]["value"]
        self.assertAlmostEqual(mass, 25 * 2500 * math.pi / 6 * 0.02**3, delta=1e-6 * mass)

    def test_a_graded_filling_grows_without_overlaps(self):
        sieve = [{"diameter": "5 mm", "passing": 0}, {"diameter": "10 mm", "passing": 0.6}, {"diameter": "18 mm", "passing": 1}]
        grown = dict(FALL, place="grow", count=300, grading=sieve, **{"from": ["-40 mm", "-40 mm", "0"], "to": ["40 mm", "40 mm", "80 mm"]})
        content = scene(gravity=[0, 0, 0], surfaces=[], particles=[grown], stop={"time": 0.02})
        self.run_scene(content)
        rows = self.curve()
        self.assertLess(float(rows[0]["largest_overlap"]), 0.05)
        self.assertEqual(float(rows[-1]["particles"]), 300)
        self.assertTrue(self.result()["verdicts"]["Energy balance"]["good"])
        # Sizes come to where they were packed: the mass is that of the sieve curve's spheres.
        volume = sum(4 / 3 * math.pi * float(r["radius_m"])**3 for r in self.rows(self.folder / "out" / "particles.csv"))
        self.assertAlmostEqual(self.result()["results"]["mass"]["value"] / (2500 * volume), 1.0, delta=1e-9)
        # Too many are refused with how many would do, and so many do.
        grown["count"] = 3000
        done = self.run_scene(content, code=2)
        self.assertIn("/particles/0/count", done.stderr)
        fits = int(re.search(r"at most about (\d+)", done.stderr).group(1))
        grown["count"] = int(0.97 * fits)
        self.run_scene(content, "--check")

    def test_soft_particles_are_warned_of(self):
        soft = dict(GRAIN, material=dict(GRAIN["material"], young_modulus="100 kPa"))
        self.run_scene(scene(materials=[soft], stop={"time": 0.4}))
        found = self.result()
        self.assertGreater(found["results"]["largest_overlap"]["value"], 0.05)
        self.assertIn("largest overlap", " ".join(found["warnings"]).lower())

    def test_what_is_likely_to_lack_its_unit_is_warned_of(self):
        far = dict(BOX, name="far", position=[0, 0, 200])
        done = self.run_scene(scene(surfaces=[BOX, far], materials=[dict(GRAIN, material=dict(GRAIN["material"], density=2.5))]), "--check")
        for path in ("/surfaces/1/position/2: 200 m is likely", "/materials/0/material/density: 2.5 kg/m3 is likely"):
            self.assertIn(path, done.stderr)

    def test_what_cannot_fit_and_decimal_commas_are_refused_at_once(self):
        filled = dict(FALL, place="grow", count=20000)
        plate = {"name": "plate", "shape": "plane", "motion": {"kind": "expression", "velocity_z": "0,1*t"}}
        done = self.run_scene(scene(surfaces=[BOX, plate]), "--check", code=2)
        self.assertIn("decimals have a point", done.stderr)
        self.assertIn("/surfaces/1/size: found no size", done.stderr)
        done = self.run_scene(scene(particles=[filled]), "--check", code=2)
        self.assertIn("the densest packing fills", done.stderr)

    def test_a_time_without_end_is_refused(self):
        done = self.run_scene(scene(stop={"time": 1e9}), code=2)
        self.assertIn("/stop/time", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_grown_particles_leave_out_what_stands_in_the_way(self):
        ball = {"name": "ball", "shape": "sphere", "radius": "30 mm", "position": [0, 0, "100 mm"]}
        grown = dict(FALL, place="grow", count=400, to=["49 mm", "49 mm", "190 mm"])
        self.run_scene(scene(surfaces=[BOX, ball], particles=[grown], stop={"time": 0.01}))
        warnings = " ".join(self.result()["warnings"])
        self.assertIn("would have reached into a surface", warnings)

    def test_an_interrupt_leaves_a_partial_result(self):
        file = self.deck(scene(stop={"time": 1000}, output={"samples": 1000000, "fields": 1}), "scene.json")
        self.interrupt(self.start("scene", file, "--out", "out", "--quiet", until="out/manifest.json"))
        self.assertEqual(self.result()["status"], "interrupted")
        self.assertIn("partial", " ".join(self.result()["warnings"]))

    def test_every_problem_is_said_at_once(self):
        bad = scene(
            surfaces=[{"name": "a b", "shape": "helix", "radius": "1 cm", "pitch": 0, "height": "1 cm", "frictoin": 1},
                      {"name": "s", "shape": "file", "file": "none.stl"},
                      {"name": "s", "shape": "sphere", "motion": {"kind": "expression", "velocity_x": "2*"}},
                      {"name": "v", "shape": "plane", "size": [1, 1, 1], "material": "gain",
                       "motion": {"kind": "servo", "force": "1 kN", "along": [0, 0, 0], "most_speed": 1}}],
            particles=[dict(FALL, to=["49 mm", "-50 mm", "390 mm"], grading=[{"diameter": 0.01, "passing": 0.2}])])
        done = self.run_scene(bad, code=2)
        said = done.stdout + done.stderr
        for path in ("/surfaces/0/name", "/surfaces/0/pitch", "/surfaces/0/frictoin", "/surfaces/1/file", "/surfaces/2/name",
                     "/surfaces/2/radius", "/surfaces/2/motion/velocity_x", "/surfaces/3/size", "/surfaces/3/material",
                     "/surfaces/3/motion/along", "/particles/0/to/1", "/particles/0/grading/0"):
            self.assertIn(path, said)
        self.assertIn('did you mean "grain"?', said)
        self.assertIn('"friction"', said)
        self.assertFalse((self.folder / "out").exists())

    def test_surfaces_that_cannot_be_used_are_refused_and_open_ones_told_of(self):
        self.text("empty.stl", "solid nothing\nendsolid nothing\n")
        done = self.run_scene(scene(surfaces=[{"name": "s", "shape": "file", "file": "empty.stl"}]), "--check", code=2)
        self.assertIn("no faces", done.stdout + done.stderr)
        triangle = "solid t\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n"
        self.text("open.stl", triangle)
        self.run_scene(scene(surfaces=[{"name": "s", "shape": "file", "file": "open.stl"}], stop={"time": 0.05}))
        self.assertIn("open", " ".join(self.result()["warnings"]))
        done = self.run_scene(scene(particles=[dict(FALL, form="file", file="open.stl")]), "--check", code=2)
        self.assertIn("/particles/0/file", done.stdout + done.stderr)

    def test_a_step_above_the_stable_one_is_refused(self):
        grown = dict(FALL, place="grow", count=500, to=["49 mm", "49 mm", "120 mm"])
        done = self.run_scene(scene(particles=[grown], numerics={"time_step": "50 ms"}), code=3)
        self.assertIn("stable", done.stdout + done.stderr)

    def test_a_surface_that_would_pass_through_particles_is_refused_or_ends_the_run(self):
        ram = {"name": "ram", "shape": "plane", "size": [0.1, 0.1], "position": [0, 0, 0.3],
               "motion": {"kind": "velocity", "velocity": [0, 0, "-300 m/s"]}}
        done = self.run_scene(scene(surfaces=[BOX, ram]), "--check", code=2)
        self.assertIn("/surfaces/1/motion: found 300 m/s", done.stderr)
        # So short that it is seen only as it comes: a scene is looked at in advance at a thousand moments, a millisecond apart here.
        ram["motion"] = {"kind": "expression", "velocity_z": "t > 0.0052 && t < 0.0057 ? -300 : 0"}
        self.run_scene(scene(surfaces=[BOX, ram], stop={"time": 1}), "--check")
        done = self.run_scene(scene(surfaces=[BOX, ram], stop={"time": 1}), code=3)
        self.assertIn('surface "ram" goes', done.stdout + done.stderr)
        self.assertEqual(self.result()["status"], "failed")
        # It would fail again, and its checkpoint knows nothing of the failure.
        for command in ("resume", "report"):
            refused = self.run_program(command, "out", "--quiet")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("a calculation that failed", refused.stderr)
        self.assertEqual(self.result()["status"], "failed")

    def test_examples_have_no_problems(self):
        for name in ("mixer", "silo", "ballast"):
            done = self.run_program("scene", EXAMPLES / f"{name}.json", "--check")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)



if __name__ == "__main__":
    main()
