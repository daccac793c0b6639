#!/usr/bin/env python3
"""The program from outside: what is killed or interrupted goes on to the same bytes.

PROVETA_KILLS sets the number of random kills. The long tier takes 100, and kills every test; tests/verification/resume.cpp and
resume_scene.cpp go on with everything at each commit, within one process."""
import json
import os
import random
import shutil
import signal
import subprocess
import time

from case import main
from reliable import BODY, Reliability

KILLS = int(os.environ.get("PROVETA_KILLS", "8"))
INTERVAL = 0.2  # s between checkpoints
TESTS = {
    "ucs": {"test": "ucs", "specimen": BODY, "loading": {"cycles": [{"axial_strain": 0.0004}], "rate_check": "half_rate"}},
    "girth": {"test": "ucs", "specimen": BODY, "loading": {"control": "girth", "stop": {"axial_strain": 0.003}}},
    "triaxial": {"test": "triaxial", "specimen": BODY, "loading": {"confining_pressure": "2 MPa"}},
    "membrane": {"test": "triaxial", "specimen": BODY,
                 "loading": {"confining_pressure": "2 MPa", "confinement": "membrane", "rate": "0.5 m/s", "stop": {"axial_strain": 0.004}}},
    "brazilian": {"test": "brazilian", "specimen": {"shape": "disc", "diameter": "50 mm", "height": "25 mm", "spheres": 500}},
    "oedometric": {"test": "oedometric", "specimen": BODY, "loading": {"stop": {"axial_strain": 0.01}}},
    "hydrostatic": {"test": "hydrostatic", "specimen": BODY, "loading": {"pressure": "60 MPa"}},
    "direct-tension": {"test": "direct-tension", "specimen": BODY},
    "granular-triaxial": {"test": "granular-triaxial",
                          "specimen": {"diameter": "120 mm", "height": "240 mm", "seed": 3,
                                       "particles": {"form": "stone", "size": "30 mm", "spheres": 5, "forms": 4}},
                          "loading": {"confining_pressure": "60 kPa", "rate": "0.4 m/s", "stop": {"axial_strain": 0.02}}},
}


def killed_at_each_commit(name):
    return KILLS > 50 or name in ("ucs", "membrane", "granular-triaxial")


