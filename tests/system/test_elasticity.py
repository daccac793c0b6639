#!/usr/bin/env python3
"""The program from outside: elasticity and studies."""
import json

from case import Case, main


class Elasticity(Case):
    def specimen(self, spheres=800):
        made = self.run_program("specimen", "make", "s.h5", "--set", f"spheres={spheres}", "--set", "diameter=50 mm", "--set", "height=100 mm")
        self.assertEqual(made.returncode, 0, made.stderr)
        return "s.h5"

    def test_elastic_prints_and_writes_what_the_card_asks_for(self):
        done = self.run_program("elastic", self.specimen(), "--set", "material.young_modulus=30 GPa", "--json", "e.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("isotropy", done.stdout)
        found = json.loads((self.folder / "e.json").read_text())
        self.assertTrue(found["in_reach"])
        self.assertAlmostEqual(found["uniaxial_lubricated"]["young_modulus"] / 30e9, 1.0, delta=1e-4)
        self.assertAlmostEqual(found["uniaxial_lubricated"]["poisson_ratio"], 0.177, delta=5e-4)
        inside = found["interior"]
        self.assertAlmostEqual(inside["young_modulus"] / 30e9, 1.0, delta=0.1)
        c = inside["stiffness"]
        for row in range(6):
            for column in range(6):
                self.assertEqual(c[row][column], c[column][row])
        given = self.run_program("elastic", "s.h5", "--set", "material.elasticity=as-given", "--threads", 1)
        self.assertIn("a = 1.0000, b = 1.0000", given.stdout)

    def test_elastic_refuses_what_it_cannot_press(self):
        self.assertEqual(self.run_program("elastic", "none.h5").returncode, 2)
        self.specimen(100)
        wrong = self.run_program("elastic", "s.h5", "--material", "concrete_sfr")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("concrete_sfer", wrong.stderr)

    def refused(self, spheres, *words, size=()):
        """What a table of spheres x y z r is refused with, by `check`, `run` and `elastic` alike. size: said at its import."""
        (self.folder / "t.csv").write_text("x,y,z,r\n" + "".join("%.9g,%.9g,%.9g,%.9g\n" % tuple(s) for s in spheres))
        self.assertEqual(self.run_program("specimen", "import", "t.csv", "t.h5", "--shape", "prism", *size).returncode, 0)
        deck = self.deck({"test": "ucs", "specimen": {"file": "t.h5"}})
        for command in (["check", deck], ["run", deck, "--out", "r"], ["elastic", "t.h5"]):
            done = self.run_program(*command)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / "r").exists())

    @staticmethod
    def lattice(n, radius, x=0.0):
        return [(x + 2 * radius * i, 2 * radius * j, 2 * radius * k, radius) for i in range(n) for j in range(n) for k in range(2 * n)]

    def test_what_platens_hardly_touch_is_refused(self):
        block = self.lattice(5, 0.005)
        proud = block + [(0.02, 0.02, -0.0099, 0.005), (0.02, 0.02, 0.0999, 0.005)]
        self.refused(proud, "touch 1 and 1 spheres", "elasticity", size=["--height", 0.1198])

    def test_pieces_are_refused(self):
        block = self.lattice(4, 0.005)
        other = self.lattice(4, 0.005, x=0.08)
        self.refused(block + other, "2 pieces", "128 of 256 spheres")

    def test_the_factors_and_a_ratio_out_of_reach_are_reported(self):
        quick = {"rate": "0.2 m/s", "stop": {"axial_strain": 0.0002}}
        self.assertEqual(self.run_program("run", self.deck(loading=quick), "--out", "a", "--quiet").returncode, 0)
        summary = json.loads((self.folder / "a" / "summary.json").read_text())
        factors = summary["elasticity"][0]
        self.assertTrue(factors["in_reach"] and factors["normal_factor"] > 1.0 and factors["averaged_factor"] == 0.0)
        self.assertIn("Elasticity of concrete_sfer", (self.folder / "a" / "report.html").read_text())
        deck = self.deck(loading=quick, material={"poisson_ratio": 0.35, "elasticity": "calibrated-bonds"})
        self.assertEqual(self.run_program("run", deck, "--out", "b", "--quiet").returncode, 0)
        summary = json.loads((self.folder / "b" / "summary.json").read_text())
        self.assertFalse(summary["elasticity"][0]["in_reach"])
        self.assertIn("out of reach", " ".join(summary["warnings"]))

    def test_a_run_with_the_averaged_part_is_repeated_to_the_byte(self):
        deck = self.deck(material={"poisson_ratio": 0.35}, loading={"rate": "0.5 m/s"})
        self.assertEqual(self.run_program("run", deck, "--out", "one", "--threads", 1, "--quiet").returncode, 0)
        self.assertEqual(self.run_program("run", "one/manifest.json", "--out", "two", "--threads", 2, "--quiet").returncode, 0)
        summary = json.loads((self.folder / "one" / "summary.json").read_text())
        self.assertGreater(summary["elasticity"][0]["averaged_factor"], 0.0)
        self.assertTrue(summary["verdicts"]["Energy balance"]["good"])
        for name in ["curve.csv", "events.csv", "energy.csv"]:
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes(), name)

    def test_contradictions_are_refused(self):
        for material, path in [({"normal_factor": 1.4}, "/material/normal_factor"), ({"averaged_factor": 1}, "/material/averaged_factor"),
                               ({"poisson_ratio": 0.495}, "/material/poisson_ratio"), ({"elasticity": "calibratd"}, "calibrated"),
                               ({"card": "custom", "fracture_energy_tension": 0.01}, "/material/fracture_energy_tension")]:
            wrong = self.run_program("run", self.deck(material=material), "--out", "r", "--quiet")
            self.assertEqual(wrong.returncode, 2, material)
            self.assertIn(path, wrong.stderr)
            self.assertFalse((self.folder / "r").exists())


