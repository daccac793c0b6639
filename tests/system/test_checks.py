#!/usr/bin/env python3
"""What can be told before anything runs is told, in the same words, by `check`, by --check and by the run itself."""
import json
import resource
import shutil

from case import Case, main
from small_sweep import DECK, PARAMETERS, sweep
from test_calibrate import calibration

BODY = {"diameter": "50 mm", "height": "100 mm", "spheres": 300}
QUICK = {"rate": "1 m/s", "stop": {"axial_strain": 0.001}}
OUTPUT = {"samples": 20, "fields": 0, "pictures": 0}
STORED = {"file": "prism.h5"}
MATERIAL = {"card": "custom", "young_modulus": "5 MPa", "contact_law": "hertz"}
GRAINS = {"name": "grains", "size": "12 mm", "count": 2, "from": [0, 0, 0], "to": ["0.1 m", "0.1 m", "0.1 m"]}
SPLIT = {"test": "brazilian", "specimen": STORED}
OPEN = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n"


def scene(**changes):
    return {"scene": "falling", "materials": [{"name": "grain", "material": MATERIAL}], "particles": [GRAINS], "stop": {"time": 0.002},
            "output": {"fields": 0, "samples": 10}, **changes}


def tests(*decks, **keys):
    return [{"name": f"t{k}", "deck": deck, **keys} for k, deck in enumerate(decks)]


# name: command, its files' contents (the first is given, and those named in `more`), what must be said, exit code. The folder "taken" holds
# other files, "prism.h5" is a stored specimen that is not round.
TABLE = {
    "keys and folder": (["run"], {"test": "ucs", "loading": {"rte": 1}}, "taken", ["/loading/rte", "holds other files"], 2),
    "specimen and folder": (["run"], SPLIT, "taken", ["not round", "holds other files"], 2),
    "memory": (["run"], {"test": "ucs", "specimen": {"spheres": 20000000}}, "out", ["/specimen/spheres"], 2),
    "a stored specimen with warnings": (["run"], {"test": "ucs", "specimen": STORED, "loading": QUICK, "output": OUTPUT}, "out",
                                        ["warning: The specimen is only"], 0),
    "a provisional card": (["run"], {"test": "ucs", "specimen": STORED, "loading": QUICK, "output": OUTPUT,
                                     "material": {**DECK["material"], "status": "provisional", "about": "a guess"}}, "out",
                           ["warning: The material card is provisional: a guess."], 0),
    "a series": (["run"], {"test": "ucs", "specimen": {**BODY, "seed": [1, 1]}}, "out", ["/specimen/seed/1"], 2),
    "two decks": (["run", "split.json"], {"test": "ucs", "specimen": {"spheres": 13500}}, "out", ["not round"], 2),
    "a scene": (["scene"], scene(surfaces=[{"name": "s", "shape": "file", "file": "none.stl"}], bodies=[]), "taken",
                ["/surfaces/0/file", "holds other files"], 2),
    "a scene with warnings": (["scene"], scene(surfaces=[{"name": "s", "shape": "file", "file": "open.stl"}]), "out",
                              ['warning: Surface "s": open'], 0),
    "a scene without room": (["scene"], scene(particles=[{**GRAINS, "form": "file", "file": "open.stl"}]), "taken",
                             ["open.stl", "holds other files"], 2),
    "a sweep": (["sweep"], sweep(results=["strenth"], tests=tests({**DECK, "output": {"fields": 3}}, weight=2)), "taken",
                ["/tests/0/weight", "/tests/0/deck/output/fields", 'did you mean "strength"', "holds other files"], 2),
    "a sweep's specimen": (["sweep"], sweep(tests=tests(DECK, {**DECK, **SPLIT})), "taken",
                           ['test "t1"', "not round", "holds other files"], 2),
    "a sweep's seeds": (["sweep"], sweep(tests=tests({**DECK, "specimen": STORED}, seeds=[1])), "out", ["/tests/0/seeds"], 2),
    "a sweep's memory": (["sweep"], sweep(tests=tests({**DECK, "specimen": {"spheres": 20000000}})), "out", ["/specimen/spheres"], 2),
    "a calibration": (["calibrate"], calibration(targets=[{"test": "ucs", "curve": "none.csv", "y": "total_stress"},
                                                          {"test": "ucs", "result": "strenght", "value": "40 MPa"}]), "taken",
                      ["/targets/0/curve", 'did you mean "strength"', "holds other files"], 2),
    "a calibration's specimen": (["calibrate"], calibration(
        tests=tests({**DECK, "output": {}, **SPLIT}), targets=[{"test": "t0", "result": "splitting_strength", "value": "3 MPa"}]), "out",
        ["not round"], 2),
    "a study": (["study", "step"], {"test": "ucs", "specimen": BODY, "numerics": {"time_step": 1e-8}}, "taken",
                ["/numerics/time_step", "holds other files"], 2),
    "a study's specimen": (["study", "rate"], {**SPLIT, "loading": {"rate": 1}}, "out", ["not round"], 2),
    "a study of sizes": (["study", "size"], {"test": "ucs", "specimen": STORED}, "out", ["/specimen/file"], 2),
}


