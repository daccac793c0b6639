#!/usr/bin/env python3
"""Sweeps, calibrations and series whose processes are stopped, whose disk is full, whose files change: nothing is taken for a result."""
import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import time

import case
from reliable import BODY, Reliability
from small_sweep import DECK, sweep
from test_calibrate import calibration


def limited(bytes_):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_))


def children_of(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as f:
        return [int(child) for child in f.read().split()]


class Sweeps(Reliability):
    def setUp(self):
        super().setUp()
        (self.folder / "sweep.json").write_text(json.dumps(sweep(points=8)))

    def run_whole(self):
        done = self.run_program("sweep", "sweep.json", "--out", "whole", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def assertSameTable(self, out):
        self.assertEqual(self.content(out, "table.csv"), self.content("whole", "table.csv"))
        self.assertEqual(self.content(out, "summary.json"), self.content("whole", "summary.json"))
        self.assertEqual(self.rows(self.folder / out / "failures.csv"), [])

    def test_a_signal_to_all_of_its_processes_leaves_no_failed_test(self):
        self.run_whole()
        stopped = 0
        for attempt in range(6):
            process = self.start("sweep", "sweep.json", "--out", f"part{attempt}", "--quiet", "--threads", 2,
                                 until=f"part{attempt}/ledger.jsonl")
            time.sleep(0.2 + 0.05 * attempt)
            for child in children_of(process.pid):
                os.kill(child, signal.SIGTERM)
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
            stopped += process.returncode == 143
            self.assertIn(process.returncode, (0, 143))
            done = self.run_program("resume", f"part{attempt}", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertSameTable(f"part{attempt}")
        self.assertGreater(stopped, 0)

    def test_a_test_that_was_killed_is_carried_out_again_when_asked_for(self):
        self.run_whole()
        failures = []
        for _ in range(5):  # a test may have ended before it is killed
            shutil.rmtree(self.folder / "part", ignore_errors=True)
            process = self.start("sweep", "sweep.json", "--out", "part", "--quiet", "--threads", 1, until="part/trials")
            while process.poll() is None:
                if children := children_of(process.pid):
                    subprocess.run(["kill", "-9", str(children[0])])  # as a system does that is short of memory
                    break
                time.sleep(0.001)
            _, log = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, log)
            failures = [f["reason"] for f in self.rows(self.folder / "part" / "failures.csv")]
            if failures:
                break
        self.assertEqual(failures, ["ended by signal 9 (Killed)"])
        done = self.run_program("sweep", "sweep.json", "--out", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertSameTable("part")
        self.assertEqual(len((self.folder / "part" / "ledger.jsonl").read_text().splitlines()), 9)

    def test_a_full_disk_fails_no_test(self):
        self.run_whole()
        # Curves take some 20 kB: they do not fit, ledger and decks do.
        done = self.run_program("sweep", "sweep.json", "--out", "part", "--quiet", preexec_fn=limited(9000))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("proveta resume part", done.stderr)
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertSameTable("part")

    def test_trials_that_somebody_took_away_are_carried_out_again(self):
        self.run_whole()
        self.run_program("sweep", "sweep.json", "--out", "part", "--quiet")
        subprocess.run(["rm", "-r", self.folder / "part" / "trials"], check=True)
        done = self.run_program("sweep", "sweep.json", "--out", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertSameTable("part")

    def test_an_interrupt_while_specimens_are_made_is_heeded(self):
        many = sweep(points=1, tests=[{"name": "press", "deck": DECK, "seeds": list(range(2000))}])
        (self.folder / "many.json").write_text(json.dumps(many))
        process = self.start("sweep", "many.json", "--out", "many", "--quiet", until="many/specimens")
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=120)
        self.assertEqual(process.returncode, 143)
        self.assertLess(len(list((self.folder / "many" / "specimens").iterdir())), 1000)
        self.assertEqual(self.status("many"), "interrupted")

    def test_closed_streams_do_not_end_in_the_ledger(self):
        done = subprocess.run(["/bin/sh", "-c", f"exec {case.PROGRAM} sweep sweep.json --out out >&- 2>&- <&-"], cwd=self.folder)
        self.assertEqual(done.returncode, 0)
        done = self.run_program("sweep", "sweep.json", "--out", "out", "--status")
        self.assertIn("8 of 8 points done", done.stdout)

    def test_scripts_take_the_folders_name_for_text(self):
        out = self.folder / "a$(touch owned)'b\" c}"
        done = self.run_program("sweep", "sweep.json", "--out", out, "--plan")
        self.assertEqual(done.returncode, 0, done.stderr)
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "mpirun").write_text("#!/bin/sh\npwd\n")
        (tools / "mpirun").chmod(0o755)
        path = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
        seen = subprocess.run([out / "mpi.sh"], cwd=self.folder, env=path, capture_output=True, text=True)
        self.assertEqual(seen.stdout.strip(), str(out), seen.stderr)
        self.assertEqual(subprocess.run(["bash", "-n", out / "slurm.sh"]).returncode, 0)
        self.assertEqual(list(self.folder.rglob("owned")), [])


class Calibrations(Reliability):
    def prepared(self):
        """A calibration to a curve, with a card in a file of its own; stopped once a few of its trials are there."""
        with open(self.folder / "m.csv", "w") as f:
            csv.writer(f).writerows([["strain", "stress"], [0, 0], [0.0005, 14], [0.001, 26], [0.0015, 33], [0.002, 36]])
        (self.folder / "deck.json").write_text(json.dumps({"test": "ucs", "loading": {"rate": "0.3 m/s"}}))
        content = calibration(targets=[{"test": "ucs", "curve": "m.csv", "x_column": "strain", "y_column": "stress", "y": "total_stress", "y_factor": 1e6},
                                       {"test": "ucs", "result": "strength", "value": "40 MPa"}],
                              tests=[{"name": "ucs", "deck": "deck.json"}], confidence={"seeds": 0})
        (self.folder / "c.json").write_text(json.dumps(content))
        done = self.run_program("calibrate", "c.json", "--out", "whole", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.stop("part", "c.json")

    def stop(self, out, file=None):
        command = ["calibrate", file, "--out", out] if file else ["resume", out]
        process = self.start(*command, "--quiet", until=f"{out}/progress.json")
        time.sleep(0.3)  # one that goes on has found it there
        process.send_signal(signal.SIGINT)
        _, log = process.communicate(timeout=60)
        self.assertIn(process.returncode, (0, 130), log)

    def test_it_goes_on_twice_and_with_the_deck_that_it_began_with(self):
        self.prepared()
        self.stop("part")
        (self.folder / "deck.json").write_text(json.dumps({"test": "ucs", "loading": {"rate": "0.6 m/s"}}))
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        if "is complete" not in done.stdout:
            self.assertIn("deck.json has changed", done.stderr)
        cards = [json.loads(self.content(out, "card.json")) for out in ("whole", "part")]
        for card in cards:
            card.pop("evidence")
        self.assertEqual(*cards)

    def test_another_measured_curve_makes_another_calibration(self):
        self.prepared()
        (self.folder / "m.csv").write_text("strain,stress\n0,0\n0.001,20\n0.002,30\n")
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("another curve than the calibration began with", done.stderr)
        done = self.run_program("calibrate", "c.json", "--out", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)


class Others(Reliability):
    def test_a_full_disk_in_a_series(self):
        deck = self.deck(output={"samples": 40, "fields": 0, "pictures": 0}, specimen={**BODY, "seed": [1, 2]})
        self.assertEqual(self.run_program("run", deck, "--out", "whole", "--quiet").returncode, 0)
        done = self.run_program("run", deck, "--out", "part", "--quiet", preexec_fn=limited(150000))
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn("proveta resume part", done.stderr)
        done = self.run_program("resume", "part", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.content("part", "series.csv"), self.content("whole", "series.csv"))

    def test_an_interrupt_before_the_test_leaves_the_earlier_result(self):
        deck = self.deck()
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        before = self.content("out", "curve.csv")
        for after in (0.1, 0.3, 0.6):
            process = self.start("run", deck, "--out", "out", "--set", "specimen.spheres=20000", until="out")  # seconds before its test begins
            time.sleep(after)
            process.send_signal(signal.SIGINT)
            _, log = process.communicate(timeout=60)
            self.assertIn(process.returncode, (130, -signal.SIGINT), log)  # the latter on a busy machine, before it has begun at all
            self.assertEqual(self.content("out", "curve.csv"), before)
            self.assertEqual(self.status(), "complete")

    def killed_while_cleared(self, deck, crowded, result):
        """The program replaces a result of many files, and is killed as it clears them; what has been there is calculated anew."""
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        whole = self.content("out", result)
        fields = self.folder / "out" / crowded / "fields"
        found = []
        while "cleared" not in found and len(found) < 5:  # a busy machine may be too late for it
            fields.mkdir()
            for k in range(20000):  # which take a while to go
                (fields / f"old_{k}.vtp").write_text("x")
            process = self.start("run", deck, "--out", "out", "--quiet", until="out")
            while self.status() == "complete" and process.poll() is None:
                time.sleep(0.001)
            process.kill()
            process.communicate()
            found.append(self.status())
            done = self.run_program("resume", "out", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.content("out", result), whole)
            self.assertFalse(fields.exists())
        self.assertIn("cleared", found)

    def test_a_kill_while_an_earlier_result_is_cleared(self):
        given = {"output": {"samples": 40, "fields": 0, "pictures": 0}, "material": {"elasticity": "as-given"}}
        with self.subTest("a run"):
            self.killed_while_cleared(self.deck(specimen=BODY, **given), ".", "curve.csv")
        shutil.rmtree(self.folder / "out")
        with self.subTest("a series"):
            self.killed_while_cleared(self.deck(specimen={**BODY, "seed": [1, 2]}, **given), "seed_1", "series.csv")

    def test_what_cannot_be_printed_is_no_success(self):
        for command in ("describe", "schema"):  # less and more than is held back before it is written
            with open("/dev/full", "w") as full:
                done = subprocess.run([case.PROGRAM, command], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("not all could be printed", done.stderr)
            cut = subprocess.Popen([case.PROGRAM, command], stdout=subprocess.PIPE)
            cut.stdout.close()
            self.assertEqual(cut.wait(), 0)


if __name__ == "__main__":
    case.main()
