#!/usr/bin/env python3
"""The program from outside: sweeps."""
import json
import math
import signal
import time

from case import Case, main
from small_sweep import DECK, PARAMETERS, sweep


class Sweep(Case):
    FILES = ["manifest.json", "ledger.jsonl", "table.csv", "table.h5", "failures.csv", "sensitivity.csv", "curve_sensitivity.csv",
             "summary.json", "report.html"]

    def file(self, name="sweep.json", **changes):
        return self.deck(sweep(**changes), name)

    def ledger(self, out):
        return (self.folder / out / "ledger.jsonl").read_bytes().splitlines(keepends=True)

    def test_a_sweep_end_to_end(self):
        disc = {"test": "brazilian", "specimen": {"diameter": "50 mm", "height": "30 mm", "spheres": 300}}
        tests = [{"name": "press", "deck": {}}, {"name": "split", "deck": disc, "seeds": [1, 2]}]
        file = self.file(deck=DECK, tests=tests, design="latin_hypercube", points=4)
        done = self.run_program("sweep", file, "--out", "s", "--threads", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.folder / "s"
        for name in self.FILES:
            self.assertTrue((out / name).is_file(), name)
        self.assertFalse(list(out.rglob("*.partial")))
        rows = self.rows(out / "table.csv")
        self.assertEqual([r["point"] for r in rows], ["1", "2", "3", "4"])
        for name, low, high in [("tau_f_Pa", 10e6, 20e6), ("sigma_f_Pa", 2e6, 5e6)]:
            strata = sorted(int(4 * (float(r[name]) - low) / (high - low)) for r in rows)
            self.assertEqual(strata, [0, 1, 2, 3], name)
        for row in rows:
            self.assertEqual(row["status"], "complete")
            trial = out / "trials" / row["trial"]
            jobs = {f.parent.name: json.loads(f.read_text()) for f in trial.glob("*/result.json")}
            self.assertEqual(sorted(jobs), ["press_seed_1", "split_seed_1", "split_seed_2"])
            self.assertEqual(float(row["press.strength_Pa"]), jobs["press_seed_1"]["results"]["strength"])
            a, b = (jobs[f"split_seed_{seed}"]["results"]["splitting_strength"] for seed in (1, 2))
            self.assertAlmostEqual(float(row["split.splitting_strength_Pa"]), (a + b) / 2, delta=1e-6 * a)
            self.assertAlmostEqual(float(row["split.splitting_strength_deviation_Pa"]), abs(a - b) / math.sqrt(2), delta=1e-6 * a)
            deck = json.loads((trial / "press_seed_1" / "deck.json").read_text())
            self.assertEqual(deck["material"]["tau_f"], float(row["tau_f_Pa"]))
        self.assertNotIn("press.strength_deviation_Pa", rows[0])
        sensitivity = self.rows(out / "sensitivity.csv")
        self.assertEqual({(r["test"], r["parameter"]) for r in sensitivity}, {(t, p) for t in ("press", "split") for p in ("tau_f", "sigma_f")})
        along = self.rows(out / "curve_sensitivity.csv")
        self.assertEqual({r["test"] for r in along}, {"press", "split"})
        self.assertEqual({r["y_column"] for r in along}, {"axial_stress_Pa"})
        self.assertEqual(self.rows(out / "failures.csv"), [])
        page = (out / "report.html").read_text()
        self.assertIn("who shapes what part of the curve", page)
        self.assertNotIn("https://", page)
        self.assertFalse("nan" in page.split("</style>")[1].rsplit("<script>", 1)[0].lower().replace("dominant", "").replace("provenance", ""))

        again = self.run_program("sweep", "s/manifest.json", "--out", "again", "--quiet", "--threads", 1)
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        for name in ["table.csv", "sensitivity.csv", "curve_sensitivity.csv", "failures.csv"]:
            self.assertEqual((out / name).read_bytes(), (self.folder / "again" / name).read_bytes(), name)
        ledger = self.ledger("s")
        self.assertEqual(self.run_program("sweep", file, "--out", "s", "--quiet").returncode, 0)
        self.assertEqual(self.ledger("s"), ledger)  # nothing was left to do
        state = self.run_program("sweep", file, "--out", "s", "--status").stdout
        self.assertIn("4 of 4 points done, 12 of 12 tests", state)
        self.assertIn("no failures", state)

    def test_a_point_that_fails_keeps_its_row_and_says_why(self):
        steps = {"path": "numerics.time_step", "values": ["1e-7 s", "2e-5 s"]}
        strengths = {**PARAMETERS[0], "levels": 2}
        done = self.run_program("sweep", self.file(parameters=[steps, strengths], design="grid", results=["strength"]), "--out", "s")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows(self.folder / "s" / "table.csv")
        self.assertEqual([(float(r["time_step_s"]), float(r["tau_f_Pa"]), r["status"]) for r in rows],
                         [(1e-7, 10e6, "complete"), (1e-7, 20e6, "complete"), (2e-5, 10e6, "failed"), (2e-5, 20e6, "failed")])
        self.assertEqual([r["press.strength_Pa"] == "" for r in rows], [False, False, True, True])
        self.assertGreater(float(rows[1]["press.strength_Pa"]), float(rows[0]["press.strength_Pa"]))
        self.assertEqual([name for name in rows[0] if name.startswith("press.")], ["press.strength_Pa"])
        failures = self.rows(self.folder / "s" / "failures.csv")
        self.assertEqual([(f["point"], f["trial"], f["job"]) for f in failures], [("3", rows[2]["trial"], "press_seed_1"), ("4", rows[3]["trial"], "press_seed_1")])
        self.assertIn("stable step", failures[0]["reason"])
        self.assertIn("2 failed", done.stdout)

    def test_a_killed_sweep_goes_on_where_it_was(self):
        file = self.file(points=8)
        whole = self.run_program("sweep", file, "--out", "whole", "--quiet", "--threads", 1)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        process = self.start("sweep", file, "--out", "r", "--quiet", "--threads", "1", until="r/ledger.jsonl")
        end = time.monotonic() + 60
        while len(self.ledger("r")) < 2 and time.monotonic() < end:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=60)
        before = [line for line in self.ledger("r") if line.endswith(b"\n")]
        self.assertTrue(2 <= len(before) < 8, len(before))
        self.assertFalse((self.folder / "r" / "table.csv").exists())
        with open(self.folder / "r" / "ledger.jsonl", "ab") as ledger:
            ledger.write(b'{"trial": "half a li')  # what a killed process may leave
        done = self.run_program("sweep", file, "--out", "r", "--quiet", "--threads", 2)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        after = self.ledger("r")
        self.assertEqual(after[:len(before)], before)
        self.assertEqual((len(after), len({json.loads(line)["trial"] for line in after})), (8, 8))
        for name in ["table.csv", "sensitivity.csv", "curve_sensitivity.csv"]:
            self.assertEqual((self.folder / "whole" / name).read_bytes(), (self.folder / "r" / name).read_bytes(), name)

    def test_an_interrupt_says_how_to_go_on(self):
        file = self.file(points=64)
        process = self.start("sweep", file, "--out", "r", "--threads", "2", until="r/trials")
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, log = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, log)
        self.assertIn("the same command goes on", log)
        self.assertEqual(json.loads((self.folder / "r" / "manifest.json").read_text())["status"], "interrupted")
        self.assertFalse((self.folder / "r" / "table.csv").exists())

    def test_planned_trials_are_collected(self):
        file = self.file(points=3, design="sobol")
        planned = self.run_program("sweep", file, "--out", "s", "--plan", "--quiet")
        self.assertEqual(planned.returncode, 0, planned.stderr)
        self.assertIn("3 trials planned", planned.stdout)
        missing = self.run_program("sweep", file, "--out", "s", "--collect", "--quiet")
        self.assertEqual(missing.returncode, 3)
        self.assertIn("3 of 3 points are missing", missing.stdout)
        self.assertEqual(self.run_program("trial", "--list", "s/trials.txt").returncode, 0)
        ledger = self.ledger("s")
        self.assertIn("3 of 3 points done", self.run_program("sweep", file, "--out", "s", "--status").stdout)
        self.assertEqual(self.ledger("s"), ledger)  # --status has changed nothing
        collected = self.run_program("sweep", file, "--out", "s", "--collect", "--quiet")
        self.assertEqual(collected.returncode, 0, collected.stderr)
        self.assertEqual(self.run_program("sweep", file, "--out", "here", "--quiet").returncode, 0)
        self.assertEqual((self.folder / "s" / "table.csv").read_bytes(), (self.folder / "here" / "table.csv").read_bytes())

    def test_morris(self):
        inert = {"path": "output.samples", "low": 60, "high": 63}
        done = self.run_program("sweep", self.file(design="morris", points=2, parameters=[PARAMETERS[0], inert], results=["strength"]), "--out", "m", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = self.rows(self.folder / "m" / "table.csv")
        self.assertEqual(len(rows), 6)
        effects = {r["parameter"]: r for r in self.rows(self.folder / "m" / "sensitivity.csv")}
        self.assertEqual([effects[p]["effects"] for p in ("tau_f", "samples")], ["2", "2"])
        for first in (0, 3):  # the step in which tau_f changes, by hand
            for a, b in zip(rows[first:first + 2], rows[first + 1:first + 3]):
                self.assertEqual((a["tau_f_Pa"] != b["tau_f_Pa"]) + (a["samples"] != b["samples"]), 1)
        self.assertGreater(float(effects["tau_f"]["mu_star"]), 10 * float(effects["samples"]["mu_star"]))

    def test_bad_input_is_said_all_at_once_and_leaves_no_folder(self):
        bad = self.file(points=0, dsign="grid", results="strength",
                        tests=[{"name": "a b", "deck": {**DECK, "material": {"tauf": 1}}}, {"name": "good", "deck": DECK}],
                        parameters=[{"path": "material.tau_g", "low": 1, "high": 2}, {"path": "material.sigma_f", "low": 5e6, "high": 2e6}])
        done = self.run_program("sweep", bad, "--out", "out")
        self.assertEqual(done.returncode, 2, done.stderr)
        for says in ["/points", "/dsign", 'did you mean "design"', "/results", "/tests/0/name", "/tests/0/deck/material/tauf", "/parameters/0/path",
                     'did you mean "material.tau_f"', "low below high"]:
            self.assertIn(says, done.stderr)
        beyond = self.file(name="beyond.json", parameters=[{"path": "material.tau_f", "low": -1e6, "high": 2e6}, {"path": "material.mu_s", "low": -0.1, "high": 0.5}])
        done = self.run_program("sweep", beyond, "--out", "out")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("tau_f = -1e+06", done.stderr)
        self.assertIn("mu_s = -0.1", done.stderr)
        many = self.file(name="many.json", design="grid", parameters=[{**PARAMETERS[0], "levels": 400}, {**PARAMETERS[1], "levels": 400}])
        done = self.run_program("sweep", many, "--out", "out")
        self.assertIn("160000 points", done.stderr)
        self.assertFalse((self.folder / "out").exists())
        schema = json.loads(self.run_program("schema", "sweep").stdout)
        self.assertIn("latin_hypercube", json.dumps(schema["properties"]["design"]))


if __name__ == "__main__":
    main()
