#!/usr/bin/env python3
"""What computed a result: the revisions in the program, in manifests and in the keys of what is stored."""
import json
import pathlib
import re
import shutil
import subprocess

from case import Case, main
from small_sweep import DECK, sweep
from test_calibrate import calibration

ROOT = pathlib.Path(__file__).resolve().parents[2]
OTHER = "0123456789ab"
FACTS = ("version", "revision", "physics", "compiler", "build", "vector_kernel")


class Written(Case):
    """The script that a build looks the revisions up with, on a copy of the sources."""

    def setUp(self):
        super().setUp()
        self.copy = self.folder / "copy"
        for name in ("core", "materials", "specimens", "lab", "reports", "docs"):
            shutil.copytree(ROOT / name, self.copy / name)
        self.source = self.folder / "revision.cpp"

    def revisions(self, built_by="GNU 12 -O3 -Wall"):
        given = {"FROM": self.copy, "INTO": self.source, "BUILT_BY": built_by, "GIT": shutil.which("git")}
        subprocess.run(["cmake", *(f"-D{name}={value}" for name, value in given.items()), "-P", ROOT / "cmake" / "write_revision.cmake"],
                       check=True, capture_output=True)
        return re.findall(r'return "(.*)";', self.source.read_text())

    def edit(self, name):
        with open(self.copy / name, "a") as file:
            file.write("\n")

    def test_what_can_change_a_number_changes_the_physics_and_nothing_else_does(self):
        physics, _ = self.revisions()
        self.assertRegex(physics, "^[0-9a-f]{12}$")
        written = self.source.stat().st_mtime_ns
        for name in ("docs/user-guide.md", "reports/html.cpp", "reports/page/page.js", "lab/sweep/sweep_report.cpp",
                     "lab/scene/scene_pictures.cpp", "lab/cli/main.cpp", "lab/test_plots.cpp", "lab/run.cpp", "lab/CMakeLists.txt"):
            self.edit(name)
            self.assertEqual(self.revisions()[0], physics, name)
        self.assertEqual(self.revisions("GNU 12 -O3 -Wextra")[0], physics)
        self.assertEqual(self.source.stat().st_mtime_ns, written)  # so that nothing is compiled again
        seen = {physics, self.revisions("GNU 12 -O2 -Wall")[0], self.revisions("GNU 13 -O3 -Wall")[0]}
        for name in ("core/bonds/bond_kernel.cpp", "core/laws/bond/facet_law.hpp", "materials/cards/thesis.json", "specimens/packing.cpp",
                     "lab/protocols/ucs.cpp", "lab/controls/servo.cpp", "lab/scene/feed.cpp", "lab/derived.cpp", "lab/test_run.cpp"):
            self.edit(name)
            now = self.revisions()[0]
            self.assertNotIn(now, seen, name)
            seen.add(now)

    def test_git_is_for_people(self):
        self.assertEqual(self.revisions()[1], "no git")
        git = ["git", "-c", "user.name=n", "-c", "user.email=e@x"]
        for command in (["init", "-q"], ["add", "core"], ["commit", "-q", "-m", "first"], ["tag", "v3.1"]):
            subprocess.run([*git, *command], cwd=self.copy, check=True)
        self.assertEqual(self.revisions()[1], "v3.1")
        self.edit("core/model.cpp")
        self.assertEqual(self.revisions()[1], "v3.1-dirty")
        subprocess.run([*git, "commit", "-q", "-a", "-m", "second"], cwd=self.copy, check=True)
        self.assertRegex(self.revisions()[1], "^v3.1-1-g[0-9a-f]+$")


