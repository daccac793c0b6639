#!/usr/bin/env python3
"""The pages of results in a browser: what a reader sees, does, and must not be exposed to."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from case import Case, main
from small_sweep import sweep
from test_calibrate import calibration
from test_scene import scene

CHROMIUM = os.environ.get("PROVETA_CHROMIUM") or shutil.which("chromium")
MODULES = os.environ.get("PROVETA_NODE_MODULES", "")
HOSTILE = "</script><script>window.hacked=1</script><img src=x onerror=\"window.hacked=1\"> ' & \" <b>"
DECK = {
    "test": "ucs",
    "specimen": {"diameter": "50 mm", "height": "100 mm", "spheres": 500},
    "material": {"elasticity": "as-given"},
    "loading": {"rate": "0.4 m/s"},
    "output": {"samples": 80, "fields": 1},
}


def first_of(page):
    """Numbers of the cursor's lines: name, then x and y."""
    return [(row[0], float(row[1]), float(row[2])) for row in page]


class Pages(Case):
    def setUp(self):
        if not CHROMIUM:
            self.skipTest("no chromium (packages.txt names it)")
        if not (pathlib.Path(MODULES) / "playwright-core").is_dir():
            self.skipTest("PROVETA_NODE_MODULES has no playwright-core (bootstrap.sh installs it and sets this)")
        super().setUp()

    def look(self, page, csv=None):
        command = ["node", str(pathlib.Path(__file__).with_name("pages.mjs")), str(page)] + ([str(csv)] if csv else [])
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, env={**os.environ, "PROVETA_CHROMIUM": CHROMIUM})
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.check(found)
        return found

    def check(self, found):
        """What holds for every page."""
        self.assertEqual(found["errors"], [])
        self.assertEqual(found["requests"], [])
        self.assertLess(found["bytes"], 2e6)
        self.assertEqual(found["contrast"]["low"], [])
        self.assertLessEqual(found["width"], 1200)
        self.assertLessEqual(found["phone"]["width"], 390)
        self.assertEqual(found["printed"], 0)
        for seen in (found["structure"], found["phone"]):
            self.assertEqual(seen["lang"], "en")
            self.assertTrue(seen["title"])
            self.assertEqual(seen["mains"], 1)
            self.assertEqual((seen["nameless"], seen["uncaptioned"], seen["unscoped"]), (0, 0, 0))
            self.assertEqual(seen["levels"][0], 1)
            self.assertEqual(seen["levels"].count(1), 1)
            self.assertTrue(all(b - a <= 1 for a, b in zip(seen["levels"], seen["levels"][1:])), seen["levels"])
            self.assertGreaterEqual(seen["smallest"], 11.5)
            self.assertEqual(seen["hacked"], "no")

    def agree(self, cursor, rows):
        """Each line of the cursor is a row of curve.csv."""
        columns = {"platens": "axial_strain", "middle gauge": "gauge_axial_strain", "circumferential": "circumferential_strain"}
        for name, x, y in first_of(cursor):
            row = min(rows, key=lambda r: abs(1e-6 * float(r["axial_stress_Pa"]) - y) + 1e3 * abs(100 * float(r[columns[name]]) - x))
            self.assertAlmostEqual(x, 100 * float(row[columns[name]]), delta=6e-5 * abs(x) + 1e-9)
            self.assertAlmostEqual(y, 1e-6 * float(row["axial_stress_Pa"]), delta=6e-5 * abs(y) + 1e-9)

    def test_the_page_of_a_run_answers_its_reader(self):
        deck = self.deck({**DECK, "title": HOSTILE})
        done = self.run_program("run", deck, "--out", "r")
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.folder / "r"
        found = self.look(out / "report.html", out / "curve.csv")
        self.assertEqual(found["structure"]["title"], HOSTILE)
        plot = found["plot"]
        rows = self.rows(out / "curve.csv")
        self.assertGreaterEqual(len(plot["hover"]), 1)
        self.agree(plot["hover"], rows)
        self.assertEqual(plot["crosshairs"], 2)
        self.assertEqual(plot["unfocused"], plot["ticks"])
        for changed in ("wheeled", "dragged"):
            self.assertNotEqual(plot[changed], plot["ticks"])
        for whole in ("reset", "zeroed"):
            self.assertEqual(plot[whole], plot["ticks"])
        self.agree(plot["keyed"], rows)
        name, x, y = first_of(plot["keyed"])[0]
        self.assertAlmostEqual(x, 100 * float(rows[2]["axial_strain"]), delta=1e-5)
        self.assertIn(name, plot["said"])
        self.assertEqual((plot["fewer"], plot["again"]), (plot["lines"] - 1, plot["lines"]))
        self.assertGreater(plot["overlaid"], len(rows) // 2)
        self.assertEqual(plot["columns"], ["axial_strain", "axial_stress_Pa"])
        self.assertEqual([float(f) for f in plot["factors"]], [100.0, 1e-6])

    def test_doubts_stand_on_page_terminal_and_summary(self):
        """A soft network, and an unloading from the peak, which is no fall past it."""
        deck = self.deck({**DECK, "bonding": {"coordination": 8}, "material": {"card": "concrete_sfer"},
                          "loading": {"rate": "0.4 m/s", "cycles": [{"axial_strain": 0.0019, "unload_to": 0.1}]}})
        done = self.run_program("run", deck, "--out", "d", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "d" / "report.html").read_text()
        summary = json.loads((self.folder / "d" / "summary.json").read_text())
        doubt = [w for w in summary["warnings"] if w.startswith("8.0 bonds a sphere")]
        self.assertEqual(len(doubt), 1, summary["warnings"])
        self.assertIn(doubt[0].split(",")[0], page)
        self.assertIn("warning: " + doubt[0], done.stdout)
        past = re.search(r"20 % past the peak, strain ([0-9.]+) %", page)
        self.assertGreater(float(past[1]), 100 * summary["results"]["strain_at_peak"]["value"])
        self.assertIn("Wall time", page)
        self.assertIn("m\u00b2", page)

    def test_the_page_of_a_study_is_for_people(self):
        done = self.run_program("study", "rate", self.deck({**DECK, "specimen": {**DECK["specimen"], "spheres": 300}}), "--out", "y", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "y" / "report.html").read_text()
        self.assertIsNone(re.search(r"<td[^>]*>[0-9.]+e\+[0-9]+", page))
        self.assertIn("Compressive strength at rate 0", page[:page.index("<nav")])
        self.look(self.folder / "y" / "report.html")

    def test_an_imported_mesh_is_named(self):
        spheres = "\n".join(f"{x} {y} {z} 5" for x in range(5, 50, 10) for y in range(5, 50, 10) for z in range(5, 100, 10))
        (self.folder / "mesh.csv").write_text("x y z r\n" + spheres + "\n")
        done = self.run_program("specimen", "import", "mesh.csv", "s.h5", "--scale", "0.001", "--shape", "prism")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_program("run", self.deck({**DECK, "specimen": {"file": "s.h5"}}), "--out", "m", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("imported from mesh.csv (axis z), stored as s.h5", (self.folder / "m" / "report.html").read_text())

    def test_the_page_of_a_series(self):
        deck = self.deck({**DECK, "title": HOSTILE, "specimen": {**DECK["specimen"], "spheres": 300, "seed": [1, 2]}})
        done = self.run_program("run", deck, "--out", "s")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.look(self.folder / "s" / "report.html")

    def test_the_page_of_a_sweep(self):
        done = self.run_program("sweep", self.deck(sweep(title=HOSTILE), "sweep.json"), "--out", "w")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.look(self.folder / "w" / "report.html")

    def test_the_page_of_a_calibration(self):
        content = calibration(title=HOSTILE, search={"spheres": 0.5, "trials": 4, "batch": 4}, finish={"rounds": 1, "trials": 2}, confidence={"seeds": 2})
        done = self.run_program("calibrate", self.deck(content, "calibration.json"), "--out", "c")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.look(self.folder / "c" / "report.html")

    def test_the_page_of_a_scene(self):
        content = scene(scene=HOSTILE)
        done = self.run_program("scene", self.deck(content, "scene.json"), "--out", "n", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.look(self.folder / "n" / "report.html")


if __name__ == "__main__":
    main()