class Studies(Case):
    def test_a_study_runs_extrapolates_and_plots(self):
        deck = self.deck(loading={"rate": "0.5 m/s"}, output={"samples": 100, "fields": 0})
        done = self.run_program("study", "size", deck, "--values", "200,500", "--seeds", 2, "--out", "s", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "s" / "study.csv") as f:
            text = f.read()
        self.assertIn("spheres 200", text)
        summary = json.loads((self.folder / "s" / "summary.json").read_text())
        values = [m["results"]["young_modulus"]["value"] for m in summary["members"]]
        self.assertEqual(len(values), 4)
        means = [sum(values[:2]) / 2, sum(values[2:]) / 2]
        x = [(1.0 / n) ** (1.0 / 3.0) for n in (200, 500)]
        limit = means[1] - x[1] * (means[0] - means[1]) / (x[0] - x[1])
        self.assertAlmostEqual(summary["results"]["young_modulus_limit"]["value"] / limit, 1.0, delta=1e-9)
        self.assertIn("number of spheres", (self.folder / "s" / "report.html").read_text())
        # Stopped and gone on with it is still a study; from its manifest, too.
        process = self.start("study", "size", deck, "--values", "200,500", "--seeds", 2, "--out", "part", "--quiet", until="part/manifest.json")
        process.kill()
        process.communicate()
        for command in (["resume", "part"], ["run", "s/manifest.json", "--out", "again"]):
            done = self.run_program(*command, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        for out in ("part", "again"):
            for name in ("study.csv", "summary.json"):
                self.assertEqual((self.folder / out / name).read_bytes(), (self.folder / "s" / name).read_bytes(), (out, name))

    def test_bad_studies_are_refused_before_anything_is_written(self):
        for arguments, text in [(("rate", self.deck(), "--values", "0.1,0.1"), "twice"), (("rate", self.deck(), "--values", "0.1"), "at least two"),
                                (("rate", self.deck(), "--values", "0.1,-1"), "/loading/rate"),
                                (("step", self.deck(name="l.json", specimen={"seed": [1, 2]})), "one test"),
                                (("size", self.deck(name="f.json", specimen={"file": "s.h5"}), "--values", "10,20"), "/specimen/file")]:
            wrong = self.run_program("study", *arguments, "--out", "s")
            self.assertEqual(wrong.returncode, 2, wrong.stdout)
            self.assertIn(text, wrong.stderr)
            self.assertFalse((self.folder / "s").exists())


if __name__ == "__main__":
    main()
