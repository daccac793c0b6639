"""The calibration from outside: what it leaves, going on after a kill, carrying trials out elsewhere, bad input. Started as: test_calibrate.py PROVETA"""
import json
import os
import shutil
import random
import signal
import subprocess
import time
import unittest

from case import Case, main

BRITTLE = {"card": "custom", "fracture_energy_tension": 0, "fracture_energy_shear": 0, "elasticity": "as-given"}


def calibration(**changes):
    common = {"specimen": {"diameter": "50 mm", "height": "100 mm", "spheres": 300}, "material": BRITTLE, "output": {"fields": 0}}
    return {
        "title": "A <small> calibration",
        "deck": common,
        "tests": [
            {"name": "ucs", "deck": {"test": "ucs", "loading": {"rate": "0.3 m/s"}}, "seeds": [1, 2]},
            {"name": "p", "deck": {"test": "triaxial", "loading": {"rate": "0.3 m/s", "confining_pressure": "2 MPa"}}},
        ],
        "parameters": [
            {"path": "material.tau_f", "low": "10 MPa", "high": "24 MPa"},
            {"path": "material.sigma_f", "low": "3 MPa", "high": "8 MPa", "scale": "log"},
        ],
        "targets": [
            {"test": "ucs", "result": "strength", "value": "40 MPa", "source": "made up"},
            {"test": "ucs", "result": "young_modulus", "value": "30 GPa", "kind": "estimate"},
            {"test": "p", "result": "strength", "value": "50 MPa", "use": "predict", "tolerance": 0.5},
        ],
        "search": {"spheres": 0.5, "trials": 8, "batch": 4},
        "finish": {"rounds": 2, "trials": 4},
        "confidence": {"seeds": 3},
        "card": {"name": "small"},
        **changes,
    }