class Stored(Case):
    def text(self, path):
        return (self.folder / path).read_text()

    def manifest(self, out):
        return json.loads(self.text(f"{out}/manifest.json"))

    def physics(self):
        return re.search(r"physics ([0-9a-f]{12})", self.run_program("--version").stdout).group(1)

    def as_of_other_physics(self, out, **changes):
        """The folder as a program of another physics would have left it."""
        own = self.physics()
        for path in (self.folder / out).rglob("*.json*"):
            path.write_text(path.read_text().replace(own, OTHER))
        manifest = self.folder / out / "manifest.json"
        manifest.write_text(json.dumps({**json.loads(manifest.read_text()), **changes}))

    def brittle(self, name="deck.json", **specimen):
        output = {"samples": 60, "fields": 0, "pictures": 0}
        return self.deck({**DECK, "specimen": {**DECK["specimen"], **specimen}, "output": output}, name)

    def ok(self, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_the_program_says_what_it_is_on_one_line(self):
        said = self.run_program("--version").stdout
        self.assertRegex(said, r"^proveta \d+\.\d+\.\d+ \(\S.*, physics [0-9a-f]{12}, .*, [0-9]+ threads?\)\n$")

    def test_every_manifest_says_it(self):
        self.brittle()
        self.ok("run", "deck.json", "--out", "test", "--quiet")
        self.brittle("series.json", seed=[1, 2])
        self.ok("run", "series.json", "--out", "series", "--quiet")
        (self.folder / "sweep.json").write_text(json.dumps(sweep(points=1)))
        self.ok("sweep", "sweep.json", "--out", "sweep", "--quiet")
        (self.folder / "c.json").write_text(json.dumps(calibration(search={"spheres": 0.5, "trials": 1, "batch": 1}, finish={"rounds": 0},
                                                                   confidence={"seeds": 0})))
        self.ok("calibrate", "c.json", "--out", "calibration", "--quiet")
        self.ok("compare", "test", "series", "--out", "comparison")
        material = {"card": "custom", "young_modulus": "5 MPa", "contact_law": "hertz"}
        grains = {"name": "grains", "size": "12 mm", "count": 2, "from": [0, 0, 0], "to": ["0.1 m", "0.1 m", "0.1 m"]}
        self.deck({"scene": "falling", "materials": [{"name": "grain", "material": material}], "particles": [grains],
                   "stop": {"time": 0.01}, "output": {"fields": 0, "samples": 10}}, "scene.json")
        self.ok("scene", "scene.json", "--out", "scene", "--quiet")
        for out in ("test", "series", "series/seed_2", "sweep", "calibration", "comparison", "scene"):
            manifest = self.manifest(out)
            self.assertEqual([key for key in FACTS if not manifest.get(key)], [], out)
            self.assertEqual(manifest["physics"], self.physics(), out)
        self.assertEqual(json.loads(self.text("calibration/card.json"))["evidence"]["physics"], self.physics())
        # One that is asked for again is not computed again.
        ledger = self.text("sweep/ledger.jsonl")
        self.ok("sweep", "sweep.json", "--out", "sweep", "--quiet")
        self.assertEqual(self.text("sweep/ledger.jsonl"), ledger)

        # A calibration of another physics.
        self.as_of_other_physics("calibration")
        known = len(self.text("calibration/ledger.jsonl").splitlines())
        done = self.ok("resume", "calibration", "--quiet")
        self.assertIn(f"physics {OTHER}, while this program is physics {self.physics()}: none is taken", done.stderr)
        self.assertEqual(len(self.text("calibration/ledger.jsonl").splitlines()), 2 * known)

    def test_trials_of_another_physics_are_never_taken(self):
        (self.folder / "sweep.json").write_text(json.dumps(sweep(points=3)))
        self.ok("sweep", "sweep.json", "--out", "s", "--quiet")
        table = self.text("s/table.csv")
        (self.folder / "s/manifest.json").rename(self.folder / "manifest.json")  # a ledger alone is enough to know the folder by
        self.assertEqual(self.ok("sweep", "sweep.json", "--out", "s", "--quiet").stderr, "")
        self.as_of_other_physics("s")
        state = self.ok("sweep", "sweep.json", "--out", "s", "--status").stdout
        self.assertIn("0 of 3 points done", state)
        self.assertIn("of another physics: 3", state)
        refused = self.run_program("report", "s")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("of another physics", refused.stderr)
        planned = next((self.folder / "s" / "trials").iterdir())
        refused = self.run_program("trial", planned)
        self.assertEqual(refused.returncode, 2)
        self.assertIn(OTHER, refused.stderr)
        done = self.ok("resume", "s")
        self.assertIn(f"3 trials in the ledger computed by physics {OTHER}", done.stderr)
        self.assertIn("computed again: 3 of 3 points", done.stderr)
        self.assertEqual(len(self.text("s/ledger.jsonl").splitlines()), 6)
        self.assertEqual(self.text("s/table.csv"), table)
        self.assertEqual(self.ok("resume", "s", "--quiet").stderr.count("3 of 3"), 0)
        self.assertEqual(len(self.text("s/ledger.jsonl").splitlines()), 6)

    def test_members_of_another_physics_are_computed_again(self):
        self.brittle(seed=[1, 2])
        self.ok("run", "deck.json", "--out", "s", "--quiet")
        table = self.text("s/series.csv")
        self.as_of_other_physics("s", status="interrupted")
        done = self.ok("resume", "s", "--quiet")
        for member in ("seed_1", "seed_2"):
            self.assertIn(f"{member} was computed by physics {OTHER}", done.stderr)
            self.assertEqual(self.manifest("s/" + member)["physics"], self.physics())
            self.assertEqual(self.manifest("s/" + member)["resumed"], [])
        self.assertEqual(self.text("s/series.csv"), table)

    def test_a_checkpoint_of_another_physics_goes_on_with_a_warning(self):
        self.brittle()
        self.ok("run", "deck.json", "--out", "r", "--quiet")
        curve = self.text("r/curve.csv")
        self.as_of_other_physics("r", status="interrupted")
        done = self.ok("resume", "r", "--quiet")
        self.assertIn(f"computed by physics {OTHER}, and this program is physics {self.physics()}", done.stderr)
        self.assertEqual(self.text("r/curve.csv"), curve)
        self.assertEqual([program["physics"] for program in self.manifest("r")["resumed_by"]], [self.physics()])
        warnings = json.loads(self.text("r/summary.json"))["warnings"]
        self.assertIn(f"Computed by more than one physics: {OTHER}, then {self.physics()}.", warnings)


if __name__ == "__main__":
    main()
