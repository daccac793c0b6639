#!/usr/bin/env python3
"""The program from outside: several tests at once."""
import json
import shutil
import time

from case import FILES, Case, main


class Series(Case):
    FILES = ["manifest.json", "summary.json", "series.csv", "report.html"]
    CONFINED = {
        "test": "triaxial",
        "specimen": {"diameter": "50 mm", "height": "100 mm", "spheres": 400, "seed": [1, 2]},
        # Breaks within the strain it is given, whatever the default card does.
        "material": {"card": "custom", "strength_factor": 1.27, "sigma_f": "5 MPa", "tau_f": "16 MPa", "mu_s": 0.9, "fracture_energy_tension": 16, "fracture_energy_shear": 790, "lcs": ["20 MPa", "45 MPa", "70 MPa"]},
        "loading": {"rate": "0.4 m/s", "confining_pressure": ["0 MPa", "4 MPa"], "stop": {"axial_strain": 0.006, "post_peak_drop": 0.2}},
        "output": {"samples": 60, "fields": 1},
    }

    def confined(self, name="confined.json", seed=None, pressure=None, **loading):
        deck = json.loads(json.dumps(self.CONFINED))
        deck["specimen"]["seed"] = seed or deck["specimen"]["seed"]
        deck["loading"]["confining_pressure"] = pressure or deck["loading"]["confining_pressure"]
        deck["loading"].update(loading)
        return self.deck(deck, name)

    def test_pressures_and_seeds_make_a_series_whose_members_are_as_by_themselves(self):
        done = self.run_program("run", self.confined(), "--out", "s", "--threads", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.folder / "s"
        names = ["p_0MPa_seed_1", "p_0MPa_seed_2", "p_4MPa_seed_1", "p_4MPa_seed_2"]
        for name in self.FILES + [f"{member}/{file}" for member in names for file in FILES]:
            self.assertTrue((out / name).is_file(), name)
        self.assertFalse(list(out.rglob("*.partial")))
        rows = self.rows(out / "series.csv")
        self.assertEqual([r["folder"] for r in rows], names)
        self.assertEqual([float(r["confining_pressure_Pa"]) for r in rows], [0, 0, 4e6, 4e6])
        self.assertEqual([r["seed"] for r in rows], ["1", "2", "1", "2"])
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["status"], "complete")
        self.assertGreater(summary["results"]["friction_angle"]["value"], 0.0)
        for row, member in zip(rows, summary["members"]):
            own = json.loads((out / member["name"] / "summary.json").read_text())
            self.assertEqual(float(row["strength_Pa"]), own["results"]["strength"]["value"])
        self.assertEqual([g["name"] for g in summary["groups"]], ["p_0MPa", "p_4MPa"])
        spread = summary["groups"][1]["statistics"]["strength"]
        self.assertAlmostEqual(spread["mean"], sum(float(r["strength_Pa"]) for r in rows[2:]) / 2, delta=1.0)
        for group in summary["groups"]:
            self.assertGreater(len(self.rows(out / group["mean_curve"])), 100)
        page = (out / "report.html").read_text()
        self.assertIn('href="p_4MPa_seed_2/report.html"', page)
        self.assertNotIn("https://", page)
        self.assertIn("results in s", done.stdout)

        alone = self.run_program("run", self.confined("one.json", seed=2, pressure="4 MPa"), "--out", "alone", "--quiet")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        again = self.run_program("run", "s/manifest.json", "--out", "again", "--quiet", "--threads", 1)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn("info:", again.stderr)
        for name in ["curve.csv", "events.csv", "acoustic.csv", "energy.csv"]:
            member = (out / "p_4MPa_seed_2" / name).read_bytes()
            self.assertEqual(member, (self.folder / "alone" / name).read_bytes(), name)
            self.assertEqual(member, (self.folder / "again" / "p_4MPa_seed_2" / name).read_bytes(), name)

        # A single run in its place takes the members away with it.
        self.assertEqual(self.run_program("run", self.confined("one.json", seed=2, pressure="4 MPa"), "--out", "s", "--quiet").returncode, 0)
        self.assertFalse((out / "p_0MPa_seed_1").exists() or (out / "series.csv").exists() or (out / "mean_curves").exists())

    def test_several_decks_make_a_series(self):
        press = self.deck(name="press.json", specimen={"diameter": "50 mm", "height": "100 mm", "spheres": 500})
        split = self.deck(name="split.json", test="brazilian", specimen={"diameter": "50 mm", "height": "30 mm", "spheres": 500})
        done = self.run_program("run", press, split, "--out", "s", "--quiet", "--seed", 3)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([r["folder"] for r in self.rows(self.folder / "s" / "series.csv")], ["press", "split"])
        self.assertEqual([r["seed"] for r in self.rows(self.folder / "s" / "series.csv")], ["3", "3"])
        results = json.loads((self.folder / "s" / "summary.json").read_text())["results"]
        self.assertGreater(results["compressive_to_splitting"]["value"], 1.0)
        self.assertNotIn("cohesion", results)

    def test_problems_of_a_series_are_said_once_and_leave_no_folder(self):
        for k, (deck, says) in enumerate([
            (lambda n: self.confined(n, pressure=["1 MPa", "0 MPa", "1000 kPa"]), "/loading/confining_pressure/2"),
            (lambda n: self.confined(n, pressure=["1 MPa", "2 parsec"]), "/loading/confining_pressure/1"),
            (lambda n: self.deck(name=n, specimen={"seed": []}), "/specimen/seed"),
            (lambda n: self.deck(name=n, loading={"confining_pressure": ["1 MPa", "2 MPa"]}), "/loading/confining_pressure"),
            (lambda n: self.deck(name=n, specimen={"seed": [1, 2], "spheres": 1}), "/specimen/spheres"),
            (lambda n: self.deck(name=n, specimen={"diameter": "50 mm", "height": "100 mm", "seed": [1, 2], "spheres": 300}, numerics={"time_step": "1 s"}), "stable step"),
        ]):
            with self.subTest(says):
                file = deck(f"bad{k}.json")
                commands = [["run", "--out", "out"]] + ([["check"]] if says != "stable step" else [])  # found with the specimen in the press
                for command in commands:
                    done = self.run_program(*command, file)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(says, done.stderr)
                    problems = [line for line in done.stderr.splitlines() if line.startswith("error:")]
                    self.assertEqual(len(problems), len(set(problems)), done.stderr)
                    self.assertFalse((self.folder / "out").exists())
        both = self.run_program("check", self.deck(name="a.json", loading={"rat": 1}), self.deck(name="b.json", specimen={"sed": 1}))
        self.assertEqual((both.returncode, both.stderr.count("error:")), (2, 2), both.stderr)
        same = self.run_program("check", self.deck(), self.deck())
        self.assertIn("the same test", same.stderr)
        good = self.run_program("check", self.confined())
        self.assertEqual(good.returncode, 0)
        self.assertIn("p_4MPa_seed_2", good.stdout)

    def test_a_member_that_fails_does_not_stop_the_others(self):
        deck = self.confined(pressure=["0 MPa"], rate="0.005 m/s")
        lost = self.folder / "r" / "p_0MPa_seed_1"
        process = self.start("run", deck, "--out", "r", "--threads", "2", "--quiet", until=lost / "fields")
        time.sleep(0.2)
        plain_file = self.folder / "plain_file"
        plain_file.write_text("no folder any more")
        lost.rename(self.folder / "gone")  # in one step: the test writes there all the while
        plain_file.rename(lost)  # what it has measured cannot be written
        out, log = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 4, log)  # files of one could not be written
        self.assertIn("proveta resume r", log)
        self.assertIn("p_0MPa_seed_1", log)
        summary = json.loads((self.folder / "r" / "summary.json").read_text())
        self.assertEqual((summary["status"], [m["status"] for m in summary["members"]]), ("failed", ["failed", "complete"]))
        self.assertIn("1 complete, 1 failed", out)

    def test_an_interrupt_stops_all_members_and_keeps_what_they_have(self):
        deck = self.confined(rate="0.001 m/s")
        process = self.start("run", deck, "--out", "r", "--threads", "2", until="r/p_0MPa_seed_2/fields")
        out = self.interrupt(process)
        summary = json.loads((self.folder / "r" / "summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        self.assertEqual([m["status"] for m in summary["members"]], ["interrupted", "interrupted", "not run", "not run"])
        self.assertEqual(json.loads((self.folder / "r" / "manifest.json").read_text())["status"], "interrupted")
        self.assertIn("partial", (self.folder / "r" / "report.html").read_text())
        self.assertFalse((self.folder / "r" / "p_4MPa_seed_1").exists())
        self.assertIn("interrupted", out)


if __name__ == "__main__":
    main()