class Calibrate(Case):
    def write(self, content, name="c.json"):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def text(self, path):
        return (self.folder / path).read_text()

    def ledger(self, folder):
        return [json.loads(line) for line in self.text(f"{folder}/ledger.jsonl").splitlines()]

    def test_a_card_with_its_evidence_and_all_files(self):
        done = self.run_program("calibrate", self.write(calibration()), "--out", "r")
        self.assertEqual(done.returncode, 0, done.stderr)
        card = json.loads(self.text("r/card.json"))
        self.assertEqual(card["name"], "small")
        self.assertEqual(card["status"], "provisional")
        evidence = card["evidence"]
        self.assertEqual([t["use"] for t in evidence["targets"]], ["fit", "fit", "predict"])
        self.assertEqual(evidence["seeds"], {"ucs": [1, 2], "p": [1]})
        self.assertEqual(evidence["trials"], 8 + 4 + 2)
        rows = self.rows(self.folder / "r" / "trials.csv")
        self.assertEqual([r["specimens"] for r in rows], ["small"] * 8 + ["whole"] + ["small"] * 4 + ["whole"])
        best = min((r for r in rows if r["specimens"] == "whole"), key=lambda r: float(r["score"]))
        self.assertAlmostEqual(float(best["score"]), evidence["score_in_tolerances"], places=5)
        self.assertAlmostEqual(float(best["tau_f"]), card["tau_f"], delta=1e-6 * card["tau_f"])
        page = self.text("r/report.html")
        for words in ("A &lt;small&gt; calibration", "Predictions of what was left out", "Profiles", "Noise floor", "is an estimate"):
            self.assertIn(words, page)
        # The card is a card: a test with it gives what the evidence says, on the first of its specimens.
        deck = {**calibration()["deck"], **calibration()["tests"][1]["deck"], "material": {"card": "r/card.json"}}
        self.assertEqual(self.run_program("run", self.write(deck, "again.json"), "--out", "again").returncode, 0)
        found = json.loads(self.text("again/summary.json"))["results"]["strength"]["value"]
        self.assertAlmostEqual(found / evidence["targets"][2]["found"], 1.0, places=9)
        status = self.run_program("calibrate", "c.json", "--out", "r", "--status")
        self.assertIn("complete: card.json", status.stdout)
        # Its manifest repeats it, and the same folder computes nothing again.
        before = self.text("r/ledger.jsonl")
        self.assertEqual(self.run_program("calibrate", "r/manifest.json", "--out", "r").returncode, 0)
        self.assertEqual(self.text("r/ledger.jsonl"), before)
        self.assertEqual(json.loads(self.text("r/card.json")), card)

    def test_killed_again_and_again_it_ends_with_the_same_card(self):
        path = self.write(calibration())
        self.assertEqual(self.run_program("calibrate", path, "--out", "whole", "--threads", "1").returncode, 0)
        rng = random.Random(3)
        kills = 0
        for _ in range(10):
            process = self.start("calibrate", path, "--out", "killed", "--quiet", until="killed/ledger.jsonl")
            try:
                process.wait(timeout=rng.uniform(0.1, 0.5))
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
            process.communicate(timeout=60)
        self.assertGreaterEqual(kills, 5)
        self.assertEqual(self.run_program("calibrate", path, "--out", "killed").returncode, 0)
        self.assertEqual(self.text("killed/card.json"), self.text("whole/card.json"))
        self.assertEqual(self.text("killed/trials.csv"), self.text("whole/trials.csv"))
        names = [line["trial"] for line in self.ledger("killed")]
        self.assertEqual(len(names), len(set(names)), "a trial was carried out twice")
        self.assertEqual(set(names), {line["trial"] for line in self.ledger("whole")})

    def test_an_interrupt_says_how_to_go_on(self):
        process = self.start("calibrate", self.write(calibration()), "--out", "r", until="r/ledger.jsonl")
        self.interrupt(process)
        self.assertEqual(json.loads(self.text("r/manifest.json"))["status"], "interrupted")
        self.assertFalse((self.folder / "r" / "card.json").exists())
        self.assertIn("not at its end", self.run_program("calibrate", "c.json", "--out", "r", "--status").stdout)

    def test_trials_carried_out_elsewhere_give_the_same_card(self):
        path = self.write(calibration(finish={"rounds": 1}, confidence={"seeds": 0}))
        self.assertEqual(self.run_program("calibrate", path, "--out", "here").returncode, 0)
        planned = self.run_program("calibrate", path, "--out", "there", "--plan")
        for _ in range(10):
            self.assertEqual(planned.returncode, 0, planned.stderr)
            if (self.folder / "there" / "card.json").exists():
                break
            self.assertIn("trials planned", planned.stdout)
            self.assertEqual(self.run_program("trial", "--list", "there/trials.txt").returncode, 0)
            planned = self.run_program("calibrate", path, "--out", "there", "--collect")
        self.assertEqual(self.text("there/card.json"), self.text("here/card.json"))

    def test_a_process_that_dies_is_a_bad_trial_and_not_the_end(self):
        path = self.write(calibration(finish={"rounds": 0}, confidence={"seeds": 0}, search={"spheres": 1, "trials": 8, "batch": 4}))
        process = self.start("calibrate", path, "--out", "r", until="r/ledger.jsonl")
        killed = False
        end = time.monotonic() + 20
        while not killed and time.monotonic() < end and process.poll() is None:
            children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()
            for child in children:
                try:
                    os.kill(int(child), signal.SIGSEGV)
                    killed = True
                except ProcessLookupError:
                    pass
        _, log = process.communicate(timeout=300)
        self.assertTrue(killed)
        self.assertEqual(process.returncode, 0, log)
        reasons = [job["reason"] for line in self.ledger("r") for job in line["jobs"] if job["status"] == "failed"]
        self.assertTrue(any("signal 11" in reason for reason in reasons), reasons)

    def test_bad_input_is_refused_with_all_problems_and_no_folder(self):
        bad = calibration(parameters=[{"path": "material.tauf", "low": 1, "high": 2}],
                          targets=[{"test": "ucs", "result": "strength"}, {"test": "x", "curve": "none.csv"}], serch={})
        done = self.run_program("calibrate", self.write(bad), "--out", "r")
        self.assertEqual(done.returncode, 2)
        for words in ("/parameters/0/path", "material.tau_f", "/targets/0/value", "/targets/1/test", "/targets/1/y", "/serch"):
            self.assertIn(words, done.stderr)
        self.assertFalse((self.folder / "r").exists())
        other = self.folder / "other"
        other.mkdir()
        (other / "notes.txt").write_text("mine")
        done = self.run_program("calibrate", self.write(calibration()), "--out", "other")
        self.assertEqual((done.returncode, os.listdir(other)), (2, ["notes.txt"]))
        # A result that the test has not, a value that the result cannot have.
        for target, words in (({"result": "peak_strength", "value": "30 MPa"}, "/targets/0/result"), ({"result": "poisson_ratio", "value": "0.2 MPa"}, "/targets/0/value"),
                              ({"result": "strength", "value": "-30 MPa"}, "a positive strength")):
            done = self.run_program("calibrate", self.write(calibration(targets=[{"test": "ucs", **target}])), "--out", "r")
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)
            self.assertFalse((self.folder / "r").exists())
        # Targets that no trial can give: the reason of the last one is told.
        short = {"name": "ucs", "deck": {"test": "ucs", "loading": {"rate": "0.3 m/s", "stop": {"axial_strain": 0.0001}}}}
        impossible = calibration(tests=[short], targets=[{"test": "ucs", "result": "strength", "value": "30 MPa"}], search={"spheres": 0.5, "trials": 2, "batch": 2})
        done = self.run_program("calibrate", self.write(impossible), "--out", "r")
        self.assertEqual(done.returncode, 3)
        self.assertIn("none of 2 trials gave every target", done.stderr)

    def test_a_measured_curve_is_read_as_it_was_written_or_refused(self):
        """Dialects give one score; signs, scales and order are said."""
        points = [(2e-5 * k, min(28e3 * 2e-5 * k, 30.0)) for k in range(60)]

        def rows(separator=",", decimal=".", x=1.0, y=1.0, heading="strain,stress"):
            return "\n".join([heading.replace(",", separator)] + [f"{x * a:.8f}{separator}{y * b:.8f}".replace(".", decimal) for a, b in points]) + "\n"

        def score(text, **keys):
            (self.folder / "m.csv").write_text(text)
            target = {"test": "ucs", "curve": "m.csv", "y": "total_stress", "x_column": "strain", "y_column": "stress", "y_factor": 1e6, **keys}
            short = {"name": "ucs", "deck": {"test": "ucs", "loading": {"rate": "0.3 m/s"}}}
            plan = calibration(tests=[short], targets=[target], search={"spheres": 0.5, "trials": 1, "batch": 1}, finish={"rounds": 0}, confidence={"seeds": 0})
            shutil.rmtree(self.folder / "m", ignore_errors=True)
            done = self.run_program("calibrate", self.write(plan), "--out", "m")
            if done.returncode != 0:
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertFalse((self.folder / "m").exists())
                return done.stderr
            summary = json.loads((self.folder / "m" / "summary.json").read_text())
            return round(summary["results"]["score"]["value"], 6), summary["curves"][0]["warnings"], done.stderr

        plain = score(rows())
        self.assertEqual(plain[1], [])
        for text, keys in ((rows(";", ","), {}), ("Specimen;A1\nDate;2020-01-01\n\n" + rows(";", ","), {}), (rows(heading="strain,stress\n-,MPa"), {}),
                           (rows("\t"), {}), ("\ufeff" + rows(), {}), (rows(x=100.0, heading="strain [%],stress [MPa]"), {"y_factor": 1}),
                           (rows(x=-1.0, y=-1.0), {"x_factor": -1, "y_factor": -1e6})):
            with self.subTest(text[:40]):
                self.assertEqual(score(text, **keys)[0], plain[0])
        self.assertIn("read 'strain [%]' as axial strain, in %", score(rows(x=100.0, heading="strain [%],stress"))[2])
        self.assertIn('"x_factor": -1', score(rows(x=-1.0, y=-1.0)))
        self.assertIn('"y_factor": 1e+06', score(rows(), y_factor=1))
        self.assertIn('"x_factor": 0.01', score(rows(x=100.0)))
        self.assertIn("columns 2 and 3", score("strain,stress,stress\n0,0,0\n1e-4,2.8,0\n2e-4,5.6,0\n"))
        back = score(rows() + "0.0009,20\n0.0008,10\n")
        self.assertEqual(back[0], plain[0])
        self.assertIn("2 rows in which axial strain goes back", back[1][0])


if __name__ == "__main__":
    main()