class Killed(Reliability):
    def started(self, *arguments):
        return self.start(*arguments, until=".")

    def kill(self, process, after):
        """Waits so many seconds, kills; True when the process lived so long."""
        try:
            out, log = process.communicate(timeout=after)
            self.assertEqual(process.returncode, 0, out + log)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.communicate()
            return True

    def test_every_test_goes_on_to_the_same_bytes(self):
        for name, deck in TESTS.items():
            if not killed_at_each_commit(name):
                continue
            with self.subTest(name):
                path = self.deck({**deck, "output": {"samples": 100, "fields": 3, "pictures": 0, "checkpoint_every": 0.05}}, name + ".json")
                whole, part = name + "-whole", name + "-part"
                begun = time.monotonic()
                done = self.run_program("run", path, "--out", whole, "--quiet", "--threads", 2)
                self.assertEqual(done.returncode, 0, done.stderr)
                seconds = time.monotonic() - begun
                for share in (0.6, 0.4, 0.2, 0.05, 0.0):  # killed too late on a machine that has become faster: again, earlier
                    shutil.rmtree(self.folder / part, ignore_errors=True)
                    process = self.start("run", path, "--out", part, "--quiet", "--threads", 1, until=part + "/checkpoint.h5")
                    if self.kill(process, share * seconds) and self.status(part) == "running":
                        break
                self.assertEqual(self.status(part), "running")
                resumed = self.run_program("resume", part, "--quiet", "--threads", 2)
                self.assertEqual(resumed.returncode, 0, resumed.stderr)
                self.assertSame(part, whole)
                self.assertEqual(self.status(part), "complete")
                self.assertEqual(len(json.loads(self.content(part, "manifest.json"))["resumed"]), 1)
                again = self.run_program("resume", part)
                self.assertEqual(again.returncode, 0)
                self.assertIn("complete", again.stdout)

    def test_kills_at_random_moments_lose_at_most_the_interval(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "spheres": 1500},
                          "output": {"samples": 100, "fields": 5, "pictures": 300, "checkpoint_every": INTERVAL}})
        begun = time.monotonic()
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        seconds = time.monotonic() - begun
        chance = random.Random(12345)
        kills = ends = 0
        lost = []
        while kills < KILLS:
            out = f"out{ends}"
            # Killed several times before it ends, now and then before it has begun.
            begun = (self.folder / out / "manifest.json").exists()
            command = ["resume", out] if begun else ["run", deck, "--out", out]
            if not self.kill(self.started(*command, "--quiet"), chance.uniform(0.0, 0.5 * seconds)):
                self.assertSame(out, "whole")
                ends += 1
                continue
            kills += 1
            now = time.time()
            self.assertWhole(out)
            kept = [p.stat().st_mtime for p in (self.folder / out).glob("checkpoint*.h5")]
            self.assertLessEqual(len(kept), 2)
            if kept:
                lost.append(now - max(kept))
        last = f"out{ends}"
        if (self.folder / last / "manifest.json").exists():
            done = self.run_program("resume", last, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSame(last, "whole")
        print(f"{kills} kills, {ends} tests ended in between; median age of the last checkpoint "
              f"{sorted(lost)[len(lost) // 2] if lost else float('nan'):.2f} s")

    def test_a_series_a_sweep_and_a_series_of_interrupts(self):
        series = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2, 3]}, "output": {"fields": 0, "pictures": 0, "checkpoint_every": 0.1}})
        self.assertEqual(self.run_program("run", series, "--out", "whole", "--quiet").returncode, 0)
        process = self.start("run", series, "--out", "part", "--quiet", until="part/manifest.json")
        self.kill(process, 1.0)
        for _ in range(20):
            process = self.started("resume", "part", "--quiet")
            if not self.kill(process, 1.5):
                break
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ["series.csv", "summary.json"]:
            self.assertEqual(self.content("part", name), self.content("whole", name), name)


TRIANGLES = [((-1, -1), (1, -1), (1, 1)), ((-1, -1), (1, 1), (-1, 1))]


