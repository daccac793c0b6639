#!/usr/bin/env python3
"""`proveta report` from outside: it tells of what is there, changes nothing else, and nothing at all where it cannot."""
import json
import resource
import shutil
import signal
import subprocess

import case
from reliable import BODY, Reliability
from small_sweep import sweep
from test_calibrate import calibration


QUICK = {"material": {"elasticity": "as-given"}, "output": {"samples": 60, "fields": 1, "pictures": 0}}


def limited(bytes_):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_))


class Reports(Reliability):
    def snapshot(self, out):
        """All files but the checkpoints, and what is in them."""
        root = self.folder / out
        return {str(p.relative_to(root)): p.read_bytes() for p in root.rglob("*") if p.is_file() and p.suffix != ".h5"}

    def stopped(self, deck, until, number=signal.SIGINT):
        process = self.start("run", deck, "--out", "part", "--quiet", until="part/" + until)
        process.send_signal(number)
        process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0, "the machine was too slow to stop it")

    def test_of_an_interrupted_test_with_fields(self):
        for name, changes in {"bonds": {"test": "ucs"}, "membrane": {"test": "triaxial", "loading": {"confining_pressure": "2 MPa", "confinement": "membrane", "rate": "0.2 m/s"}}}.items():
            with self.subTest(name):
                shutil.rmtree(self.folder / "part", ignore_errors=True)
                self.stopped(self.deck({"specimen": BODY, "output": {"fields": 3, "pictures": 200}, **changes}), "fields")
                before = self.snapshot("part")
                done = self.run_program("report", "part", "--quiet")
                self.assertEqual(done.returncode, 130, done.stderr)
                after = self.snapshot("part")
                for file in before:
                    if file.startswith(("fields/", "pictures/")) or file.endswith(".csv"):
                        self.assertEqual(after[file], before[file], file)

    def test_of_a_killed_test_that_goes_on(self):
        deck = self.deck({"test": "ucs", "specimen": BODY, "output": {"fields": 3, "checkpoint_every": 0.1}})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        self.stopped(deck, "checkpoint.earlier.h5", signal.SIGKILL)
        self.assertEqual(self.run_program("report", "part", "--quiet").returncode, 130)
        self.assertEqual(self.run_program("resume", "part", "--quiet").returncode, 0)
        self.assertSame("part", "whole")

    def test_a_membrane_is_drawn_where_it_is(self):
        deck = self.deck({"test": "triaxial", "specimen": BODY, "output": {"fields": 1, "pictures": 200},
                          "loading": {"confining_pressure": "2 MPa", "confinement": "membrane", "rate": "0.5 m/s", "stop": {"axial_strain": 0.004}}})
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        before = self.snapshot("out")
        self.assertEqual(self.run_program("report", "out", "--quiet").returncode, 0)
        after = self.snapshot("out")
        self.assertEqual([f for f in before if before[f] != after[f]], ["report.html"])  # which names the deck that it is made from
        own = ("deck.json", "manifest.json", ">Written<")  # what the page says of itself
        pages = [[line for line in files["report.html"].decode().splitlines() if not any(word in line for word in own)] for files in (before, after)]
        self.assertEqual([line[:200] for line in pages[1] if line not in pages[0]], [])

    def test_of_a_series_that_has_not_ended(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2, 3]}, **QUICK})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        process = self.start("run", deck, "--out", "part", "--quiet", "--threads", 1, until="part/seed_1/report.html")
        process.kill()
        process.communicate()
        done = self.run_program("report", "part", "--quiet")
        self.assertEqual((done.returncode, self.status("part")), (130, "interrupted"), done.stdout + done.stderr)
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual((done.returncode, self.status("part")), (0, "complete"), done.stderr)
        self.assertEqual(self.content("part", "series.csv"), self.content("whole", "series.csv"))

    def test_of_a_series_whose_members_cannot_be_read(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2]}, **QUICK})
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        before = self.snapshot("out")

        def refused(says):
            done = self.run_program("report", "out", "--quiet")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(says, done.stderr)
            after = self.snapshot("out")
            for file in ("manifest.json", "series.csv", "summary.json", "report.html", "seed_1/manifest.json", "seed_1/summary.json"):
                self.assertEqual(after[file], before[file], file)

        for path in (self.folder / "out" / "seed_1").glob("checkpoint*"):
            path.write_bytes(b"not HDF5")
        refused("a whole checkpoint")
        for path in (self.folder / "out" / "seed_1").glob("checkpoint*"):
            path.unlink()
        refused("no checkpoint")
        shutil.rmtree(self.folder / "out" / "seed_1")  # which is as if it had not been run
        self.assertEqual(self.run_program("report", "out", "--quiet").returncode, 130)
        self.assertEqual(self.run_program("resume", "out", "--quiet").returncode, 0)
        self.assertEqual(self.content("out", "series.csv"), before["series.csv"])

    def test_a_full_disk_spoils_no_complete_result(self):
        series = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2]}, **QUICK}, "series.json")
        (self.folder / "sweep.json").write_text(json.dumps(sweep(points=4)))
        small = calibration(search={"spheres": 1, "trials": 3, "batch": 3}, finish={"rounds": 0, "trials": 1}, confidence={"seeds": 0})
        (self.folder / "calibration.json").write_text(json.dumps(small))
        material = {"card": "custom", "density": 2500, "young_modulus": "5 MPa", "elasticity": "as-given", "contact_law": "hertz", "contact_restitution": 0.4, "mu_d": 0.4}
        scene = self.deck({"scene": "beads", "materials": [{"name": "grain", "material": material}],
                           "surfaces": [{"name": "floor", "shape": "plane", "size": ["0.3 m", "0.3 m"]}],
                           "particles": [{"name": "beads", "size": "12 mm", "count": 50, "from": ["-60 mm", "-60 mm", "0.02 m"], "to": ["60 mm", "60 mm", "0.1 m"]}],
                           "stop": {"time": 0.1}}, "scene.json")
        for command, file in (("run", series), ("sweep", "sweep.json"), ("calibrate", "calibration.json"), ("scene", scene)):
            with self.subTest(command):
                done = self.run_program(command, file, "--out", command, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                before = self.snapshot(command)
                done = self.run_program("report", command, "--quiet", preexec_fn=limited(2500))
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertEqual(self.status(command), "complete")
                after = self.snapshot(command)
                self.assertEqual(set(after), set(before))
                # What fits is as it was too, but for the times that it tells.
                self.assertEqual([f for f in before if before[f] != after[f] and not f.endswith(("manifest.json", "progress.json"))], [])
                self.assertEqual(self.run_program("report", command, "--quiet").returncode, 0)

    def test_nobody_listens(self):
        small = calibration(search={"spheres": 1, "trials": 3, "batch": 3}, finish={"rounds": 0, "trials": 1}, confidence={"seeds": 0},
                            tests=[{"name": f"t{k}", "deck": {"test": "ucs", "loading": {"rate": "0.3 m/s"}}} for k in range(12)],
                            targets=[{"test": f"t{k}", "result": "strength", "value": "40 MPa"} for k in range(12)])
        (self.folder / "c.json").write_text(json.dumps(small))
        with open("/dev/full", "w") as full:
            done = subprocess.run([case.PROGRAM, "calibrate", "c.json", "--out", "c", "--quiet"], cwd=self.folder, stdout=full, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, self.status("c")), (4, "complete"))

    def test_a_comparison_does_not_replace_what_it_compares(self):
        deck = self.deck({"test": "ucs", "specimen": {**BODY, "seed": [1, 2]}, "output": {"fields": 0}})
        self.assertEqual(self.run_program("run", deck, "--out", "s", "--quiet").returncode, 0)
        before = self.snapshot("s")
        for folders, out in ((["s"], "s"), (["s"], "s/seed_1"), (["s/seed_1", "s/seed_2"], "s"), (["s/seed_1", "s/seed_2"], "s/../s/seed_2/")):
            done = self.run_program("compare", *folders, "--out", out)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("a folder that the comparison may replace", done.stderr)
        self.assertEqual(self.snapshot("s"), before)
        for _ in range(2):  # an earlier comparison may be replaced
            done = self.run_program("compare", "s", "--out", "s_compared")
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    case.main()