class Checks(Case):
    def said(self, *arguments):
        """Exit code and problems, on a machine of 8 GiB."""
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))  # noqa: E731
        done = self.run_program(*arguments, "--threads", 1, preexec_fn=limit)
        return done.returncode, [line for line in done.stderr.splitlines() if line.startswith(("error:", "warning:"))]

    def test_the_three_say_the_same(self):
        made = self.run_program("specimen", "make", "prism.h5", "--set", "shape=prism", "--set", "width=0.05", "--set", "depth=0.05",
                                "--set", "height=0.1", "--set", "spheres=300")
        self.assertEqual(made.returncode, 0, made.stderr)
        (self.folder / "open.stl").write_text(OPEN)
        self.deck(SPLIT, "split.json")
        (self.folder / "taken").mkdir()
        (self.folder / "taken" / "mine.txt").write_text("a letter")
        for name, (command, content, out, parts, code) in TABLE.items():
            with self.subTest(name):
                self.deck(content, "it.json")
                verb, more = command[:1], command[1:]
                if verb == ["study"]:
                    verb, more = command, []
                flag = self.said(*verb, "it.json", *more, "--check", "--out", out)
                self.assertFalse((self.folder / "out").exists())
                run = self.said(*verb, "it.json", *more, "--out", out, "--quiet")
                text = "\n".join(flag[1])
                for part in parts:
                    self.assertIn(part, text)
                self.assertEqual(flag[0], code, text)
                self.assertEqual(run, flag)
                if verb[0] != "study":
                    self.assertEqual(self.said("check", "it.json", *more, "--out", out), flag)
                self.assertEqual((self.folder / "out").exists(), code == 0)
                shutil.rmtree(self.folder / "out", ignore_errors=True)

    def test_a_file_for_another_command_says_so(self):
        for content, command in ((sweep(), "sweep"), (calibration(), "calibrate"), (scene(), "scene")):
            self.deck(content, "it.json")
            said = f"error: it.json: found a file for proveta {command}; expected the deck of a test; proveta {command} it.json"
            self.assertEqual(self.said("run", "it.json", "--out", "out"), (2, [said]))
            self.assertEqual(self.said("check", "it.json")[0], 0)

    def test_a_file_that_cannot_be_written_is_told_before_the_work(self):
        for command in (["specimen", "make", "nowhere/s.h5", "--set", "spheres=200000"], ["bench", "--json", "nowhere/b.json"]):
            done = self.run_program(*command, timeout=20)
            self.assertIn(done.returncode, (2, 4), done.stderr)
            self.assertIn("nowhere", done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_seed_of_a_deck_is_that_of_its_specimen(self):
        (self.folder / "s.json").write_text(json.dumps(sweep(points=1, tests=tests({**DECK, "specimen": {**DECK["specimen"], "seed": 7}}))))
        self.assertEqual(self.run_program("sweep", "s.json", "--out", "s", "--quiet").returncode, 0)
        self.assertEqual([p.parent.name for p in (self.folder / "s").rglob("result.json")], ["t0_seed_7"])

    def test_campaigns_carry_out_the_check_of_the_rate(self):
        deck = {**DECK, "loading": {"rate": "0.2 m/s", "rate_check": "half_rate", "stop": {"axial_strain": 0.006, "post_peak_drop": 0.3}}}
        self.deck(sweep(points=1, tests=tests(deck, DECK), parameters=[{**PARAMETERS[0], "high": "10.1 MPa"}]), "s.json")
        self.assertEqual(self.run_program("sweep", "s.json", "--out", "s", "--quiet").returncode, 0)
        verdicts = json.loads((self.folder / "s" / "summary.json").read_text())["verdicts"]
        self.assertEqual([(v["tests"], v["rate_checked"]) for v in verdicts.values()], [(1, 1), (1, 0)])
        self.assertIsNone(verdicts["t1"]["largest_rate_difference"])
        # The same test by itself says the same.
        trial = next((self.folder / "s" / "trials").glob("*/t0_seed_1/deck.json"))
        done = self.run_program("run", trial, "--out", "r", "--quiet", "--set", "output.pictures=0")
        self.assertEqual(done.returncode, 0, done.stderr)
        alone = json.loads((self.folder / "r" / "summary.json").read_text())
        self.assertEqual(alone["rate_check"]["peak_at_rate_over_that_minus_1"], verdicts["t0"]["largest_rate_difference"])
        self.assertIn(verdicts["t0"]["verdict"], json.dumps(alone))

        target = {"test": "t0", "result": "strength", "value": "20 MPa"}
        (self.folder / "c.json").write_text(json.dumps(calibration(
            tests=tests(deck), deck={}, parameters=PARAMETERS[:1], targets=[target], search={"trials": 1, "batch": 1, "spheres": 1},
            finish={"rounds": 0}, confidence={"seeds": 0})))
        done = self.run_program("calibrate", "c.json", "--out", "c", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads((self.folder / "c" / "summary.json").read_text())["verdicts"]["t0"]["rate_checked"], 1)


if __name__ == "__main__":
    main()