class Scenes(Reliability):
    def floor(self, height=0.0):
        facets = ["facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {x} {y} {height}\n" for x, y in t) + "endloop\nendfacet\n" for t in TRIANGLES]
        (self.folder / "floor.stl").write_text("solid floor\n" + "".join(facets) + "endsolid floor\n")

    def scene(self):
        self.floor()
        material = {"card": "custom", "density": 2500, "young_modulus": "5 MPa", "elasticity": "as-given", "contact_law": "hertz",
                    "contact_restitution": 0.4, "mu_d": 0.4}
        poured = {"size": "12 mm", "from": ["-60 mm", "-60 mm", "0.2 m"], "to": ["60 mm", "60 mm", "0.4 m"], "velocity": [0, 0, -1]}
        return self.deck({
            "scene": "poured on a floor and swept off", "materials": [{"name": "grain", "material": material}],
            "surfaces": [{"name": "floor", "shape": "file", "file": "floor.stl", "scale": 0.1},
                         {"name": "broom", "shape": "plane", "size": ["0.3 m", "0.3 m"], "turned": [0, "90 deg", 0],
                          "position": ["-0.11 m", 0, "0.16 m"], "motion": {"kind": "velocity", "velocity": ["0.3 m/s", 0, 0], "begin": "0.2 s"}}],
            "particles": [{**poured, "name": "grains", "count": 300, "rate": 1000},
                          {**poured, "name": "stones", "form": "stone", "spheres": 6, "forms": 3, "count": 60, "rate": 200, "begin": 0.05}],
            "outlets": [{"name": "below", "from": [-1, -1, -1], "to": [1, 1, "-5 cm"]}],
            "stop": {"time": 0.6}, "output": {"samples": 60, "fields": 6, "checkpoint_every": 0.05}}, "scene.json")

    def test_a_scene_goes_on_to_the_same_bytes_killed_or_interrupted(self):
        scene = self.scene()
        begun = time.monotonic()
        done = self.run_program("scene", scene, "--out", "whole", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        seconds = time.monotonic() - begun
        results = json.loads(self.content("whole", "summary.json"))["results"]
        self.assertGreater(results["taken_below"]["value"], 20)
        chance = random.Random(7)
        process = self.start("scene", scene, "--out", "part", "--quiet", until="part/checkpoint.h5")
        stops = 0
        for number in (signal.SIGKILL, signal.SIGINT, signal.SIGKILL, signal.SIGTERM, signal.SIGKILL):
            time.sleep(chance.uniform(0.0, 0.2 * seconds))
            process.send_signal(number)
            process.communicate()
            if process.returncode == 0:
                break  # it was faster
            stops += 1
            self.assertWhole("part")
            self.assertNotEqual(self.status("part"), "complete")
            process = self.start("resume", "part", "--quiet", until="part/checkpoint.h5")
        process.communicate()
        self.assertEqual(process.returncode, 0)
        self.assertGreaterEqual(stops, 2)
        self.assertSame("part", "whole")
        self.assertEqual(self.status("part"), "complete")
        again = self.run_program("resume", "part")
        self.assertIn("nothing to go on with", again.stdout)

    def test_a_scene_is_reported_anew_and_knows_its_files(self):
        scene = self.scene()
        process = self.start("scene", scene, "--out", "part", until="part/checkpoint.h5")
        process.send_signal(signal.SIGINT)
        _, log = process.communicate()
        self.assertEqual(process.returncode, 130, log)
        self.assertIn("proveta resume part", log)
        shutil.copytree(self.folder / "part", self.folder / "copy")
        self.assertIn(self.run_program("report", "copy", "--quiet").returncode, (0, 130))
        self.assertSame("copy", "part")
        self.floor(0.01)
        for command in (["resume", "part"], ["scene", "part/manifest.json", "--out", "other"]):
            refused = self.run_program(*command, "--quiet")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("floor.stl, whose hash is", refused.stderr)
        self.assertFalse((self.folder / "other").exists())
        self.floor()
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        before = self.content("part", "summary.json")
        self.assertEqual(self.run_program("report", "part", "--quiet").returncode, 0)
        self.assertEqual(self.content("part", "summary.json"), before)


class Signals(Reliability):
    def test_interrupts_end_with_a_partial_result_that_goes_on(self):
        deck = self.deck({"test": "ucs", "specimen": BODY, "output": {"checkpoint_every": 0}})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        for number, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]:
            shutil.rmtree(self.folder / "part", ignore_errors=True)
            process = self.start("run", deck, "--out", "part", until="part/fields")
            process.send_signal(number)
            out, log = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code, log)
            self.assertIn("proveta resume part", log)
            self.assertEqual(self.status("part"), "interrupted")
            self.assertWhole("part")
            self.assertIn("interrupted", self.content("part", "report.html").decode())
            done = self.run_program("resume", "part", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSame("part", "whole")

    def test_any_number_of_signals_loses_nothing(self):
        """Terminals, schedulers and parents send several; the first counts, and the rest must not end what it asked for."""
        deck = self.deck({"test": "ucs", "specimen": BODY, "output": {"checkpoint_every": 0}})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        for pause in (0.0, 0.01):
            for numbers, code in (((signal.SIGTERM, signal.SIGTERM), 143), ((signal.SIGINT,) * 4, 130)):
                shutil.rmtree(self.folder / "part", ignore_errors=True)
                process = self.start("run", deck, "--out", "part", until="part/fields")
                for number in numbers:
                    process.send_signal(number)
                    time.sleep(pause)
                _, log = process.communicate(timeout=60)
                self.assertEqual(process.returncode, code, log)
                self.assertEqual(self.status("part"), "interrupted")
                self.assertWhole("part")
                self.assertEqual(self.run_program("resume", "part", "--quiet").returncode, 0)
                self.assertSame("part", "whole")


if __name__ == "__main__":
    main()
